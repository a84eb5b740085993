// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_SEARCH_KERNELS_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_SEARCH_KERNELS_HPP

#include "depth_patch.hpp"

// Searches in the depths of an image, in vectors. The widest ones read single values more slowly than two half as wide.

namespace cv { namespace rsackermann {

/** A part of a patch with the inverse depths of the other image, in which there are several surfaces, each pixel of its
own.
@param depths all of the other image, at least 2 x 2.
@param low, high inverse depths between which they are.
@param first pixel of the patch.
@param mask of the pixels, in which those are marked that the other image doesn't show; or empty. */
void searchSurfaces(const DepthPatch& patch, const Mat1f& depths, float low, float high, const Point& first,
                    const Coordinates& to, Mat1b& mask);

/** Which pixels of a block something in front hides from the other image.
@param patch, first of the other image's pixels in the map's own image.
@param depths all of the map's own image.
@param high the largest inverse depth that can be in front.
@param distance pixels within which surfaces hide nothing of one another.
@param start first pixel of the block.
@param shown places of its pixels.
@param last pixel of the other image: what is outside of it counts as seen.
@param mask of the block, in which they are marked. */
void findHidden(const DepthPatch& patch, const Point& first, const Mat1f& depths, float high, float distance,
                const Point& start, const Coordinates& shown, const Point2f& last, Mat1b& mask);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_SEARCH_KERNELS_HPP
