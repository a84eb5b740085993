// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "maps.hpp"
#include "../shutter_geometry.hpp"

namespace cv { namespace rsackermann {

GlobalCamera::GlobalCamera(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params)
    : matrix(params.newCameraMatrix == Matx33d::zeros() ? camera.cameraMatrix : params.newCameraMatrix),
      size(params.newSize == Size() ? camera.imageSize : params.newSize)
{
}

// Smaller squares are solved pixel by pixel.
static const int MIN_PATCH = 8;

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

void fillTiles(const TileFiller& filler, MapWriter& writer)
{
    parallel_for_(Range(0, writer.tiles()), [&](const Range& range) {
        std::vector<float> buffer;
        for (int i = range.start; i < range.end; i++)
        {
            const int64 start = getTickCount();
            MapWriter::Tile tile(writer, i, buffer);
            filler.fill(tile);
            tile.write();
            if (writer.whenWritten)
                writer.whenWritten(tile.area(), start);
        }
    });
}

void writeMap(WarpDirection warp, const RollingShutterCamera& camera, const WarpMapGenerator::Params& params,
              const AckermannMotion& motion, MapWriter& writer)
{
    const ShutterGeometry shutter(camera, motion);
    const Matx33d matrix = GlobalCamera(camera, params).matrix;
    if (warp == WARP_RECTIFY)
        fillRectifyMap(shutter, matrix, params, writer);
    else
        fillDistortMap(shutter, matrix, writer);
}

}} // namespace cv::rsackermann
