// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "depth_kernels.hpp"

#include "depth_kernels.simd.hpp"
#include "warp/depth/depth_kernels.simd_declarations.hpp"

namespace cv { namespace rsackermann {

bool invertDepths(const float* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse)
{
    CV_CPU_DISPATCH(invertDepths, (depths, width, unitsPerMetre, nearest, farthest, inverse),
                    CV_CPU_DISPATCH_MODES_ALL);
}

bool invertDepths(const ushort* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse)
{
    CV_CPU_DISPATCH(invertDepths, (depths, width, unitsPerMetre, nearest, farthest, inverse),
                    CV_CPU_DISPATCH_MODES_ALL);
}

void findRange(const Mat1f& values, float& low, float& high)
{
    CV_CPU_DISPATCH(findRange, (values, low, high), CV_CPU_DISPATCH_MODES_ALL);
}

void findColumnRanges(const Mat1f& image, int first, int last, float* low, float* high, float* across, float* down)
{
    CV_CPU_DISPATCH(findColumnRanges, (image, first, last, low, high, across, down), CV_CPU_DISPATCH_MODES_ALL);
}

}} // namespace cv::rsackermann
