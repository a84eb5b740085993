// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAP_KERNELS_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAP_KERNELS_HPP

#include "depth_patch.hpp"

// The work on every pixel of a map, in vectors of the widest kind that the processor has.

namespace cv { namespace rsackermann {

/** The pixels of a square from its first one on, each from the nearest plane.
@param patches one for each plane.
@param depths of the planes: the pixel takes the patch with the largest.
@param count of planes. */
void evaluatePatches(const MapPatch* patches, const Bicubic* depths, int count, const Coordinates& to);

//! The same with an inverse depth of each pixel.
void evaluateDepthPatch(const DepthPatch& patch, const Mat1f& depths, const Coordinates& to);

/** A part of a patch with the inverse depths of the other image, which differ so little that a pixel shows one surface
only.
@param depths all of the other image, at least 2 x 2.
@param start a depth in the middle of all that can be met.
@param first pixel of the patch. */
void searchDepthPatch(const DepthPatch& patch, const Mat1f& depths, float start, const Point& first,
                      const Coordinates& to);

//! A row of coordinates in the formats CV_16SC2 and CV_16UC1, with INTER_BITS fractional bits; whole parts are
//! saturated.
void packFixedPoint(const float* x, const float* y, int width, short* whole, ushort* fraction);

//! 0 in the mask unless low <= x <= highX and low <= y <= highY.
void packMask(const float* x, const float* y, int width, float low, float highX, float highY, uchar* mask);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAP_KERNELS_HPP
