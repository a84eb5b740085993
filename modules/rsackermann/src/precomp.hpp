// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_PRECOMP_HPP
#define OPENCV_RSACKERMANN_PRECOMP_HPP

#include "opencv2/rsackermann.hpp"
#include "opencv2/opencv_modules.hpp"
#include "opencv2/core/utils/logger.hpp"

// OpenCV doesn't install its private headers: a build against an installed OpenCV uses what is public.
#ifdef __OPENCV_BUILD
#include "opencv2/core/private.hpp"
#else
#include "opencv2/core/utils/trace.hpp"
#define CV_INSTRUMENT_REGION() CV_TRACE_FUNCTION()
#endif

#endif // OPENCV_RSACKERMANN_PRECOMP_HPP
