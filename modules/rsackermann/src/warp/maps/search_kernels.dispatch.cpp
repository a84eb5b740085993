// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "search_kernels.hpp"

#include "search_kernels.simd.hpp"
#include "warp/maps/search_kernels.simd_declarations.hpp"

namespace cv { namespace rsackermann {

void searchSurfaces(const DepthPatch& patch, const Mat1f& depths, float low, float high, const Point& first,
                    const Coordinates& to, Mat1b& mask)
{
    CV_CPU_DISPATCH(searchSurfaces, (patch, depths, low, high, first, to, mask), CV_CPU_DISPATCH_MODES_ALL);
}

void findHidden(const DepthPatch& patch, const Point& first, const Mat1f& depths, float high, float distance,
                const Point& start, const Coordinates& shown, const Point2f& last, Mat1b& mask)
{
    CV_CPU_DISPATCH(findHidden, (patch, first, depths, high, distance, start, shown, last, mask),
                    CV_CPU_DISPATCH_MODES_ALL);
}

}} // namespace cv::rsackermann
