// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "quarters.hpp"
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
    if (!depths.hasCells() || !findReach(places, depths, square.tl(), square.size(), low, high, stretch) ||
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
        searchDepthPatch(patch, depths.values(), 0.5f * (low + high), block.tl() - first, block.size(),
                         tile.x(block.tl()), tile.y(block.tl()), tile.step);
    else if (std::max(block.width, block.height) <= smallest)
        searchSurfaces(patch, depths.values(), low, high, block.tl() - first, block.size(), tile.x(block.tl()),
                       tile.y(block.tl()), tile.step, tile.mask(block));
    else
        forEachQuarter(block, [&](const Rect& quarter) { fillBlock(patch, first, low, high, quarter, tile); });
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
            if (SurfaceSearch<ExactCurve, InverseDepthImage>(depths, curve, low, high).find(depth) > LARGEST_STRETCH)
                tile.hide(pixel);
            if (places.find(pixel, depth, place))
                tile.set(pixel, place);
            else
                tile.setNone(pixel);
        }
}

}} // namespace cv::rsackermann
