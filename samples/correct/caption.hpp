// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_CAPTION_HPP
#define RSACKERMANN_SAMPLES_CAPTION_HPP

#include "opencv2/rsackermann.hpp"

namespace rsackermann_samples {

//! What is expected of a correction, or why the image is left unchanged: one line of ASCII.
std::string captionOf(const cv::rsackermann::AckermannMotion& motion);

//! Writes a line at the bottom of a CV_8UC3 image, white with a black outline, no wider than the image.
void drawCaption(cv::Mat& image, const std::string& caption);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_CAPTION_HPP
