// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_SIMULATED_GYRO_HPP
#define RSACKERMANN_SAMPLES_SIMULATED_GYRO_HPP

#include "opencv2/core.hpp"
#include <functional>

namespace street {

//! A gyro on a camera, and its errors.
struct SimulatedGyro
{
    double rate;    //!< samples per second
    double noise;   //!< standard deviation of a sample, radians per second
    cv::Vec3d bias; //!< radians per second that it shows too much
    double delay;   //!< seconds by which its clock is ahead
    unsigned seed;  //!< of the noise

    SimulatedGyro() : rate(200), noise(0), delay(0), seed(0) {}

    /** What it shows.
    @param trueRates radians per second about the camera's axes at a time. @param begin,end seconds on the true clock.
    @param times seconds on the gyro's clock, N x 1, CV_64F. @param rates N x 3, CV_64F. */
    void measure(const std::function<cv::Vec3d(double)>& trueRates, double begin, double end, cv::Mat& times,
                 cv::Mat& rates) const;
};

} // namespace street

#endif // RSACKERMANN_SAMPLES_SIMULATED_GYRO_HPP
