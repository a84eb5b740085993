// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "edge_kernels.hpp"

#include "edge_kernels.simd.hpp"
#include "features/edge_kernels.simd_declarations.hpp"

namespace cv { namespace rsackermann {

int findExtremes(const uchar* const (&rows)[3], int width, double least, short* buffer, EdgePoint* points)
{
    CV_CPU_DISPATCH(findExtremes, (rows, width, least, buffer, points), CV_CPU_DISPATCH_MODES_ALL);
}

EdgeMoments sumWindows(EdgeWindows& windows, float sign)
{
    CV_CPU_DISPATCH(sumWindows, (windows, sign), CV_CPU_DISPATCH_MODES_ALL);
}

ParabolaSums sumCentres(const EdgeWindows& windows, double gain, double usualSquare, double start, double spacing,
                        const ParabolaFit* line)
{
    CV_CPU_DISPATCH(sumCentres, (windows, gain, usualSquare, start, spacing, line), CV_CPU_DISPATCH_MODES_ALL);
}

}} // namespace cv::rsackermann
