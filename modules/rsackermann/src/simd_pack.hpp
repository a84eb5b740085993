// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// For *.simd.hpp files, which are compiled for several processors: the types in here are those of one of them.

#include "opencv_versions.hpp"

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

namespace {

#if CV_SIMD_64F

template <class Number>
struct VectorOf;
template <>
struct VectorOf<double>
{
    typedef v_float64 type;
};
template <>
struct VectorOf<float>
{
    typedef v_float32 type;
};

inline v_float64 setAll(double x, double)
{
    return vx_setall_f64(x);
}
inline v_float32 setAll(double x, float)
{
    return vx_setall_f32(float(x));
}

//! As many numbers as a vector of the processor holds; what is written for it is written for one number as well.
template <class Number>
struct PackOf
{
    typedef typename VectorOf<Number>::type Vector;
    enum { COUNT = VTraits<Vector>::max_nlanes };

    struct Mask
    {
        Vector v;
    };

    Vector v;

    PackOf() {}
    PackOf(const Vector& v_) : v(v_) {}
    PackOf(double x) : v(setAll(x, Number())) {}

    static PackOf load(const Number* p) { return vx_load(p); }
    void store(Number* p) const { v_store(p, v); }
    double sum() const { return v_reduce_sum(v); }
    friend Number largest(const PackOf& x) { return v_reduce_max(x.v); }

    friend PackOf operator+(const PackOf& a, const PackOf& b) { return v_add(a.v, b.v); }
    friend PackOf operator-(const PackOf& a, const PackOf& b) { return v_sub(a.v, b.v); }
    friend PackOf operator*(const PackOf& a, const PackOf& b) { return v_mul(a.v, b.v); }
    friend PackOf operator/(const PackOf& a, const PackOf& b) { return v_div(a.v, b.v); }
    friend PackOf multiplyAdd(const PackOf& a, const PackOf& b, const PackOf& c) { return v_fma(a.v, b.v, c.v); }
    friend Mask operator<(const PackOf& a, const PackOf& b) { return Mask{v_lt(a.v, b.v)}; }
    friend Mask operator>(const PackOf& a, const PackOf& b) { return Mask{v_gt(a.v, b.v)}; }
    friend PackOf choose(const Mask& condition, const PackOf& a, const PackOf& b)
    {
        return v_select(condition.v, a.v, b.v);
    }
    friend bool isAnyTrue(const Mask& condition) { return v_check_any(condition.v); }
    friend PackOf smaller(const PackOf& a, const PackOf& b) { return v_min(a.v, b.v); }
    friend PackOf larger(const PackOf& a, const PackOf& b) { return v_max(a.v, b.v); }
    friend PackOf squareRoot(const PackOf& x) { return v_sqrt(x.v); }
    friend PackOf magnitude(const PackOf& x) { return v_abs(x.v); }
};

#else

//! One number, if the processor has no vectors of them.
template <class Number>
struct PackOf
{
    enum { COUNT = 1 };

    typedef bool Mask;

    Number v;

    PackOf() {}
    PackOf(double x) : v(Number(x)) {}

    static PackOf load(const Number* p) { return PackOf(*p); }
    void store(Number* p) const { *p = v; }
    double sum() const { return v; }
    friend Number largest(const PackOf& x) { return x.v; }

    friend PackOf operator+(const PackOf& a, const PackOf& b) { return PackOf(a.v + b.v); }
    friend PackOf operator-(const PackOf& a, const PackOf& b) { return PackOf(a.v - b.v); }
    friend PackOf operator*(const PackOf& a, const PackOf& b) { return PackOf(a.v * b.v); }
    friend PackOf operator/(const PackOf& a, const PackOf& b) { return PackOf(a.v / b.v); }
    friend PackOf multiplyAdd(const PackOf& a, const PackOf& b, const PackOf& c) { return PackOf(a.v * b.v + c.v); }
    friend bool operator<(const PackOf& a, const PackOf& b) { return a.v < b.v; }
    friend bool operator>(const PackOf& a, const PackOf& b) { return a.v > b.v; }
    friend PackOf choose(bool condition, const PackOf& a, const PackOf& b) { return condition ? a : b; }
    friend PackOf smaller(const PackOf& a, const PackOf& b) { return PackOf(std::min(a.v, b.v)); }
    friend PackOf larger(const PackOf& a, const PackOf& b) { return PackOf(std::max(a.v, b.v)); }
    friend PackOf squareRoot(const PackOf& x) { return PackOf(std::sqrt(x.v)); }
    friend PackOf magnitude(const PackOf& x) { return PackOf(std::abs(x.v)); }
};

#endif

// All of a pack, or its first values.
template <class Number>
void storeFirst(const PackOf<Number>& values, int count, Number* to)
{
    Number all[PackOf<Number>::COUNT];
    if (count >= PackOf<Number>::COUNT)
        return values.store(to);
    values.store(all);
    std::copy(all, all + count, to);
}

// The last of the first values stands for those behind; if there are none that before them.
template <class Number>
PackOf<Number> loadFirst(const Number* from, int count)
{
    Number all[PackOf<Number>::COUNT];
    if (count >= PackOf<Number>::COUNT)
        return PackOf<Number>::load(from);
    std::fill(std::copy(from, from + count, all), all + PackOf<Number>::COUNT, from[count - 1]);
    return PackOf<Number>::load(all);
}

} // namespace

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
