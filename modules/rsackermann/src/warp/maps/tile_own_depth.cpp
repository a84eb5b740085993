// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "map_kernels.hpp"
#include "tile_own_depth.hpp"

namespace cv { namespace rsackermann {

bool TileOwnDepth::fillByPatches(const Rect& square, MapWriter::Tile& tile) const
{
    const Rect seen = square & tile.area();
    float low, high;
    depths.range(seen, low, high);
    DepthPatch patch;
    if (!patch.fit(square, low, high, places))
        return false;
    const Mat1f& values = depths.values();
    evaluateDepthPatch(patch, values[seen.y] + seen.x, values.step1(), seen.size(), tile.x(seen.tl()),
                       tile.y(seen.tl()), tile.step);
    if (visibility)
        visibility->find(patch, square.tl(), seen, tile, hidden);
    return true;
}

void TileOwnDepth::fillByPixels(const Rect& area, MapWriter::Tile& tile) const
{
    for (int y = area.y; y < area.br().y; y++)
        for (int x = area.x; x < area.br().x; x++)
        {
            Point2d place;
            if (places.find(Point2d(x, y), depths.values()(y, x), place))
                tile.set(Point(x, y), place);
            else
                tile.setNone(Point(x, y));
        }
    if (visibility)
        visibility->findByPixels(area, tile, hidden);
}

}} // namespace cv::rsackermann
