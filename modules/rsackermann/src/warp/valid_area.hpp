// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_VALID_AREA_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_VALID_AREA_HPP

#include "opencv2/rsackermann/warp.hpp"

namespace cv { namespace rsackermann {

//! The largest rectangle of pixels of a CV_8U mask that aren't 0; empty if there is none.
Rect largestRectangle(const Mat& mask);

//! See WarpMapGenerator::optimalNewCameraMatrix; fallback is returned if a border of the raw image has no place.
Matx33d optimalMatrix(const RollingShutterCamera& camera, const AckermannMotion& motion, double alpha,
                      const Size& newSize, const Matx33d& fallback);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_VALID_AREA_HPP
