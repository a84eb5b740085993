// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_MOTION_WORDS_HPP
#define RSACKERMANN_SAMPLES_MOTION_WORDS_HPP

#include <string>
#include <vector>

namespace rsackermann_samples {

//! The words of reports for cv::rsackermann::MotionStatus and MotionScale, in their order.
extern const std::vector<std::string> STATUS_WORDS, SCALE_WORDS;

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_MOTION_WORDS_HPP
