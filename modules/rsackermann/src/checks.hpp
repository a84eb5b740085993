// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CHECKS_HPP
#define OPENCV_RSACKERMANN_SRC_CHECKS_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

//! Of what a caller tells: its powers, and quotients of two of them, are finite.
const double LARGEST_VALUE = 1e30;

//! Throws unless the value is finite, and not absurd.
inline void checkFinite(double value, const char* name)
{
    if (!(std::abs(value) <= LARGEST_VALUE))
        CV_Error(Error::StsBadArg,
                 format("%s is %g; a finite number up to %g is expected", name, value, LARGEST_VALUE));
}

//! Throws unless the value is finite and greater than 0.
inline void checkPositive(double value, const char* name)
{
    if (!(value >= 1 / LARGEST_VALUE && value <= LARGEST_VALUE))
        CV_Error(Error::StsBadArg,
                 format("%s is %g; a positive number up to %g is expected", name, value, LARGEST_VALUE));
}

//! Throws unless the value is finite and 0 or greater; 0 has the given meaning.
inline void checkNotNegative(double value, const char* name, const char* meaningOfZero)
{
    if (value != 0 && !(value >= 1 / LARGEST_VALUE && value <= LARGEST_VALUE))
        CV_Error(Error::StsBadArg, format("%s is %g; a positive number up to %g, or 0 for %s, is expected", name, value,
                                          LARGEST_VALUE, meaningOfZero));
}

//! Throws unless the value is finite and within the limits, which belong to the range.
inline void checkRange(double value, double low, double high, const char* name)
{
    checkFinite(value, name);
    if (value < low || value > high)
        CV_Error(Error::StsBadArg, format("%s is %g; a number from %g to %g is expected", name, value, low, high));
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CHECKS_HPP
