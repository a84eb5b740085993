// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_PREFETCH_HPP
#define OPENCV_RSACKERMANN_SRC_PREFETCH_HPP

namespace cv { namespace rsackermann {

//! Has the processor bring what is needed soon from memory: rows of a part of an image are far from each other.
static inline void prefetch(const void* place)
{
#ifdef __GNUC__
    __builtin_prefetch(place);
#else
    (void)place;
#endif
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_PREFETCH_HPP
