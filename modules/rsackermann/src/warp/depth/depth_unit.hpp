// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DEPTH_DEPTH_UNIT_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DEPTH_DEPTH_UNIT_HPP

#include "opencv2/rsackermann/depth_map.hpp"
#include "opencv2/rsackermann/warp.hpp"

namespace cv { namespace rsackermann {

/** Whether the values of a metric depth are evidently in another unit than DepthMap::scale says: walls and road of a
motion in metres are so much nearer or further away.

@param depth checked, or empty. */
bool isInAnotherUnit(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params,
                     const AckermannMotion& motion, const DepthMap& depth);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DEPTH_DEPTH_UNIT_HPP
