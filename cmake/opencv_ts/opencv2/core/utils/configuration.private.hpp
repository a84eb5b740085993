// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_OPENCV_TS_CONFIGURATION_PRIVATE_HPP
#define RSACKERMANN_OPENCV_TS_CONFIGURATION_PRIVATE_HPP

// The part of OpenCV's header of this name, which isn't installed, that opencv_ts needs.

#include "opencv2/core/cvdef.h"

namespace cv { namespace utils {

CV_EXPORTS bool getConfigurationParameterBool(const char* name, bool defaultValue);
CV_EXPORTS size_t getConfigurationParameterSizeT(const char* name, size_t defaultValue);

}} // namespace cv::utils

#endif // RSACKERMANN_OPENCV_TS_CONFIGURATION_PRIVATE_HPP
