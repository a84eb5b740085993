// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "map_kernels.hpp"
#include "tile_own_depth.hpp"

namespace cv { namespace rsackermann {

// If some depths aren't known the tile isn't of use.
bool TileOwnDepth::fillByPatches(const Rect& square, MapWriter::Tile& tile) const
{
    const Rect seen = square & tile.area();
    float low, high;
    const Mat1f values = depths.part(seen, low, high);
    if (values.empty())
        return true;
    DepthPatch patch;
    if (!patch.fit(square, low, high, places))
        return false;
    evaluateDepthPatch(patch, values[0], values.step1(), seen.size(), tile.x(seen.tl()), tile.y(seen.tl()), tile.step);
    if (visibility)
        visibility->find(patch, square.tl(), seen, tile);
    return true;
}

void TileOwnDepth::fillByPixels(const Rect& area, MapWriter::Tile& tile) const
{
    float low, high;
    const Mat1f values = depths.part(area, low, high);
    for (int y = area.y; y < area.br().y; y++)
        for (int x = area.x; x < area.br().x; x++)
        {
            Point2d place;
            if (places.find(Point2d(x, y), values(Point(x, y) - area.tl()), place))
                tile.set(Point(x, y), place);
            else
                tile.setNone(Point(x, y));
        }
    if (visibility)
        visibility->findByPixels(area, tile);
}

}} // namespace cv::rsackermann
