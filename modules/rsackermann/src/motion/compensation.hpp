// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_MOTION_COMPENSATION_HPP
#define OPENCV_RSACKERMANN_SRC_MOTION_COMPENSATION_HPP

#include "opencv2/rsackermann/solvers.hpp"
#include "model.hpp"
#include <cmath>

namespace cv { namespace rsackermann {

// A row turns the camera by a small angle, for which series are exact to double precision: up to this limit the first
// terms left out are below x^12/13!, x^12/12! and x^11/13!, 1e-17, 1.3e-16 and 4e-17. T is double or a vector of them.
const double LARGEST_IN_SERIES = 0.25;

template <class T>
void sincAndCosSeries(const T& x, T& sincX, T& cosX)
{
    const T q = x * x;
    sincX =
        T(1) + q * (T(-1. / 6) + q * (T(1. / 120) + q * (T(-1. / 5040) + q * (T(1. / 362880) - q * (1. / 39916800)))));
    cosX = T(1) + q * (T(-1. / 2) + q * (T(1. / 24) + q * (T(-1. / 720) + q * (T(1. / 40320) - q * (1. / 3628800)))));
}

//! Derivative of sinc.
template <class T>
T sincDerivativeSeries(const T& x)
{
    const T q = x * x;
    return x * (T(-1. / 3) + q * (T(1. / 30) + q * (T(-1. / 840) + q * (T(1. / 45360) - q * (1. / 3991680)))));
}

//! sinc(x) and cos(x) of any angle.
inline void sincAndCos(double x, double& sincX, double& cosX)
{
    if (std::abs(x) <= LARGEST_IN_SERIES)
        sincAndCosSeries(x, sincX, cosX);
    else
    {
        sincX = std::sin(x) / x;
        cosX = std::cos(x);
    }
}

//! The direction in which the vehicle drives, with its cosine and sine at hand; angles turn into it.
struct Heading
{
    double angle, c, s;

    Heading(double a) : angle(a), c(std::cos(a)), s(std::sin(a)) {}

    //! Whether the camera looks along the vehicle's course, forward or backward, rather than across it.
    bool looksAlong() const { return std::abs(c) > 0.5; }
};

//! Whether the first wall of a motion is to the right of the direction of travel.
inline bool isFirstWallRight(const Model& m, const Heading& heading)
{
    return m.direction * (m[P_B] * heading.c + m[P_D] * heading.s) < 0;
}

//! Whether it is the only one, too.
inline bool hasRightWallOnly(const Model& m, const Heading& heading)
{
    return m[P_LAMBDA] == 0 && isFirstWallRight(m, heading);
}

//! The same motion with the left one of two walls as the first.
inline Model withLeftWallFirst(Model m, const Heading& heading)
{
    if (m[P_LAMBDA] > 0 && isFirstWallRight(m, heading))
    {
        m[P_B] *= -m[P_LAMBDA];
        m[P_D] *= -m[P_LAMBDA];
        m[P_LAMBDA] = 1 / m[P_LAMBDA];
    }
    return m;
}

/** The exact motion at one row time (doc/theory.md, "Motion"). T is double or a vector of them.

Yaw theta = 2 alpha t; position beta tau (s2, 0, c2) with tau = t sinc(theta/2).
*/
template <class T>
struct RowMotionOf
{
    T c, s;   // cos, sin of theta
    T c2, s2; // cos, sin of theta/2 + heading
    T tau;

    RowMotionOf() {}

    //! @param half alpha t, with its sinc and cosine, which numbers and vectors find in different ways.
    RowMotionOf(const T& half, const T& sincHalf, const T& cosHalf, const Heading& heading, const T& t)
    {
        const T sinHalf = half * sincHalf;
        c = T(1) - T(2) * sinHalf * sinHalf;
        s = T(2) * sinHalf * cosHalf;
        c2 = cosHalf * heading.c - sinHalf * heading.s;
        s2 = sinHalf * heading.c + cosHalf * heading.s;
        tau = t * sincHalf;
    }

    //! Of a number.
    RowMotionOf(double alpha, const Heading& heading, double t)
    {
        const double half = alpha * t;
        double sincHalf, cosHalf;
        sincAndCos(half, sincHalf, cosHalf);
        *this = RowMotionOf(half, sincHalf, cosHalf, heading, t);
    }

    //! Turns the horizontal part (x, z) of a bearing into the reference frame.
    void turn(const T& x, const T& z, T& N, T& M) const
    {
        N = c * x + s * z;
        M = c * z - s * x;
    }

    //! Part of the horizontal direction (N, M) across that of the camera's place.
    T across(const T& N, const T& M) const { return M * s2 - N * c2; }
};

typedef RowMotionOf<double> RowMotion;

/** A bearing turned into the reference frame, and how it shifts with the scaled inverse depth.

With the direction (N, M) of the rotated bearing in the horizontal plane, X = N/M and g = gamma/M, the compensated
column on the wall w = D - B x is p1 = (X + g D) / (1 + g B) = (N + gamma D) / (M + gamma B) (doc/theory.md,
"Compensation"). This form has no poles, and (N, M, gamma) scale with the length of the bearing.
*/
struct RotatedBearing
{
    double N, M, gamma;

    RotatedBearing() : N(0), M(0), gamma(0) {}
    RotatedBearing(const HorizontalBearing& bearing, const RowMotion& row)
    {
        row.turn(bearing.x, bearing.z, N, M);
        gamma = row.tau * row.across(N, M);
    }

    double column(double B, double D) const { return (N + gamma * D) / (M + gamma * B); }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_MOTION_COMPENSATION_HPP
