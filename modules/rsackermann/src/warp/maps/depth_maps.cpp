// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../../motion/metric_way.hpp"
#include "maps.hpp"
#include "tile_other_depth.hpp"
#include "tile_own_depth.hpp"

namespace cv { namespace rsackermann {

namespace {

// Both maps of a motion and a depth.
class DepthMaps
{
public:
    DepthMaps(const RollingShutterCamera& camera_, const WarpMapGenerator::Params& params,
              const ShutterGeometry& shutter, const DepthMap& depth, double way)
        : ofRaw(depth.camera == DEPTH_RAW), rawSize(camera_.imageSize), global(camera_, params),
          depths(depth, shutter, global.matrix, way, nearest(camera_, way)),
          rectify(shutter, global.matrix, way, ofRaw, params.maxIterations, params.tolerance),
          distort(shutter, global.matrix, way, ofRaw)
    {
    }

    void write(WarpDirection warp, MapWriter& writer, Mat& mask) const
    {
        Mat1b hidden;
        if (!mask.empty())
            hidden.create(mask.size());
        const bool isOwn = ofRaw == (warp == WARP_DISTORT), isRectify = warp == WARP_RECTIFY;
        const Visibility visibility(placesOf(isRectify ? WARP_DISTORT : WARP_RECTIFY), depths,
                                    isRectify ? rawSize : global.size);
        if (isOwn)
            fillTiles(TileOwnDepth(placesOf(warp), depths, mask.empty() ? nullptr : &visibility, hidden), writer);
        else
            fillTiles(TileOtherDepth(placesOf(warp), depths, hidden), writer);
        if (!mask.empty())
            mask.setTo(MASK_HIDDEN, (mask == MASK_SEEN) & hidden);
    }

private:
    // Twice the way from the reference row to the farther end: what is nearer the camera would nearly reach.
    static double nearest(const RollingShutterCamera& camera, double way)
    {
        const Point2d end(camera.imageSize.width - 1, camera.imageSize.height - 1);
        return 2 * std::abs(way) * std::max(std::abs(camera.rowTime(Point2d())), std::abs(camera.rowTime(end)));
    }

    const DepthPlaces& placesOf(WarpDirection warp) const
    {
        if (warp == WARP_RECTIFY)
            return rectify;
        return distort;
    }

    const bool ofRaw;
    const Size rawSize;
    const GlobalCamera global;
    const InverseDepthImage depths;
    const RectifyPlaces rectify;
    const DistortPlaces distort;
};

} // namespace

void checkDepth(const DepthMap& depth, const RollingShutterCamera& camera, const WarpMapGenerator::Params& params)
{
    depth.check();
    if (depth.empty())
        return;
    const bool ofRaw = depth.camera == DEPTH_RAW;
    const Size expected = ofRaw ? camera.imageSize : GlobalCamera(camera, params).size;
    if (depth.values.size() != expected)
        CV_Error(Error::StsBadArg,
                 format("depth.values is %d x %d; the size %d x %d of the %s camera's image is expected",
                        depth.values.cols, depth.values.rows, expected.width, expected.height,
                        ofRaw ? "raw" : "global-shutter"));
}

void writeDepthMap(WarpDirection warp, const RollingShutterCamera& camera, const WarpMapGenerator::Params& params,
                   const AckermannMotion& motion, const DepthMap& depth, MapWriter& writer, Mat mask)
{
    const double way = motion.status != MOTION_OK ? 0 : wayPerUnitTime(camera, motion, depth);
    if (way == 0) // the places are the same at all depths
        return writeMap(warp, camera, params, motion, writer);
    const ShutterGeometry shutter(camera, motion);
    DepthMaps(camera, params, shutter, depth, way).write(warp, writer, mask);
}

}} // namespace cv::rsackermann
