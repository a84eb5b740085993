// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_MOTION_MOTION_CHECK_HPP
#define OPENCV_RSACKERMANN_SRC_MOTION_MOTION_CHECK_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace cv { namespace rsackermann {

//! Throws unless images, points and maps can follow the motion.
void checkMotion(const AckermannMotion& motion);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_MOTION_MOTION_CHECK_HPP
