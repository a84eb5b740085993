// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CAMERA_LINE_DELAY_SIGMA_HPP
#define OPENCV_RSACKERMANN_SRC_CAMERA_LINE_DELAY_SIGMA_HPP

#include "opencv2/rsackermann/camera.hpp"

namespace cv { namespace rsackermann {

//! Standard deviation of the line delay over its value: that of what changes between row time and seconds.
inline double relativeLineDelaySigma(const RollingShutterCamera& camera)
{
    return camera.lineDelay > 0 ? camera.lineDelaySigma / camera.lineDelay : 0;
}

//! Standard deviation in row time of a rate that is given per second, for each second of it.
inline double rateSigma(const RollingShutterCamera& camera, double rate, double sigma)
{
    return std::hypot(sigma, rate * relativeLineDelaySigma(camera));
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CAMERA_LINE_DELAY_SIGMA_HPP
