// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_COMPENSATION_HPP
#define OPENCV_RSACKERMANN_SRC_COMPENSATION_HPP

#include "opencv2/core.hpp"
#include <cmath>

namespace cv {
namespace rsackermann {

//! sin(x)/x, also near 0.
inline double sinc(double x)
{
    return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x;
}

//! Derivative of sinc.
inline double sincDerivative(double x)
{
    return std::abs(x) < 1e-3 ? -x / 3 * (1 - x * x / 10) : (std::cos(x) - std::sin(x) / x) / x;
}

/** sinc(x) and cos(x). A row turns the camera by a small angle, for which the series are exact to double precision: the
first terms left out are below x^12/13! and x^12/12!, 1e-17 and 1.3e-16 at the limit.
*/
inline void sincAndCos(double x, double& sincX, double& cosX)
{
    if (std::abs(x) <= 0.25)
    {
        const double q = x * x;
        sincX = 1 - q * (1. / 6) * (1 - q * (1. / 20) * (1 - q * (1. / 42) * (1 - q * (1. / 72) * (1 - q * (1. / 110)))));
        cosX = 1 - q * (1. / 2) * (1 - q * (1. / 12) * (1 - q * (1. / 30) * (1 - q * (1. / 56) * (1 - q * (1. / 90)))));
    }
    else
    {
        sincX = std::sin(x) / x;
        cosX = std::cos(x);
    }
}

//! The direction in which the vehicle drives, with its cosine and sine at hand.
struct Heading
{
    double c, s;

    explicit Heading(double angle) : c(std::cos(angle)), s(std::sin(angle)) {}
};

/** The exact motion at one row time (doc/theory.md, "Motion").

Yaw theta = 2 alpha t; position T = beta tau (s2, 0, c2) with tau = t sinc(theta/2).
*/
struct RowMotion
{
    double c, s;   // cos, sin of theta
    double c2, s2; // cos, sin of theta/2 + heading
    double tau;

    RowMotion(double alpha, const Heading& heading, double t)
    {
        const double half = alpha * t;
        double sincHalf, cosHalf;
        sincAndCos(half, sincHalf, cosHalf);
        const double sinHalf = half * sincHalf;
        c = 1 - 2 * sinHalf * sinHalf;
        s = 2 * sinHalf * cosHalf;
        c2 = cosHalf * heading.c - sinHalf * heading.s;
        s2 = sinHalf * heading.c + cosHalf * heading.s;
        tau = t * sincHalf;
    }

    //! Without yaw.
    RowMotion(const Heading& heading, double t) : c(1), s(0), c2(heading.c), s2(heading.s), tau(t) {}

    RowMotion(double alpha, double heading, double t) { *this = RowMotion(alpha, Heading(heading), t); }
};

/** A bearing turned into the reference frame, and how it shifts with the scaled inverse depth.

With the direction (N, M) of the turned bearing in the horizontal plane, X = N/M and g = G/M, the compensated column on the
wall w = D - B x is p1 = (X + g D) / (1 + g B) = (N + G D) / (M + G B) (doc/theory.md, "Compensation"). This form has no
poles, and (N, M, G) scale with the length of the bearing.
*/
struct TurnedBearing
{
    double N, M, G;

    TurnedBearing() : N(0), M(0), G(0) {}
    //! @param bearing horizontal part (x, z) of the upright bearing.
    TurnedBearing(const Point2d& bearing, const RowMotion& row)
    {
        N = row.c * bearing.x + row.s * bearing.y;
        M = row.c * bearing.y - row.s * bearing.x;
        G = row.tau * (M * row.s2 - N * row.c2);
    }

    double column(double B, double D) const { return (N + G * D) / (M + G * B); }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_COMPENSATION_HPP
