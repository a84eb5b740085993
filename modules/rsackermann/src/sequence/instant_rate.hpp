// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_INSTANT_RATE_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_INSTANT_RATE_HPP

namespace cv { namespace rsackermann {

//! Seconds in which a camera shakes alike, and the bias and the delay of a gyro stay.
const double RATE_MEMORY = 10;

//! A rate at one instant with its standard deviation, per second; 0: not known.
struct InstantRate
{
    double value, sigma;

    InstantRate() : value(0), sigma(0) {}
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_INSTANT_RATE_HPP
