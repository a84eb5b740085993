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

//! Of a part of a row.
static inline void prefetchRow(const void* first, size_t bytes)
{
    const size_t line = 64; // bytes that come together
    for (size_t i = 0; i < bytes; i += line)
        prefetch(static_cast<const char*>(first) + i);
}

//! Of both parts of a map, some rows below the present one of a tile: writing there would wait for it.
static inline void prefetchMap(const float* x, const float* y, const Size& size, int row, size_t step)
{
    const int rowsAhead = 4;
    if (row + rowsAhead >= size.height)
        return;
    prefetchRow(x + rowsAhead * step, size.width * sizeof(float));
    prefetchRow(y + rowsAhead * step, size.width * sizeof(float));
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_PREFETCH_HPP
