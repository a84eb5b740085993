// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_PRECOMP_HPP
#define OPENCV_RSACKERMANN_PRECOMP_HPP

// Those of the core: only what needs others includes them.
#include "opencv2/rsackermann/draw.hpp"
#include "opencv2/rsackermann/estimator.hpp"
#include "opencv2/rsackermann/solvers.hpp"
#include "opencv2/rsackermann/warp.hpp"
#include "opencv2/core/utils/logger.hpp"
#include "opencv_versions.hpp"

#endif // OPENCV_RSACKERMANN_PRECOMP_HPP
