// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_PARALLEL_LOOP_HPP
#define OPENCV_RSACKERMANN_SRC_PARALLEL_LOOP_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

//! Calls body(i) for all i from 0 to count - 1, in parallel. @param stripes of parallel_for_().
template <class Body>
void forEachInParallel(int count, const Body& body, double stripes = -1)
{
    parallel_for_(
        Range(0, count),
        [&](const Range& range) {
            for (int i = range.start; i < range.end; i++)
                body(i);
        },
        stripes);
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_PARALLEL_LOOP_HPP
