// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_OPENCV_TS_CORE_PRIVATE_HPP
#define RSACKERMANN_OPENCV_TS_CORE_PRIVATE_HPP

// The part of OpenCV's header of this name, which isn't installed, that opencv_ts needs.

#include "opencv2/core.hpp"

namespace cv {

CV_EXPORTS const char* currentParallelFramework();
CV_EXPORTS void scalarToRawData(const Scalar& s, void* buf, int type, int unroll_to = 0);

} // namespace cv

#endif // RSACKERMANN_OPENCV_TS_CORE_PRIVATE_HPP
