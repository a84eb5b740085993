// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_TEST_SAMPLES_TURNING_DRIVE_HPP
#define RSACKERMANN_TEST_SAMPLES_TURNING_DRIVE_HPP

#include "opencv2/core.hpp"

namespace opencv_test {

//! Rolling-shutter frames of a camera that turns at a constant rate inside of a cylinder with a texture.
struct TurningDrive
{
    const cv::Size size = cv::Size(640, 380);
    const double focal = 816, readout = 0.03, interval = 1. / 30; // pixels, seconds
    const double yawRate = 20;                                    // deg/s

    //! The image whose middle row is read at a time in seconds.
    cv::Mat frame(double time) const;
};

} // namespace opencv_test

#endif // RSACKERMANN_TEST_SAMPLES_TURNING_DRIVE_HPP
