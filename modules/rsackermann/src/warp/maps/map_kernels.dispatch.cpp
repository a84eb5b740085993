// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "map_kernels.hpp"

#include "map_kernels.simd.hpp"
#include "warp/maps/map_kernels.simd_declarations.hpp"

namespace cv { namespace rsackermann {

void evaluatePatches(const MapPatch* patches, const Bicubic* depths, int count, const Coordinates& to)
{
    CV_CPU_DISPATCH(evaluatePatches, (patches, depths, count, to), CV_CPU_DISPATCH_MODES_ALL);
}

void evaluateDepthPatch(const DepthPatch& patch, const Mat1f& depths, const Coordinates& to)
{
    CV_CPU_DISPATCH(evaluateDepthPatch, (patch, depths, to), CV_CPU_DISPATCH_MODES_ALL);
}

void searchDepthPatch(const DepthPatch& patch, const Mat1f& depths, float start, const Point& first,
                      const Coordinates& to)
{
    CV_CPU_DISPATCH(searchDepthPatch, (patch, depths, start, first, to), CV_CPU_DISPATCH_MODES_ALL);
}

void packFixedPoint(const float* x, const float* y, int width, short* whole, ushort* fraction)
{
    CV_CPU_DISPATCH(packFixedPoint, (x, y, width, whole, fraction), CV_CPU_DISPATCH_MODES_ALL);
}

void packMask(const float* x, const float* y, int width, float low, float highX, float highY, uchar* mask)
{
    CV_CPU_DISPATCH(packMask, (x, y, width, low, highX, highY, mask), CV_CPU_DISPATCH_MODES_ALL);
}

}} // namespace cv::rsackermann
