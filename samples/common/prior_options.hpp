// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_PRIOR_OPTIONS_HPP
#define RSACKERMANN_SAMPLES_PRIOR_OPTIONS_HPP

#include "opencv2/rsackermann/motion.hpp"
#include "options.hpp"

namespace rsackermann_samples {

//! Standard deviations of values that are given without one, km/h and deg/s.
const double SPEED_SIGMA = 2, YAW_RATE_SIGMA = 1;

//! Keys of the options that readPriorOptions() takes.
extern const char* const PRIOR_KEYS;

//! The speed and the yaw rate that options give.
cv::rsackermann::MotionPrior readPriorOptions(const Options& options);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_PRIOR_OPTIONS_HPP
