// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_TEST_RSACKERMANN_BOX_DEPTH_HPP
#define OPENCV_TEST_RSACKERMANN_BOX_DEPTH_HPP

#include "opencv2/core.hpp"

namespace opencv_test {

//! Depth in metres of a wall, a road and of boxes in front of them.
inline cv::Mat makeBoxDepth(const cv::Size& size)
{
    cv::Mat1f depth(size);
    for (int y = 0; y < size.height; y++)
        for (int x = 0; x < size.width; x++)
        {
            const float wall = std::max(0.01f, std::abs(2.f * x / size.width - 1)) / 6,
                        road = std::max(0.f, 2.f * y / size.height - 1) / 3;
            depth(y, x) = 1 / std::max(wall, road);
        }
    for (int i = 0; i < 8; i++)
        depth(cv::Rect(size.width * i / 8, size.height * 2 / 5, size.width / 20, size.height / 5)).setTo(3 + 0.3 * i);
    return std::move(depth);
}

} // namespace opencv_test

#endif // OPENCV_TEST_RSACKERMANN_BOX_DEPTH_HPP
