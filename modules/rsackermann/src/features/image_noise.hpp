// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FEATURES_IMAGE_NOISE_HPP
#define OPENCV_RSACKERMANN_SRC_FEATURES_IMAGE_NOISE_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

//! Standard deviation of the noise of an image, from its second differences in both directions, grey levels: at least
//! that of rounding.
double imageNoise(const Mat& gray);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_IMAGE_NOISE_HPP
