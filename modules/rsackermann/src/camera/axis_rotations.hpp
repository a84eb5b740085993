// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CAMERA_AXIS_ROTATIONS_HPP
#define OPENCV_RSACKERMANN_SRC_CAMERA_AXIS_ROTATIONS_HPP

#include "opencv2/core.hpp"
#include <cmath>

namespace cv { namespace rsackermann {

//! Camera frame to upright frame of a camera with that roll, positive if it is turned clockwise seen from behind.
inline Matx33d rollRotation(double roll)
{
    const double c = std::cos(roll), s = std::sin(roll);
    return Matx33d(c, -s, 0, s, c, 0, 0, 0, 1);
}

//! Camera frame to upright frame of a camera with that pitch, positive if it looks down.
inline Matx33d pitchRotation(double pitch)
{
    const double c = std::cos(pitch), s = std::sin(pitch);
    return Matx33d(1, 0, 0, 0, c, s, 0, -s, c);
}

//! Camera frame to upright frame of a camera with that roll and pitch.
inline Matx33d tiltRotation(double roll, double pitch)
{
    return rollRotation(roll) * pitchRotation(pitch);
}

//! Frame of a camera that has turned right by that yaw to the frame before.
inline Matx33d yawRotation(double yaw)
{
    const double c = std::cos(yaw), s = std::sin(yaw);
    return Matx33d(c, 0, s, 0, 1, 0, -s, 0, c);
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CAMERA_AXIS_ROTATIONS_HPP
