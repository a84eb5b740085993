// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SIMD_HPP
#define OPENCV_RSACKERMANN_SRC_SIMD_HPP

#include "opencv2/core/hal/intrin.hpp"

// The names that universal intrinsics have had since OpenCV 4.7, for the versions before.
#if CV_SIMD && !defined(CV_SIMD_SCALABLE)

namespace cv {
CV_CPU_OPTIMIZATION_HAL_NAMESPACE_BEGIN

template <typename V>
struct VTraits
{
    static inline int vlanes() { return V::nlanes; }
    enum { max_nlanes = V::nlanes };
};

template <typename V> inline V v_add(const V& a, const V& b) { return a + b; }
template <typename V> inline V v_sub(const V& a, const V& b) { return a - b; }
template <typename V> inline V v_mul(const V& a, const V& b) { return a * b; }
template <typename V> inline V v_div(const V& a, const V& b) { return a / b; }
template <typename V> inline V v_and(const V& a, const V& b) { return a & b; }
template <typename V> inline V v_lt(const V& a, const V& b) { return a < b; }
template <typename V> inline V v_gt(const V& a, const V& b) { return a > b; }
template <typename V> inline V v_ge(const V& a, const V& b) { return a >= b; }
template <typename V> inline V v_le(const V& a, const V& b) { return a <= b; }

CV_CPU_OPTIMIZATION_HAL_NAMESPACE_END
} // namespace cv

#endif

#endif // OPENCV_RSACKERMANN_SRC_SIMD_HPP
