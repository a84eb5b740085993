// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_ESTIMATOR_JET_HPP
#define OPENCV_RSACKERMANN_SRC_ESTIMATOR_JET_HPP

#include "../compensation.hpp"
#include "model.hpp"

namespace cv {
namespace rsackermann {

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

//! The variable as a number of type T, with or without derivatives.
template <class T> T makeVariable(double value, Parameter p);
template <> inline Jet makeVariable<Jet>(double value, Parameter p) { return Jet::variable(value, p); }
template <> inline double makeVariable<double>(double value, Parameter) { return value; }

inline double valueOf(const Jet& x) { return x.value; }
inline double valueOf(double x) { return x; }

//! a x + b y of the derivatives, with the given value.
inline Jet combine(double value, double a, const Jet& x, double b, const Jet& y)
{
    Jet r(value);
    for (int i = 0; i < PARAMETERS; i++)
        r.derivative[i] = a * x.derivative[i] + b * y.derivative[i];
    return r;
}

inline Jet operator+(const Jet& x, const Jet& y) { return combine(x.value + y.value, 1, x, 1, y); }
inline Jet operator-(const Jet& x, const Jet& y) { return combine(x.value - y.value, 1, x, -1, y); }
inline Jet operator*(const Jet& x, const Jet& y) { return combine(x.value * y.value, y.value, x, x.value, y); }
inline Jet operator/(const Jet& x, const Jet& y)
{
    const double q = x.value / y.value;
    return combine(q, 1 / y.value, x, -q / y.value, y);
}
inline Jet operator-(const Jet& x) { return x.apply(-x.value, -1); }
inline Jet operator*(double a, const Jet& x) { return x.apply(a * x.value, a); }
inline Jet sin(const Jet& x) { return x.apply(std::sin(x.value), std::cos(x.value)); }
inline Jet cos(const Jet& x) { return x.apply(std::cos(x.value), -std::sin(x.value)); }
inline Jet sinc(const Jet& x) { return x.apply(sinc(x.value), sincDerivative(x.value)); }

//! sqrt(x^2 + y^2) of numbers whose squares neither overflow nor vanish; std::hypot takes its time for the others.
inline double length(double x, double y) { return std::sqrt(x * x + y * y); }
inline Jet length(const Jet& x, const Jet& y)
{
    const double l = length(x.value, y.value);
    return l > 0 ? combine(l, x.value / l, x, y.value / l, y) : Jet();
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_ESTIMATOR_JET_HPP
