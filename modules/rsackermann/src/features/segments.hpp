// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FEATURES_SEGMENTS_HPP
#define OPENCV_RSACKERMANN_SRC_FEATURES_SEGMENTS_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

//! A caller's segments, N x 4 or N x 1 with four channels, as N x 4 CV_64F; throws for everything else.
Mat segmentRows(InputArray segments, const char* name = "segments");

//! Returns N x 4 segments to a caller: as N x 4 CV_32F, or in the four-channel type of the caller's array, such as
//! vector<Vec4f>.
void returnSegments(const Mat& rows, OutputArray segments);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_SEGMENTS_HPP
