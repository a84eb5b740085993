// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_ESTIMATOR_OPTIONS_HPP
#define RSACKERMANN_SAMPLES_ESTIMATOR_OPTIONS_HPP

#include "opencv2/rsackermann/motion.hpp"
#include "options.hpp"

namespace rsackermann_samples {

//! The words for cv::rsackermann::SegmentDetector, in its order.
extern const std::vector<std::string> DETECTOR_WORDS;

//! Key of the option that readDetector() takes.
extern const char* const DETECTOR_KEY;

//! One of cv::rsackermann::SegmentDetector.
int readDetector(const Options& options);

//! One of cv::rsackermann::MotionModel.
int readModel(const Options& options);

//! Standard deviations of values that are given without one, km/h and deg/s.
const double SPEED_SIGMA = 2, YAW_RATE_SIGMA = 1;

//! Keys of the options that readPriorOptions() takes.
extern const char* const PRIOR_KEYS;

//! The speed and the yaw rate that options give.
cv::rsackermann::MotionPrior readPriorOptions(const Options& options);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_ESTIMATOR_OPTIONS_HPP
