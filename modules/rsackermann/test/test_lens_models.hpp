// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_TEST_LENS_MODELS_HPP
#define OPENCV_RSACKERMANN_TEST_LENS_MODELS_HPP

// cv::projectPoints, cv::fisheye and cv::initUndistortRectifyMap, which the tests compare with. OpenCV 5 has split
// calib3d.

#include "opencv2/imgproc.hpp"
#include "opencv2/opencv_modules.hpp"
#ifdef HAVE_OPENCV_CALIB3D
#include "opencv2/calib3d.hpp"
#else
#include "opencv2/geometry.hpp"
#endif

#endif // OPENCV_RSACKERMANN_TEST_LENS_MODELS_HPP
