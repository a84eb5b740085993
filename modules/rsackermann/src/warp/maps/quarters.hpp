// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_QUARTERS_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_QUARTERS_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

//! Calls use(quarter) for the four parts of a block of pixels that aren't empty.
template <class Use>
void forEachQuarter(const Rect& block, const Use& use)
{
    const Size half((block.width + 1) / 2, (block.height + 1) / 2);
    for (int k = 0; k < 4; k++)
    {
        const Rect quarter = Rect(block.tl() + Point(k % 2 * half.width, k / 2 * half.height), half) & block;
        if (!quarter.empty())
            use(quarter);
    }
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_QUARTERS_HPP
