// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "reach.hpp"
#include "surface_search.hpp"
#include "visibility.hpp"

namespace cv { namespace rsackermann {

static bool isNear(const Point2f& a, const Point2f& b)
{
    const float limit = 1; // pixel: surfaces that aren't further apart, as those of noise, hide nothing of one another
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) <= limit;
}

namespace {

const int SMALLEST = 8; // pixels of blocks that aren't divided any more

// Calls use(part) for the four parts of a block.
template <class Use>
void divide(const Rect& block, const Use& use)
{
    const Size half((block.width + 1) / 2, (block.height + 1) / 2);
    for (int k = 0; k < 4; k++)
    {
        const Rect part = Rect(block.tl() + Point(k % 2 * half.width, k / 2 * half.height), half) & block;
        if (!part.empty())
            use(part);
    }
}

} // namespace

// A square around the places inside of the other image, in which the others count as on its border.
Rect Visibility::placesOf(const Rect& block, const MapWriter::Tile& tile) const
{
    float low[2][MapWriter::TILE], high[2][MapWriter::TILE]; // of the columns, so that the loops are vectors
    for (int axis = 0; axis < 2; axis++)
    {
        std::fill(low[axis], low[axis] + block.width, FLT_MAX);
        std::fill(high[axis], high[axis] + block.width, -FLT_MAX);
        for (int y = block.y; y < block.br().y; y++)
        {
            const float* places = axis == 0 ? tile.x(Point(block.x, y)) : tile.y(Point(block.x, y));
            for (int j = 0; j < block.width; j++)
            {
                low[axis][j] = std::min(low[axis][j], places[j]);
                high[axis][j] = std::max(high[axis][j], places[j]);
            }
        }
    }
    Reach reach;
    for (int j = 0; j < block.width; j++)
    {
        reach.add(Point2f(low[0][j], low[1][j]));
        reach.add(Point2f(high[0][j], high[1][j]));
    }
    return reach.square(lastX, lastY);
}

// If the pixels that could be in front of a block and those behind belong to one surface all are seen.
void Visibility::find(const Rect& block, const MapWriter::Tile& tile, Mat1b& hidden) const
{
    const Rect square = placesOf(block, tile);
    float low, high, stretch;
    DepthPatch patch;
    const bool isKnown = findReach(back, depths, square.tl(), square.size(), low, high, stretch);
    if (isKnown && stretch <= SurfaceSearch<CubicCurve>::largestStretch())
        hidden(block).setTo(0);
    else if (isKnown && patch.fit(square, low, high, back))
        findByPatch(patch, square.tl(), low, high, block, tile, hidden);
    else if (std::max(block.width, block.height) > SMALLEST)
        divide(block, [&](const Rect& part) { find(part, tile, hidden); });
    else
        forEachInside(block, tile, hidden, [&](const Point& pixel, const Point2f& place) {
            float nearest, farthest, depth;
            Point2d shown;
            if (!findReach(back, depths, place, Size(), farthest, nearest, stretch))
                return true;
            const CubicCurve curve(back, place, farthest, nearest);
            SurfaceSearch<CubicCurve>(depths, curve, farthest, nearest).find(depth);
            return back.find(place, depth, shown) && isNear(shown, pixel);
        });
}

void Visibility::findByPatch(const DepthPatch& patch, const Point& first, float low, float high, const Rect& block,
                             const MapWriter::Tile& tile, Mat1b& hidden) const
{
    const Rect square = placesOf(block, tile);
    float stretch;
    narrowReach(patch, Rect(square.tl() - first, square.size()), depths, low, high, stretch);
    if (stretch <= SurfaceSearch<CubicCurve>::largestStretch())
        hidden(block).setTo(0);
    else if (std::max(block.width, block.height) > SMALLEST)
        divide(block, [&](const Rect& part) { findByPatch(patch, first, low, high, part, tile, hidden); });
    else
        forEachInside(block, tile, hidden, [&](const Point& pixel, const Point2f& place) {
            const CubicCurve curve(patch, place - Point2f(first));
            float depth;
            SurfaceSearch<CubicCurve>(depths, curve, low, high).find(depth);
            return isNear(curve.at(depth), pixel);
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
