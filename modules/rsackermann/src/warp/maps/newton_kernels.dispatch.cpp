// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "newton_kernels.hpp"

#include "newton_kernels.simd.hpp"
#include "warp/maps/newton_kernels.simd_declarations.hpp"

namespace cv { namespace rsackermann {

void searchDepthPatch(const DepthPatch& patch, const Mat1f& depths, float start, const Point& first, const Size& size,
                      float* x, float* y, size_t step)
{
    CV_CPU_DISPATCH(searchDepthPatch, (patch, depths, start, first, size, x, y, step), CV_CPU_DISPATCH_MODES_ALL);
}

}} // namespace cv::rsackermann
