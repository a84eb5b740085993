// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_ROTATED_END_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_ROTATED_END_HPP

#include "prepared_model.hpp"

namespace cv { namespace rsackermann {

// T is double, or a vector of them (../simd_pack.hpp).
inline double choose(bool condition, double a, double b)
{
    return condition ? a : b;
}
inline bool isAnyTrue(bool condition)
{
    return condition;
}
inline double squareRoot(double x)
{
    return std::sqrt(x);
}
inline double magnitude(double x)
{
    return std::abs(x);
}

//! sinc(x), cos(x) and the derivative of sinc for angles that the series don't reach.
inline void sincTerms(double x, double& sincX, double& cosX, double& slope)
{
    sincX = std::sin(x) / x;
    cosX = std::cos(x);
    slope = (cosX - sincX) / x;
}

/** An end of a segment, turned by the corrections of gravity and then into the reference frame, with the parts that the
derivatives take (doc/theory.md, "Compensation").
*/
template <class T>
struct RotatedEnd
{
    T t;    // row time
    T y;    // height of the bearing
    T N, M; // direction in the horizontal plane
    RowMotionOf<T> row;
    T tauByAlpha;    // derivative of row.tau
    T across, along; // parts of the direction (N, M) across and along that of the camera's place

    //! @param bx, by upright bearing of the end, with z = 1.
    RotatedEnd(const T& bx, const T& by, const T& t_, const PreparedModel& m) : t(t_)
    {
        const T half = t * m.alpha;
        T sincHalf, cosHalf, slope = sincDerivativeSeries(half);
        sincAndCosSeries(half, sincHalf, cosHalf);
        if (isAnyTrue(magnitude(half) > T(LARGEST_IN_SERIES)))
            sincTerms(half, sincHalf, cosHalf, slope);
        row = RowMotionOf<T>(half, sincHalf, cosHalf, m.heading, t);
        tauByAlpha = t * t * slope;
        // tiltRotation() * bearing
        yPitched = by * m.cosPitch + m.sinPitch;
        z = T(m.cosPitch) - by * m.sinPitch;
        x = bx * m.cosRoll - yPitched * m.sinRoll;
        y = bx * m.sinRoll + yPitched * m.cosRoll;
        row.turn(x, z, N, M);
        across = row.across(N, M);
        along = M * row.c2 + N * row.s2;
    }

    //! gamma of RotatedBearing and its derivative by alpha.
    T shift() const { return row.tau * across; }
    T shiftByAlpha() const { return tauByAlpha * across - row.tau * t * along; }

    //! Derivatives of N, M and y by P_ROLL and P_PITCH.
    void byRoll(T& byN, T& byM, T& byY) const
    {
        row.turn(T(0) - y, T(0), byN, byM);
        byY = x;
    }

    void byPitch(const PreparedModel& m, T& byN, T& byM, T& byY) const
    {
        row.turn(T(0) - z * m.sinRoll, T(0) - yPitched, byN, byM);
        byY = z * m.cosRoll;
    }

private:
    T x, z, yPitched; // bearing before it is turned
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_ROTATED_END_HPP
