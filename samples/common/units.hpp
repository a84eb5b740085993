// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_UNITS_HPP
#define RSACKERMANN_SAMPLES_UNITS_HPP

#include "opencv2/core/cvdef.h"

namespace rsackermann_samples {

//! The programs' units in those of the library: radians, and metres per second.
const double DEGREE = CV_PI / 180, KMH = 1 / 3.6;

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_UNITS_HPP
