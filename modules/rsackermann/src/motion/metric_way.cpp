// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/line_delay_sigma.hpp"
#include "../checks.hpp"
#include "metric_way.hpp"

namespace cv { namespace rsackermann {

static bool translates(const AckermannMotion& motion)
{
    return motion.wallSlope != 0 || motion.wallOffset != 0 || motion.roadSlope != 0 ||
           !motion.inverseDepthOffset.empty();
}

static bool hasWallDistance(const AckermannMotion& motion)
{
    return std::hypot(motion.wallSlope, motion.wallOffset) > 0 && motion.wallDistance > 0;
}

bool isMetric(const RollingShutterCamera& camera, const AckermannMotion& motion)
{
    return !translates(motion) || hasWallDistance(motion) ||
           (motion.scale != SCALE_UNKNOWN && motion.roadSlope != 0 && camera.height > 0);
}

double wayPerUnitTime(const RollingShutterCamera& camera, const AckermannMotion& motion)
{
    REJECT_IF(!isMetric(camera, motion),
              "depths are given, but motion.wallDistance is %g m, and motion.roadSlope is %g with motion.scale %d and "
              "camera.height %g m; one of the two must give the speed",
              motion.wallDistance, motion.roadSlope, motion.scale, camera.height);
    if (!translates(motion))
        return 0;
    if (hasWallDistance(motion))
        return (motion.direction < 0 ? -1 : 1) * std::hypot(motion.wallSlope, motion.wallOffset) * motion.wallDistance;
    return motion.roadSlope * camera.height;
}

double wayPerUnitTimeSigma(const RollingShutterCamera& camera, const AckermannMotion& motion)
{
    const double unit = camera.secondsPerUnitTime(), way = std::abs(wayPerUnitTime(camera, motion));
    const Vec4d wall(0, motion.wallSlope, motion.wallOffset, 0);
    const double ofSpeed = std::hypot(unit * motion.speedSigma, way * relativeLineDelaySigma(camera)),
                 ofWalls = way * std::sqrt(std::max(wall.dot(motion.covariance * wall), 0.)) /
                           std::max(wall.dot(wall), DBL_MIN);
    return std::max(motion.speedSigma > 0 ? ofSpeed : ofWalls, way * FLT_EPSILON);
}

double wayPerUnitTime(const RollingShutterCamera& camera, const AckermannMotion& motion, const DepthMap& depth)
{
    if (depth.kind == DEPTH_RELATIVE)
        return motion.direction >= 0 ? 1 : -1;
    return wayPerUnitTime(camera, motion);
}

}} // namespace cv::rsackermann
