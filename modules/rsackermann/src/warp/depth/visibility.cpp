// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../maps/search_kernels.hpp"
#include "../maps/maps.hpp"
#include "reach.hpp"
#include "surface_search.hpp"
#include "visibility.hpp"

namespace cv { namespace rsackermann {

// Pixels: surfaces that aren't further apart, as those of noise, hide nothing of one another.
static const float DISTANCE = 1;

static const int SMALLEST = 8; // pixels of blocks that aren't divided any more

// A square around the places inside of the other image, in which the others count as on its border.
Rect Visibility::placesOf(const DepthPatch& own, const Point& first, const Rect& block) const
{
    const DepthRange range = depths.range(block);
    Reach reach;
    for (int k = 0; k < 4; k++)
    {
        const SquareCurve curve(own, block.tl() - first + Point(k % 2 * block.width, k / 2 * block.height));
        reach.add(curve.at(range.low));
        reach.add(curve.at(range.high));
    }
    return reach.square(lastX, lastY);
}

// If the pixels that could be in front of a block and those behind belong to one surface all are seen.
void Visibility::find(const DepthPatch& own, const Point& first, const Rect& block, const MapWriter::Tile& tile) const
{
    const double times = 40; // to 0.01 pixels, which is near enough for a distance
    const Rect square = placesOf(own, first, block);
    float low, high, stretch;
    DepthPatch patch;
    const bool isKnown = findReach(back, depths, square.tl(), square.size(), low, high, stretch);
    if (isKnown && stretch <= LARGEST_STRETCH)
        return;
    if (isKnown && depths.hasCells() && patch.fit(square, low, high, back, times))
        findByPatches({own, first, patch, square.tl()}, low, high, block, tile);
    else if (std::max(block.width, block.height) > SMALLEST)
        forEachQuarter(block, [&](const Rect& quarter) { find(own, first, quarter, tile); });
    else
        findByPixels(block, tile);
}

void Visibility::findByPatches(const Patches& patches, float low, float high, const Rect& block,
                               const MapWriter::Tile& tile) const
{
    const Rect square = placesOf(patches.own, patches.ownFirst, block);
    float stretch;
    narrowReach(patches.back, Rect(square.tl() - patches.backFirst, square.size()), depths, low, high, stretch);
    if (stretch <= LARGEST_STRETCH)
        return;
    if (std::max(block.width, block.height) > SMALLEST)
        forEachQuarter(block, [&](const Rect& quarter) { findByPatches(patches, low, high, quarter, tile); });
    else
    {
        Mat1b mask = tile.mask(block);
        findHidden(patches.back, patches.backFirst, depths.values(), high, DISTANCE, block.tl(), tile.at(block),
                   Point2f(lastX, lastY), mask);
    }
}

void Visibility::findByPixels(const Rect& block, const MapWriter::Tile& tile) const
{
    for (int y = block.y; y < block.br().y; y++)
        for (int x = block.x; x < block.br().x; x++)
        {
            const Point pixel(x, y);
            const Point2f place(*tile.x(pixel), *tile.y(pixel));
            float low, high, stretch, depth;
            Point2d shown;
            if (!(place.x >= 0 && place.y >= 0 && place.x <= lastX && place.y <= lastY) ||
                !findReach(back, depths, place, Size(), low, high, stretch))
                continue;
            const SquareCurve curve(back, place, low, high);
            SurfaceSearch<SquareCurve, InverseDepthImage>(depths, curve, low, high).find(depth);
            const bool found = back.find(place, depth, shown);
            const Point2d away = shown - Point2d(pixel);
            if (!found || std::max(std::abs(away.x), std::abs(away.y)) > DISTANCE)
                tile.hide(pixel);
        }
}

}} // namespace cv::rsackermann
