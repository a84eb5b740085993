// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_MOTION_METRIC_WAY_HPP
#define OPENCV_RSACKERMANN_SRC_MOTION_METRIC_WAY_HPP

#include "opencv2/rsackermann/depth_map.hpp"
#include "opencv2/rsackermann/motion.hpp"

namespace cv { namespace rsackermann {

/** Metres that the camera moves per unit of row time by the distance of a wall or the height above the road; negative
in reverse. Returns false if neither is known. */
bool findWayPerUnitTime(const RollingShutterCamera& camera, const AckermannMotion& motion, double& way);

//! Whether the motion has metres, so that depths in metres can be used with it.
bool isMetric(const RollingShutterCamera& camera, const AckermannMotion& motion);

/** Units of a depth map's depths that the camera moves per unit of row time: metres, as below, or 1 of a relative
depth. Negative in reverse. */
double wayPerUnitTime(const RollingShutterCamera& camera, const AckermannMotion& motion, const DepthMap& depth);

/** Metres that the camera moves per unit of row time; negative in reverse, 0 for a pure rotation.

Throws cv::Exception if isMetric() is false.
*/
double wayPerUnitTime(const RollingShutterCamera& camera, const AckermannMotion& motion);

//! Its standard deviation in the metres of a depth, by those of its scale and of the line delay, and of the speed or,
//! where their distance gives the metres, of the walls.
double wayPerUnitTimeSigma(const RollingShutterCamera& camera, const AckermannMotion& motion, const DepthMap& depth);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_MOTION_METRIC_WAY_HPP
