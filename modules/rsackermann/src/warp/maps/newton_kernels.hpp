// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_NEWTON_KERNELS_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_NEWTON_KERNELS_HPP

#include "depth_patch.hpp"

namespace cv { namespace rsackermann {

/** A part of a patch with the inverse depths of the other image, which differ so little that a pixel shows one surface
only.
@param depths all of the other image, at least 2 x 2.
@param start a depth in the middle of all that can be met.
@param first, size the pixels of the square. */
void searchDepthPatch(const DepthPatch& patch, const Mat1f& depths, float start, const Point& first, const Size& size,
                      float* x, float* y, size_t step);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_NEWTON_KERNELS_HPP
