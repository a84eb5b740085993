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
    Vec<double, PARAMETERS> derivative;

    Jet(double v = 0) : value(v) {}
    Jet(double v, const Vec<double, PARAMETERS>& d) : value(v), derivative(d) {}

    static Jet variable(double v, Parameter p)
    {
        Jet j(v);
        j.derivative[p] = 1;
        return j;
    }

    //! f(x) of this jet x, given the value and the derivative of f there.
    Jet apply(double f, double slope) const { return Jet(f, slope * derivative); }
};

inline Jet operator+(const Jet& x, const Jet& y)
{
    return Jet(x.value + y.value, x.derivative + y.derivative);
}
inline Jet operator-(const Jet& x, const Jet& y)
{
    return Jet(x.value - y.value, x.derivative - y.derivative);
}
inline Jet operator/(const Jet& x, const Jet& y)
{
    const double q = x.value / y.value;
    return Jet(q, (x.derivative - q * y.derivative) * (1 / y.value));
}
inline Jet operator*(double a, const Jet& x)
{
    return x.apply(a * x.value, a);
}

inline Jet length(const Jet& x, const Jet& y)
{
    const double l = std::sqrt(x.value * x.value + y.value * y.value);
    return l > 0 ? Jet(l, (x.value / l) * x.derivative + (y.value / l) * y.derivative) : Jet();
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_JET_HPP
