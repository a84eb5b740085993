// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// For *.simd.hpp files, as simd_pack.hpp.

#include "../simd_pack.hpp"
#include "rotated_end.hpp"

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

namespace {

//! The angles of a car's motion seldom leave the range of the series: one by one.
template <class Number>
void sincTerms(const PackOf<Number>& x, PackOf<Number>& sincX, PackOf<Number>& cosX, PackOf<Number>& slope)
{
    Number angles[PackOf<Number>::COUNT], s[PackOf<Number>::COUNT], c[PackOf<Number>::COUNT], d[PackOf<Number>::COUNT];
    x.store(angles);
    sincX.store(s);
    cosX.store(c);
    slope.store(d);
    for (int i = 0; i < PackOf<Number>::COUNT; i++)
        if (std::abs(angles[i]) > LARGEST_IN_SERIES)
        {
            double exactSinc, exactCos, exactSlope;
            rsackermann::sincTerms(angles[i], exactSinc, exactCos, exactSlope);
            s[i] = Number(exactSinc);
            c[i] = Number(exactCos);
            d[i] = Number(exactSlope);
        }
    sincX = PackOf<Number>::load(s);
    cosX = PackOf<Number>::load(c);
    slope = PackOf<Number>::load(d);
}

} // namespace

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
