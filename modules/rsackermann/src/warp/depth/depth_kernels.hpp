// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DEPTH_DEPTH_KERNELS_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DEPTH_DEPTH_KERNELS_HPP

#include "opencv2/core.hpp"

// The work on every pixel of a given depth, in vectors of the widest kind that the processor has.

namespace cv { namespace rsackermann {

/** A row of metric depths to inverse depths; what is unknown becomes NaN.
@param nearest, farthest what is known, in units of the values.
@return whether all are known. */
bool invertDepths(const float* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse);
bool invertDepths(const ushort* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse);

//! The range of some values, none of which is NaN.
void findRange(const Mat1f& values, float& low, float& high);

/** Of each column in some rows of an image the lowest and the highest value, and the largest differences to the next
column and to the next row, which may be one more than these.
@param first, last the rows. */
void findColumnRanges(const Mat1f& image, int first, int last, float* low, float* high, float* across, float* down);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DEPTH_DEPTH_KERNELS_HPP
