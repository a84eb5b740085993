// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "quarters.hpp"
#include "tile_filler.hpp"

namespace cv { namespace rsackermann {

// Smaller squares are solved pixel by pixel.
static const int MIN_PATCH = 16;

void TileFiller::fill(MapWriter::Tile& tile) const
{
    fillSquare(Rect(tile.area().tl(), Size(MapWriter::TILE, MapWriter::TILE)), tile);
}

void TileFiller::fillSquare(const Rect& square, MapWriter::Tile& tile) const
{
    const Rect seen = square & tile.area();
    if (seen.empty() || fillByPatches(square, tile))
        return;
    if (square.width <= MIN_PATCH)
        return fillByPixels(seen, tile);
    forEachQuarter(square, [&](const Rect& quarter) { fillSquare(quarter, tile); });
}

}} // namespace cv::rsackermann
