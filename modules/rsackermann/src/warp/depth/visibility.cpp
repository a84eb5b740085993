// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "quarters.hpp"
#include "reach.hpp"
#include "surface_search.hpp"
#include "visibility.hpp"

namespace cv { namespace rsackermann {

static bool isNear(const Point2f& a, const Point2f& b)
{
    const float limit = 1; // pixel: surfaces that aren't further apart, as those of noise, hide nothing of one another
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) <= limit;
}

static const int SMALLEST = 8; // pixels of blocks that aren't divided any more

// A square around the places inside of the other image, in which the others count as on its border.
Rect Visibility::placesOf(const DepthPatch& own, const Point& first, const Rect& block) const
{
    float low, high;
    depths.range(block, low, high);
    Reach reach;
    for (int k = 0; k < 4; k++)
    {
        const CubicCurve curve(own, block.tl() - first + Point(k % 2 * block.width, k / 2 * block.height));
        reach.add(curve.at(low));
        reach.add(curve.at(high));
    }
    return reach.square(lastX, lastY);
}

// If the pixels that could be in front of a block and those behind belong to one surface all are seen.
void Visibility::find(const DepthPatch& own, const Point& first, const Rect& block, const MapWriter::Tile& tile,
                      Mat1b& hidden) const
{
    const Rect square = placesOf(own, first, block);
    float low, high, stretch;
    DepthPatch patch;
    const bool isKnown = findReach(back, depths, square.tl(), square.size(), low, high, stretch);
    if (isKnown && stretch <= SurfaceSearch<CubicCurve>::largestStretch())
        hidden(block).setTo(0);
    else if (isKnown && patch.fit(square, low, high, back))
        findByPatches({own, first, patch, square.tl()}, low, high, block, tile, hidden);
    else if (std::max(block.width, block.height) > SMALLEST)
        forEachQuarter(block, [&](const Rect& quarter) { find(own, first, quarter, tile, hidden); });
    else
        findByPixels(block, tile, hidden);
}

void Visibility::findByPatches(const Patches& patches, float low, float high, const Rect& block,
                               const MapWriter::Tile& tile, Mat1b& hidden) const
{
    const Rect square = placesOf(patches.own, patches.ownFirst, block);
    float stretch;
    narrowReach(patches.back, Rect(square.tl() - patches.backFirst, square.size()), depths, low, high, stretch);
    if (stretch <= SurfaceSearch<CubicCurve>::largestStretch())
        hidden(block).setTo(0);
    else if (std::max(block.width, block.height) > SMALLEST)
        forEachQuarter(block, [&](const Rect& quarter) { findByPatches(patches, low, high, quarter, tile, hidden); });
    else
        forEachInside(block, tile, hidden, [&](const Point& pixel, const Point2f& place) {
            float depth = depths.values()(pixel);
            if (depth >= high) // nothing is in front
                return true;
            const CubicCurve curve(patches.back, place - Point2f(patches.backFirst));
            if (!isNear(curve.at(high), pixel))
                SurfaceSearch<CubicCurve>(depths, curve, depth, high).find(depth);
            return isNear(curve.at(depth), pixel);
        });
}

void Visibility::findByPixels(const Rect& block, const MapWriter::Tile& tile, Mat1b& hidden) const
{
    forEachInside(block, tile, hidden, [&](const Point& pixel, const Point2f& place) {
        float low, high, stretch, depth;
        Point2d shown;
        if (!findReach(back, depths, place, Size(), low, high, stretch))
            return true;
        SurfaceSearch<CubicCurve>(depths, CubicCurve(back, place, low, high), low, high).find(depth);
        return back.find(place, depth, shown) && isNear(shown, pixel);
    });
}

template <class IsSeen>
void Visibility::forEachInside(const Rect& block, const MapWriter::Tile& tile, Mat1b& hidden,
                               const IsSeen& isSeen) const
{
    for (int y = block.y; y < block.br().y; y++)
        for (int x = block.x; x < block.br().x; x++)
        {
            const Point pixel(x, y);
            const Point2f place(*tile.x(pixel), *tile.y(pixel));
            const bool isInside = place.x >= 0 && place.y >= 0 && place.x <= lastX && place.y <= lastY;
            hidden(pixel) = !isInside || isSeen(pixel, place) ? 0 : 255;
        }
}

}} // namespace cv::rsackermann
