// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CAMERA_AXIS_ROTATIONS_HPP
#define OPENCV_RSACKERMANN_SRC_CAMERA_AXIS_ROTATIONS_HPP

#include "opencv2/core.hpp"
#include <cmath>

namespace cv { namespace rsackermann {

//! Camera frame to upright frame of a camera that is turned clockwise, seen from behind, by a roll, and down by a
//! pitch.
inline Matx33d tiltRotation(double sinRoll, double cosRoll, double sinPitch, double cosPitch)
{
    return Matx33d(cosRoll, -sinRoll * cosPitch, -sinRoll * sinPitch, sinRoll, cosRoll * cosPitch, cosRoll * sinPitch,
                   0, -sinPitch, cosPitch);
}

//! The same, by the angles.
inline Matx33d tiltRotation(double roll, double pitch)
{
    return tiltRotation(std::sin(roll), std::cos(roll), std::sin(pitch), std::cos(pitch));
}

//! Frame of a camera that has turned right by that yaw to the frame before.
inline Matx33d yawRotation(double yaw)
{
    const double c = std::cos(yaw), s = std::sin(yaw);
    return Matx33d(c, 0, s, 0, 1, 0, -s, 0, c);
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CAMERA_AXIS_ROTATIONS_HPP
