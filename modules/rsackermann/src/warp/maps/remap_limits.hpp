// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_REMAP_LIMITS_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_REMAP_LIMITS_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

//! Both coordinates of pixels that have no place in the other image: outside of every image, and a short as well.
const float FAR_OUTSIDE = -16384.f;

//! Whether cv::remap could find a pixel in some image; false for NaN, too.
inline bool isAddressable(const Point2d& p)
{
    return std::abs(p.x) <= SHRT_MAX && std::abs(p.y) <= SHRT_MAX;
}

//! By how much a pixel may lie outside of an image and be in it after the rounding to 1/32 pixel that cv::remap does.
const float ROUNDED_PIXEL = 1.f / 64;

//! Pixel of a ray of a camera without distortion.
inline Point2d pixelOf(const Matx33d& cameraMatrix, const Vec3d& ray)
{
    const Vec3d p = cameraMatrix * ray;
    return Point2d(p[0] / p[2], p[1] / p[2]);
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_REMAP_LIMITS_HPP
