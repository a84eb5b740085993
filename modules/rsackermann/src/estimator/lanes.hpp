// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// For *.simd.hpp files, which are compiled for several processors: the types in here are those of one of them.

#include "../simd.hpp"

namespace cv {
namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

namespace {

#if CV_SIMD_64F && !defined(CV_SIMD_SCALABLE)

//! As many numbers as a vector of the processor holds; the residuals are written for it and for double.
struct Lanes
{
    enum { COUNT = VTraits<v_float64>::max_nlanes };

    v_float64 v;

    Lanes() {}
    Lanes(const v_float64& v_) : v(v_) {}
    Lanes(double x) : v(vx_setall_f64(x)) {}

    static Lanes load(const double* p) { return vx_load(p); }
    void store(double* p) const { v_store(p, v); }
    double sum() const { return v_reduce_sum(v); }
};

struct LanesMask
{
    v_float64 v;
};

inline Lanes operator+(const Lanes& a, const Lanes& b) { return v_add(a.v, b.v); }
inline Lanes operator-(const Lanes& a, const Lanes& b) { return v_sub(a.v, b.v); }
inline Lanes operator*(const Lanes& a, const Lanes& b) { return v_mul(a.v, b.v); }
inline Lanes operator/(const Lanes& a, const Lanes& b) { return v_div(a.v, b.v); }
inline LanesMask operator<(const Lanes& a, const Lanes& b) { return LanesMask{v_lt(a.v, b.v)}; }
inline LanesMask operator>(const Lanes& a, const Lanes& b) { return LanesMask{v_gt(a.v, b.v)}; }
inline Lanes choose(const LanesMask& condition, const Lanes& a, const Lanes& b) { return v_select(condition.v, a.v, b.v); }
inline bool isAnyTrue(const LanesMask& condition) { return v_check_any(condition.v); }
inline Lanes squareRoot(const Lanes& x) { return v_sqrt(x.v); }
inline Lanes magnitude(const Lanes& x) { return v_abs(x.v); }

#else

//! One number, where the processor has no vectors of them.
struct Lanes
{
    enum { COUNT = 1 };

    double v;

    Lanes() {}
    Lanes(double x) : v(x) {}

    static Lanes load(const double* p) { return *p; }
    void store(double* p) const { *p = v; }
    double sum() const { return v; }
};

inline Lanes operator+(const Lanes& a, const Lanes& b) { return a.v + b.v; }
inline Lanes operator-(const Lanes& a, const Lanes& b) { return a.v - b.v; }
inline Lanes operator*(const Lanes& a, const Lanes& b) { return a.v * b.v; }
inline Lanes operator/(const Lanes& a, const Lanes& b) { return a.v / b.v; }
typedef bool LanesMask;

inline bool operator<(const Lanes& a, const Lanes& b) { return a.v < b.v; }
inline bool operator>(const Lanes& a, const Lanes& b) { return a.v > b.v; }
inline Lanes choose(bool condition, const Lanes& a, const Lanes& b) { return condition ? a : b; }
inline bool isAnyTrue(bool condition) { return condition; }
inline Lanes squareRoot(const Lanes& x) { return std::sqrt(x.v); }
inline Lanes magnitude(const Lanes& x) { return std::abs(x.v); }

#endif

//! The angles of a car's motion seldom leave the range of the series: one by one.
inline void sincTerms(const Lanes& x, Lanes& sincX, Lanes& cosX, Lanes& slope)
{
    double angles[Lanes::COUNT], s[Lanes::COUNT], c[Lanes::COUNT], d[Lanes::COUNT];
    x.store(angles);
    sincX.store(s);
    cosX.store(c);
    slope.store(d);
    for (int i = 0; i < Lanes::COUNT; i++)
        if (std::abs(angles[i]) > LARGEST_IN_SERIES)
            rsackermann::sincTerms(angles[i], s[i], c[i], d[i]);
    sincX = Lanes::load(s);
    cosX = Lanes::load(c);
    slope = Lanes::load(d);
}

} // namespace

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
