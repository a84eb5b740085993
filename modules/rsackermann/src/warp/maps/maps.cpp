// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../../checks.hpp"
#include "../../motion/metric_way.hpp"
#include "../depth/visibility.hpp"
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

void checkDepth(const DepthMap& depth, const RollingShutterCamera& camera, const WarpMapGenerator::Params& params)
{
    depth.check();
    if (depth.empty())
        return;
    const bool ofRaw = depth.camera == DEPTH_RAW;
    const Size expected = ofRaw ? camera.imageSize : GlobalCamera(camera, params).size;
    REJECT_IF(depth.values.size() != expected,
              "depth.values is %d x %d; the size %d x %d of the %s camera's image is expected", depth.values.cols,
              depth.values.rows, expected.width, expected.height, ofRaw ? "raw" : "global-shutter");
}

// Twice the way from the reference row to the farther end: what is nearer the camera would nearly reach.
static double nearestDepth(const RollingShutterCamera& camera, double way)
{
    const Point2d end(camera.imageSize.width - 1, camera.imageSize.height - 1);
    return 2 * std::abs(way) * std::max(std::abs(camera.rowTime(Point2d())), std::abs(camera.rowTime(end)));
}

void writeDepthMap(WarpDirection warp, const RollingShutterCamera& camera, const WarpMapGenerator::Params& params,
                   const AckermannMotion& motion, const DepthMap& depth, MapWriter& writer)
{
    const double way = motion.status != MOTION_OK ? 0 : wayPerUnitTime(camera, motion, depth);
    if (way == 0) // the places are the same at all depths
        return writeMap(warp, camera, params, motion, writer);
    const ShutterGeometry shutter(camera, motion);
    const GlobalCamera global(camera, params);
    const double nearest = nearestDepth(camera, way);
    const bool ofRaw = depth.camera == DEPTH_RAW, isOwn = ofRaw == (warp == WARP_DISTORT),
               isRectify = warp == WARP_RECTIFY;
    const RectifyPlaces rectify(shutter, global.matrix, way, ofRaw, params.maxIterations, params.tolerance);
    const DistortPlaces distort(shutter, global.matrix, way, ofRaw);
    const DepthPlaces* const ways[] = {&rectify, &distort};
    const DepthPlaces &places = *ways[!isRectify], &back = *ways[isRectify];

    if (isOwn && !writer.hasMask())
    {
        const GivenDepths given(depth, nearest);
        fillByOwnDepth(places, given, nullptr, writer);
        if (given.areComplete())
            return;
    }
    const InverseDepthImage depths(depth, shutter, global.matrix, way, nearest);
    const Visibility visibility(back, depths, isRectify ? camera.imageSize : global.size);
    if (isOwn)
        fillByOwnDepth(places, depths, writer.hasMask() ? &visibility : nullptr, writer);
    else
        fillByOtherDepth(places, depths, writer);
}

}} // namespace cv::rsackermann
