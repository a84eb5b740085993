// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_VERTICAL_TERMS_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_VERTICAL_TERMS_HPP

#include "rotated_end.hpp"

namespace cv { namespace rsackermann {

/** The difference of the compensated columns of the two ends of a candidate, p1(u) - p1(v), for a focal length of 1
(doc/theory.md, "Estimation"), on the wall that the candidate is seen on. T is double or a vector of them.
*/
template <class T>
struct VerticalTerms
{
    T value;
    T scale; // the wall is scale (D - B x): 1 left, -lambda right, 0 at infinity

    VerticalTerms(const RotatedEnd<T>& u, const RotatedEnd<T>& v, const PreparedModel& m)
    {
        // The nearest wall is the one with a positive depth if the candidate, between its two columns, is seen by it.
        // One division does for both columns.
        const T shiftU = u.shift(), shiftV = v.shift();
        T denominatorU = u.M + shiftU * m.B, denominatorV = v.M + shiftV * m.B;
        const T both = denominatorU * denominatorV;
        const T sum = (u.N + shiftU * m.D) * denominatorV + (v.N + shiftV * m.D) * denominatorU;
        scale = choose((both * m.D - sum * (0.5 * m.B)) * both * m.direction < T(0), T(-m.lambda), T(1));
        const T B = scale * m.B, D = scale * m.D;
        denominatorU = u.M + shiftU * B;
        denominatorV = v.M + shiftV * B;
        const T inverse = T(1) / (denominatorU * denominatorV);
        inverseU = inverse * denominatorV;
        inverseV = inverse * denominatorU;
        columnU = (u.N + shiftU * D) * inverseU;
        columnV = (v.N + shiftV * D) * inverseV;
        value = columnU - columnV;
    }

    //! Derivatives by all parameters; those by P_ROLL and P_PITCH only if wanted.
    void derivatives(const RotatedEnd<T>& u, const RotatedEnd<T>& v, const PreparedModel& m, bool wantTilt, T* by) const
    {
        for (int p = 0; p < PARAMETERS; p++)
            by[p] = T(0);
        T byWallB(0), byWallD(0);
        add(u, m, inverseU, columnU, wantTilt, by, byWallB, byWallD);
        add(v, m, T(0) - inverseV, columnV, wantTilt, by, byWallB, byWallD);
        by[P_B] = scale * byWallB;
        by[P_D] = scale * byWallD;
        by[P_LAMBDA] = choose(scale > T(0), T(0), T(0) - (byWallB * m.B + byWallD * m.D));
    }

private:
    T inverseU, inverseV, columnU, columnV;

    // The column (N + gamma D) / (M + gamma B) has the derivatives byN by N, byM by M and byG by gamma.
    void add(const RotatedEnd<T>& end, const PreparedModel& m, const T& byN, const T& column, bool wantTilt, T* by,
             T& byWallB, T& byWallD) const
    {
        const T byM = T(0) - column * byN, shift = end.shift();
        const T byG = scale * (byN * m.D + byM * m.B);
        byWallB = byWallB + byM * shift;
        byWallD = byWallD + byN * shift;
        by[P_ALPHA] = by[P_ALPHA] + T(2) * end.t * (byN * end.M - byM * end.N) + byG * end.shiftByAlpha();
        if (!wantTilt)
            return;
        T changeN, changeM, changeY;
        end.byRoll(changeN, changeM, changeY);
        by[P_ROLL] = by[P_ROLL] + byN * changeN + byM * changeM + byG * end.row.tau * end.row.across(changeN, changeM);
        end.byPitch(m, changeN, changeM, changeY);
        by[P_PITCH] =
            by[P_PITCH] + byN * changeN + byM * changeM + byG * end.row.tau * end.row.across(changeN, changeM);
    }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_VERTICAL_TERMS_HPP
