// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_TEST_RSACKERMANN_RANDOM_HPP
#define OPENCV_TEST_RSACKERMANN_RANDOM_HPP

#include "opencv2/core.hpp"

namespace opencv_test {

// In which order the arguments of a call are evaluated is the compiler's choice: two random numbers among them would
// make other data with each.

//! A point of a rectangle; y is drawn first.
inline cv::Point2d uniformPoint(cv::RNG& rng, const cv::Point2d& low, const cv::Point2d& high)
{
    const double y = rng.uniform(low.y, high.y), x = rng.uniform(low.x, high.x);
    return cv::Point2d(x, y);
}

//! A point around the origin; y is drawn first.
inline cv::Point2d gaussianPoint(cv::RNG& rng, double sigma)
{
    const double y = rng.gaussian(sigma), x = rng.gaussian(sigma);
    return cv::Point2d(x, y);
}

} // namespace opencv_test

#endif // OPENCV_TEST_RSACKERMANN_RANDOM_HPP
