// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_DIRECTION_TERMS_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_DIRECTION_TERMS_HPP

#include "rotated_end.hpp"

namespace cv { namespace rsackermann {

/** An end as the global-shutter camera sees it: the point (h1, h2) / h3 on the plane on which it is seen
(doc/theory.md, "Compensation").

With the plane's w z = D Z - B X + G Y of a direction (X, Y, Z), and the place (s2, c2) tau of the camera at the time of
the row, (h1, h2, h3) = (N, y, M) (1 - w z of the place) + w z of (N, y, M) times the place.
*/
template <class T>
struct CompensatedEnd
{
    T planeB, planeD, planeG; // of the plane: those of the left wall times scale, or of the road
    T scale;                  // of the wall: 1 left, -lambda right, 0 the road or infinity
    T isRight, isRoad;        // 1 or 0
    T kept, depth;            // 1 - w z of the place, w z of the bearing
    T x, y, inverse;          // the point, and 1/h3

    CompensatedEnd(const RotatedEnd<T>& end, const PreparedModel& m)
    {
        choosePlane(end, m);
        kept = T(1) + end.row.tau * (end.row.s2 * planeB - end.row.c2 * planeD);
        depth = planeD * end.M - planeB * end.N + planeG * end.y;
        inverse = T(1) / (end.M * kept + end.row.tau * end.row.c2 * depth);
        x = (end.N * kept + end.row.tau * end.row.s2 * depth) * inverse;
        y = end.y * kept * inverse;
    }

    //! Adds the derivatives of a function of (x, y) that has the derivatives byX and byY.
    void addDerivatives(const RotatedEnd<T>& e, const PreparedModel& m, const T& byX, const T& byY, bool wantTilt,
                        T* by) const
    {
        const T g1 = byX * inverse, g2 = byY * inverse, g3 = T(0) - (g1 * x + g2 * y);
        const T toPlace = g1 * e.row.s2 + g3 * e.row.c2, byKept = g1 * e.N + g2 * e.y + g3 * e.M,
                byDepth = e.row.tau * toPlace;

        const T byWallB = byKept * e.row.tau * e.row.s2 - byDepth * e.N,
                byWallD = byDepth * e.M - byKept * e.row.tau * e.row.c2;
        const T byG = byDepth * e.y * isRoad;
        by[P_B] = by[P_B] + scale * byWallB + byG * m.GbyB;
        by[P_D] = by[P_D] + scale * byWallD + byG * m.GbyD;
        by[P_LAMBDA] = by[P_LAMBDA] - isRight * (byWallB * m.B + byWallD * m.D);

        const T turning = T(2) * e.t, moving = e.row.tau * e.t; // of (N, M) and of the place
        const T keptByAlpha =
            e.tauByAlpha * (e.row.s2 * planeB - e.row.c2 * planeD) + moving * (e.row.c2 * planeB + e.row.s2 * planeD);
        const T byN = g1 * kept - byDepth * planeB, byM = g3 * kept + byDepth * planeD;
        by[P_ALPHA] = by[P_ALPHA] + turning * (byN * e.M - byM * e.N) + byKept * keptByAlpha +
                      depth * (e.tauByAlpha * toPlace + moving * (g1 * e.row.c2 - g3 * e.row.s2));
        if (!wantTilt)
            return;
        const T byHeight = g2 * kept + byDepth * planeG;
        T changeN, changeM, changeY;
        e.byRoll(changeN, changeM, changeY);
        by[P_ROLL] = by[P_ROLL] + byN * changeN + byM * changeM + byHeight * changeY;
        e.byPitch(m, changeN, changeM, changeY);
        by[P_PITCH] = by[P_PITCH] + byN * changeN + byM * changeM + byHeight * changeY;
    }

private:
    // The nearest plane where the bearing, turned only, meets the scene (doc/theory.md, "Depth"). Inverse depths are
    // those times |M|, which saves a division.
    void choosePlane(const RotatedEnd<T>& end, const PreparedModel& m)
    {
        const T zero(0), one(1), forward(m.direction < 0 ? -1 : 1),
            direction = choose(end.M > zero, forward, zero - forward);
        const T left = direction * (end.M * m.D - end.N * m.B), right = zero - left * m.lambda;
        const T road = direction * end.y * m.G;
        scale = choose(left > zero, one, zero);
        T nearest = choose(left > zero, left, zero);
        isRight = choose(right > nearest, one, zero);
        scale = choose(right > nearest, T(-m.lambda), scale);
        nearest = choose(right > nearest, right, nearest);
        isRoad = choose(road > nearest, one, zero);
        isRight = choose(road > nearest, zero, isRight);
        scale = choose(road > nearest, zero, scale);
        planeB = scale * m.B;
        planeD = scale * m.D;
        planeG = isRoad * m.G;
    }
};

//! A compensated segment between two points a and b, seen from a vanishing point (x, 0, z).
template <class T>
struct Chord
{
    T ex, ey; // b - a
    T middleX, middleY;

    Chord(const T& ax, const T& ay, const T& bx, const T& by)
        : ex(bx - ax), ey(by - ay), middleX((ax + bx) * 0.5), middleY((ay + by) * 0.5)
    {
    }

    //! The lateral distance between the ends, as seen from the vanishing point, is moment / sqrt(length2).
    void momentAround(const T& x, const T& z, T& moment, T& length2) const
    {
        const T dx = x - z * middleX, dy = T(0) - z * middleY, leastLength2(1e-24);
        moment = ex * dy - ey * dx;
        length2 = dx * dx + dy * dy + leastLength2;
    }
};

/** Lateral distance between the ends of a segment as seen from the vanishing point (streetX, 0, streetZ), or from that
at right angles to it, (-streetZ, 0, streetX), whichever is smaller: how far the segment is from pointing along the
street or across it. T is double or a vector of them.
*/
template <class T>
struct DirectionTerms
{
    T value;

    DirectionTerms(const Chord<T>& chord_, const T& streetX, const T& streetZ) : chord(chord_)
    {
        T along, alongLength2, across, acrossLength2;
        chord.momentAround(streetX, streetZ, along, alongLength2);
        chord.momentAround(T(0) - streetZ, streetX, across, acrossLength2);
        isAlong = choose(along * along * acrossLength2 < across * across * alongLength2, T(1), T(0));
        inverse = T(1) / squareRoot(choose(isAlong > T(0), alongLength2, acrossLength2));
        value = choose(isAlong > T(0), along, across) * inverse;
        vx = choose(isAlong > T(0), streetX, T(0) - streetZ);
        vz = choose(isAlong > T(0), streetZ, streetX);
    }

    //! Derivatives by all parameters; those by P_ROLL and P_PITCH only if wanted.
    void derivatives(const RotatedEnd<T>& u, const RotatedEnd<T>& v, const CompensatedEnd<T>& a,
                     const CompensatedEnd<T>& b, const PreparedModel& m, bool wantTilt, T* by) const
    {
        for (int p = 0; p < PARAMETERS; p++)
            by[p] = T(0);
        const T dx = vx - vz * chord.middleX, dy = T(0) - vz * chord.middleY;
        const T byDx = T(0) - (chord.ey + value * dx * inverse) * inverse,
                byDy = (chord.ex - value * dy * inverse) * inverse;
        const T byEx = dy * inverse, byEy = T(0) - dx * inverse, byMiddleX = vz * byDx * -0.5,
                byMiddleY = vz * byDy * -0.5;
        a.addDerivatives(u, m, byMiddleX - byEx, byMiddleY - byEy, wantTilt, by);
        b.addDerivatives(v, m, byMiddleX + byEx, byMiddleY + byEy, wantTilt, by);

        const T byVz = T(0) - (byDx * chord.middleX + byDy * chord.middleY);
        const T byStreetX = choose(isAlong > T(0), byDx, byVz), byStreetZ = choose(isAlong > T(0), byVz, T(0) - byDx);
        if (m.translates)
        {
            by[P_D] = by[P_D] + byStreetX;
            by[P_B] = by[P_B] + byStreetZ;
        }
        else
            by[P_STREET] = byStreetX * m.streetZ - byStreetZ * m.streetX;
    }

private:
    Chord<T> chord;
    T isAlong; // 1 or 0
    T vx, vz;  // the vanishing point that was chosen
    T inverse; // of the distance to it
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_DIRECTION_TERMS_HPP
