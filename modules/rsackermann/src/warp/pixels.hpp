// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_PIXELS_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_PIXELS_HPP

#include "opencv2/core.hpp"

namespace cv {
namespace rsackermann {

//! Both coordinates of pixels that have no place in the other image: outside of every image, and a short as well.
const float FAR_OUTSIDE = -16384.f;

//! Whether cv::remap could find a pixel in some image; false for NaN, too.
inline bool isAddressable(const Point2d& p)
{
    return std::abs(p.x) <= SHRT_MAX && std::abs(p.y) <= SHRT_MAX;
}

//! Whether a pixel is in the image after the rounding to 1/32 pixel that cv::remap does.
inline bool isInImage(float x, float y, const Size& size)
{
    const float slack = 1.f / 64;
    return x >= -slack && y >= -slack && x <= float(size.width - 1) + slack && y <= float(size.height - 1) + slack;
}

//! Pixel of a ray of a camera without distortion.
inline Point2d pixelOf(const Matx33d& cameraMatrix, const Vec3d& ray)
{
    const Vec3d p = cameraMatrix * ray;
    return Point2d(p[0] / p[2], p[1] / p[2]);
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_PIXELS_HPP
