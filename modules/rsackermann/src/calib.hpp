// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CALIB_HPP
#define OPENCV_RSACKERMANN_SRC_CALIB_HPP

// Where the lens functions live: OpenCV 5 has split calib3d.
#include "opencv2/core/version.hpp"
#if CV_VERSION_MAJOR >= 5
#include "opencv2/calib.hpp"
#include "opencv2/imgproc.hpp"
#else
#include "opencv2/calib3d.hpp"
#endif

#endif // OPENCV_RSACKERMANN_SRC_CALIB_HPP
