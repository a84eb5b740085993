// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_TEST_PRECOMP_HPP
#define OPENCV_RSACKERMANN_TEST_PRECOMP_HPP

#include "opencv2/ts.hpp"
#include "opencv2/rsackermann/draw.hpp"
#include "opencv2/rsackermann/estimator.hpp"
#include "opencv2/rsackermann/solvers.hpp"
#include "opencv2/rsackermann/warp.hpp"
#include "test_lens_models.hpp"
#include "test_random.hpp"

namespace opencv_test {
using namespace cv::rsackermann;
}

#endif // OPENCV_RSACKERMANN_TEST_PRECOMP_HPP
