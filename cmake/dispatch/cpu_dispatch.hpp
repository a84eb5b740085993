// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_CPU_DISPATCH_HPP
#define RSACKERMANN_CPU_DISPATCH_HPP

// The macros of OpenCV's private headers that *.simd.hpp and *.dispatch.cpp use, for the modes BASELINE, AVX2 and
// AVX512_SKX.
// Must come before every header of OpenCV.

#ifdef CV_CPU_DISPATCH_MODE

// Tells the universal intrinsics what the compiler may use; they then are 256 or 512 bits wide.
#include <immintrin.h>
#define CV_SSE3 1
#define CV_SSSE3 1
#define CV_SSE4_1 1
#define CV_SSE4_2 1
#define CV_POPCNT 1
#define CV_AVX 1
#define CV_AVX2 1
#define CV_FMA3 1
#ifdef __AVX512BW__
#define CV_AVX_512F 1
#define CV_AVX_512CD 1
#define CV_AVX_512BW 1
#define CV_AVX_512DQ 1
#define CV_AVX_512VL 1
#define CV_AVX512_SKX 1
#endif

#define CV_CPU_OPTIMIZATION_NAMESPACE __CV_CAT(opt_, CV_CPU_DISPATCH_MODE)
#define CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN                                                                            \
    namespace __CV_CAT(opt_, CV_CPU_DISPATCH_MODE)                                                                     \
    {

#else

#define CV_CPU_BASELINE_MODE 1
#define CV_CPU_OPTIMIZATION_NAMESPACE cpu_baseline
#define CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN namespace cpu_baseline {

#endif

#define CV_CPU_OPTIMIZATION_NAMESPACE_END }

#include "opencv2/core/utility.hpp"

// CV_CPU_DISPATCH(function, (arguments), AVX2, BASELINE) returns what the first mode that the processor can run
// returns.
#define CV_CPU_CALL_AVX2(fn, args)                                                                                     \
    if (cv::checkHardwareSupport(CV_CPU_AVX2) && cv::checkHardwareSupport(CV_CPU_FMA3))                                \
    return (opt_AVX2::fn args)
#define CV_CPU_CALL_AVX512_SKX(fn, args)                                                                               \
    if (cv::checkHardwareSupport(CV_CPU_AVX512_SKX))                                                                   \
    return (opt_AVX512_SKX::fn args)
#define __CV_CPU_DISPATCH_CHAIN_BASELINE(fn, args, mode, ...) return (cpu_baseline::fn args)
#define __CV_CPU_DISPATCH_CHAIN_AVX2(fn, args, mode, ...)                                                              \
    CV_CPU_CALL_AVX2(fn, args);                                                                                        \
    __CV_EXPAND(__CV_CPU_DISPATCH_CHAIN_##mode(fn, args, __VA_ARGS__))
#define __CV_CPU_DISPATCH_CHAIN_AVX512_SKX(fn, args, mode, ...)                                                        \
    CV_CPU_CALL_AVX512_SKX(fn, args);                                                                                  \
    __CV_EXPAND(__CV_CPU_DISPATCH_CHAIN_##mode(fn, args, __VA_ARGS__))
#define __CV_CPU_DISPATCH(fn, args, mode, ...) __CV_EXPAND(__CV_CPU_DISPATCH_CHAIN_##mode(fn, args, __VA_ARGS__))
#define __CV_CPU_DISPATCH_EXPAND(fn, args, ...) __CV_EXPAND(__CV_CPU_DISPATCH(fn, args, __VA_ARGS__))
#define CV_CPU_DISPATCH(fn, args, ...) __CV_CPU_DISPATCH_EXPAND(fn, args, __VA_ARGS__, END)

#endif // RSACKERMANN_CPU_DISPATCH_HPP
