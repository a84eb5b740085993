// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_JET_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_JET_HPP

#include "../motion/model.hpp"
#include <cmath>

namespace cv { namespace rsackermann {

//! A number with its derivatives by the parameters: exact Jacobians by the chain rule.
struct Jet
{
    double value;
    double derivative[PARAMETERS];

    Jet(double v = 0) : value(v) { std::fill(derivative, derivative + PARAMETERS, 0.); }

    static Jet variable(double v, Parameter p)
    {
        Jet j(v);
        j.derivative[p] = 1;
        return j;
    }

    //! f(x) of this jet x, given the value and the derivative of f there.
    Jet apply(double f, double slope) const
    {
        Jet r(f);
        for (int i = 0; i < PARAMETERS; i++)
            r.derivative[i] = slope * derivative[i];
        return r;
    }
};

//! a x + b y of the derivatives, with the given value.
inline Jet combine(double value, double a, const Jet& x, double b, const Jet& y)
{
    Jet r(value);
    for (int i = 0; i < PARAMETERS; i++)
        r.derivative[i] = a * x.derivative[i] + b * y.derivative[i];
    return r;
}

inline Jet operator+(const Jet& x, const Jet& y)
{
    return combine(x.value + y.value, 1, x, 1, y);
}
inline Jet operator-(const Jet& x, const Jet& y)
{
    return combine(x.value - y.value, 1, x, -1, y);
}
inline Jet operator/(const Jet& x, const Jet& y)
{
    const double q = x.value / y.value;
    return combine(q, 1 / y.value, x, -q / y.value, y);
}
inline Jet operator*(double a, const Jet& x)
{
    return x.apply(a * x.value, a);
}

inline Jet length(const Jet& x, const Jet& y)
{
    const double l = std::sqrt(x.value * x.value + y.value * y.value);
    return l > 0 ? combine(l, x.value / l, x, y.value / l, y) : Jet();
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_JET_HPP
