// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CAMERA_RAYS_HPP
#define OPENCV_RSACKERMANN_SRC_CAMERA_RAYS_HPP

#include "opencv2/rsackermann/camera.hpp"

namespace cv { namespace rsackermann {

//! Least depth of a direction that counts as ahead, of its length; and of a depth, of that at the reference row.
const double IN_FRONT = 0.1;

//! Raw pixels to undistorted rays (x, y, 1) of the camera frame; finite, but meaningless if the lens model has none.
void undistortedRays(const RollingShutterCamera& camera, const std::vector<Point2d>& raw, std::vector<Point2d>& rays);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CAMERA_RAYS_HPP
