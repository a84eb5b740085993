// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_PICTURE_HPP
#define RSACKERMANN_SAMPLES_PICTURE_HPP

#include "opencv2/core.hpp"

namespace rsackermann_samples {

//! The CV_8UC3 picture of an image of 8 or 16 bits with one, three or four channels, to draw upon.
cv::Mat pictureOf(const cv::Mat& image);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_PICTURE_HPP
