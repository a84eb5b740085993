// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "search_kernels.hpp"

#include "search_kernels.simd.hpp"
#include "warp/maps/search_kernels.simd_declarations.hpp"

namespace cv { namespace rsackermann {

void searchSurfaces(const DepthPatch& patch, const Mat1f& depths, float low, float high, const Point& first,
                    const Size& size, float* x, float* y, size_t step, Mat1b mask)
{
    CV_CPU_DISPATCH(searchSurfaces, (patch, depths, low, high, first, size, x, y, step, mask),
                    CV_CPU_DISPATCH_MODES_ALL);
}

void findHidden(const DepthPatch& patch, const Point& first, const Mat1f& depths, float high, float distance,
                const Rect& block, const float* x, const float* y, size_t step, const Point2f& last, Mat1b mask)
{
    CV_CPU_DISPATCH(findHidden, (patch, first, depths, high, distance, block, x, y, step, last, mask),
                    CV_CPU_DISPATCH_MODES_ALL);
}

}} // namespace cv::rsackermann
