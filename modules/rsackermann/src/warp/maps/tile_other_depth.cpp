// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../depth/quarters.hpp"
#include "../depth/reach.hpp"
#include "../depth/surface_search.hpp"
#include "search_kernels.hpp"
#include "pixel_curve.hpp"
#include "tile_other_depth.hpp"

namespace cv { namespace rsackermann {

bool TileOtherDepth::fillByPatches(const Rect& square, MapWriter::Tile& tile) const
{
    float low, high, stretch;
    DepthPatch patch;
    if (!findReach(places, depths, square.tl(), square.size(), low, high, stretch) ||
        !patch.fit(square, low, high, places))
        return false;
    fillBlock(patch, square.tl(), low, high, square & tile.area(), tile);
    return true;
}

// In a smaller part of a square fewer surfaces come into question.
void TileOtherDepth::fillBlock(const DepthPatch& patch, const Point& first, float low, float high, const Rect& block,
                               MapWriter::Tile& tile) const
{
    const int smallest = 8;
    float stretch;
    narrowReach(patch, Rect(block.tl() - first, block.size()), depths, low, high, stretch);
    if (stretch <= LARGEST_STRETCH)
        fillSmooth(patch, first, 0.5f * (low + high), block, tile);
    else if (std::max(block.width, block.height) <= smallest)
        fillSurfaces(patch, first, low, high, block, tile);
    else
        forEachQuarter(block, [&](const Rect& quarter) { fillBlock(patch, first, low, high, quarter, tile); });
}

void TileOtherDepth::fillSmooth(const DepthPatch& patch, const Point& first, float start, const Rect& block,
                                MapWriter::Tile& tile) const
{
    searchDepthPatch(patch, depths.values(), start, block.tl() - first, block.size(), tile.x(block.tl()),
                     tile.y(block.tl()), tile.step);
    if (!hidden.empty())
        hidden(block).setTo(0);
}

void TileOtherDepth::fillSurfaces(const DepthPatch& patch, const Point& first, float low, float high, const Rect& block,
                                  MapWriter::Tile& tile) const
{
    Mat1b flags = hidden.empty() ? Mat1b() : hidden(block);
    searchSurfaces(patch, depths.values(), low, high, block.tl() - first, block.size(), tile.x(block.tl()),
                   tile.y(block.tl()), tile.step, flags);
}

void TileOtherDepth::fillByPixels(const Rect& area, MapWriter::Tile& tile) const
{
    for (int y = area.y; y < area.br().y; y++)
        for (int x = area.x; x < area.br().x; x++)
        {
            const Point pixel(x, y);
            float low, high, stretch, depth;
            Point2d place;
            if (!findReach(places, depths, pixel, Size(), low, high, stretch))
            {
                tile.setNone(pixel);
                continue;
            }
            const ExactCurve curve(places, pixel);
            const float uncovered = SurfaceSearch<ExactCurve, InverseDepthImage>(depths, curve, low, high).find(depth);
            if (!hidden.empty())
                hidden(pixel) = uncovered > LARGEST_STRETCH ? 255 : 0;
            if (places.find(pixel, depth, place))
                tile.set(pixel, place);
            else
                tile.setNone(pixel);
        }
}

}} // namespace cv::rsackermann
