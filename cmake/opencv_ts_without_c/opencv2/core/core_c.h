// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_OPENCV_TS_CORE_C_H
#define RSACKERMANN_OPENCV_TS_CORE_C_H

#include "opencv2/core.hpp"

// What the test framework of OpenCV 4 takes from this header of its old C interface, which OpenCV 5 doesn't have.

inline const char* cvErrorStr(int)
{
    return "error";
}

inline void cvSetErrStatus(int) {}

inline int64 cvGetTickCount()
{
    return cv::getTickCount();
}

#endif // RSACKERMANN_OPENCV_TS_CORE_C_H
