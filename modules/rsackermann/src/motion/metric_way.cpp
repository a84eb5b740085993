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

bool findWayPerUnitTime(const RollingShutterCamera& camera, const AckermannMotion& motion, double& way)
{
    const double ofWall = std::hypot(motion.wallSlope, motion.wallOffset) * motion.wallDistance,
                 ofRoad = motion.scale != SCALE_UNKNOWN ? motion.roadSlope * camera.height : 0;
    way = ofWall > 0 ? (motion.direction < 0 ? -ofWall : ofWall) : ofRoad;
    return motion.wallDistance > 0 || ofRoad != 0;
}

bool isMetric(const RollingShutterCamera& camera, const AckermannMotion& motion)
{
    double way;
    return !translates(motion) || (findWayPerUnitTime(camera, motion, way) && way != 0);
}

double wayPerUnitTime(const RollingShutterCamera& camera, const AckermannMotion& motion)
{
    REJECT_IF(!isMetric(camera, motion),
              "depths are given, but motion.wallDistance is %g m, and motion.roadSlope is %g with motion.scale %d and "
              "camera.height %g m; one of the two must give the speed",
              motion.wallDistance, motion.roadSlope, motion.scale, camera.height);
    double way;
    findWayPerUnitTime(camera, motion, way);
    return translates(motion) ? way : 0;
}

double wayPerUnitTimeSigma(const RollingShutterCamera& camera, const AckermannMotion& motion, const DepthMap& depth)
{
    const double unit = camera.secondsPerUnitTime(), way = std::abs(wayPerUnitTime(camera, motion));
    const Vec4d wall(0, motion.wallSlope, motion.wallOffset, 0);
    const double ofSpeed = std::hypot(unit * motion.speedSigma, way * relativeLineDelaySigma(camera)),
                 ofWalls = way * std::sqrt(std::max(wall.dot(motion.covariance * wall), 0.)) /
                           std::max(wall.dot(wall), DBL_MIN);
    return std::max(std::hypot(motion.speedSigma > 0 ? ofSpeed : ofWalls, way * depth.scaleSigma), way * FLT_EPSILON);
}

double wayPerUnitTime(const RollingShutterCamera& camera, const AckermannMotion& motion, const DepthMap& depth)
{
    if (depth.kind == DEPTH_RELATIVE)
        return motion.direction >= 0 ? 1 : -1;
    return wayPerUnitTime(camera, motion);
}

}} // namespace cv::rsackermann
