// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SOLVERS_COMMON_HPP
#define OPENCV_RSACKERMANN_SRC_SOLVERS_COMMON_HPP

#include "opencv2/rsackermann/solvers.hpp"
#include "../motion/compensation.hpp"
#include <algorithm>

namespace cv { namespace rsackermann {

//! Whether both ends are finite, in front of the camera and at different times.
inline bool isUsable(const VerticalSegment& s)
{
    const double sum = s.u.x + s.u.z + s.v.x + s.v.z + s.timeU + s.timeV;
    return !cvIsNaN(sum) && !cvIsInf(sum) && s.u.z > 0 && s.v.z > 0 && std::abs(s.timeU - s.timeV) > 1e-9;
}

/** The constraint of a segment (u, v) on the left wall on (B, D): e + d D + b B = 0 (doc/theory.md, "Constraint").

On the right wall (-lambda B, -lambda D) takes the place of (B, D).
*/
struct Constraint
{
    double e, d, b;

    Constraint() : e(0), d(0), b(0) {}
    Constraint(double e_, double d_, double b_) : e(e_), d(d_), b(b_) {}

    double length2() const { return dot(*this); }
    double dot(const Constraint& o) const { return e * o.e + d * o.d + b * o.b; }
    Constraint cross(const Constraint& o) const
    {
        return Constraint(d * o.b - b * o.d, b * o.e - e * o.b, e * o.d - d * o.e);
    }
};

//! Both ends of a segment in the reference frame.
struct RotatedSegment
{
    RotatedBearing u, v;

    RotatedSegment() {}
    RotatedSegment(const VerticalSegment& s, double alpha, const Heading& heading)
        : u(s.u, RowMotion(alpha, heading, s.timeU)), v(s.v, RowMotion(alpha, heading, s.timeV))
    {
    }

    //! The exact constraint on (B, D).
    Constraint constraint() const
    {
        return Constraint(u.N * v.M - v.N * u.M, u.gamma * v.M - v.gamma * u.M, u.N * v.gamma - v.N * u.gamma);
    }
};

inline double determinant(const Constraint& a, const Constraint& b, const Constraint& c)
{
    return a.dot(b.cross(c));
}

//! (B, D) from two constraints and, unless it is null, lambda from that of a segment on the right wall. Returns false
//! if they are degenerate.
bool solveWalls(const Constraint left[2], const Constraint* right, MinimalSolution& solution);

//! lambda from (B, D) and the constraint of a segment on the right wall. Returns false if it is degenerate or not
//! positive.
bool solveRatio(const Constraint& right, MinimalSolution& solution);

//! solveWalls() with the pair of three constraints that is farthest from being parallel.
bool solveWallsFromThree(const Constraint left[3], const Constraint* right, MinimalSolution& solution);

//! Whether the solution is within the limits.
inline bool isWithinLimits(const MinimalSolution& s, const SolverOptions& options)
{
    return std::abs(s.alpha) <= options.maxAlpha && std::hypot(s.wallSlope, s.wallOffset) <= options.maxScaledSpeed;
}

/** Whether all segments are seen on walls in front of the camera and on the same side of the walls' vanishing point:
those on the left (or only) wall first, then, if twoWalls, one on the right wall.
*/
bool areOnWalls(const MinimalSolution& solution, const RotatedSegment* segments, int left, bool twoWalls);

/** The solutions at some alphas.
@tparam LEFT number of segments on the left (or only) wall.
@param segments those, and then, if twoWalls, one on the right wall.
@param solveAt makes the walls of a solution from the constraints of the segments at its alpha, as solveWalls() does;
false if there are none.
@return number of solutions.
*/
template <int LEFT, class SolveAt>
int solutionsAt(const double* alphas, int count, const VerticalSegment* segments, bool twoWalls,
                const SolverOptions& options, const SolveAt& solveAt, MinimalSolution* solutions)
{
    const int n = twoWalls ? LEFT + 1 : LEFT;
    if (!std::all_of(segments, segments + n, isUsable))
        return 0;
    const Heading heading(options.heading);
    int found = 0;
    for (int k = 0; k < count; k++)
    {
        MinimalSolution& s = solutions[found];
        s.alpha = alphas[k];
        RotatedSegment rotated[LEFT + 1];
        Constraint constraints[LEFT + 1];
        for (int i = 0; i < n; i++)
        {
            rotated[i] = RotatedSegment(segments[i], s.alpha, heading);
            constraints[i] = rotated[i].constraint();
        }
        if (solveAt(constraints, twoWalls ? constraints + LEFT : 0, s) && isWithinLimits(s, options) &&
            areOnWalls(s, rotated, LEFT, twoWalls))
            found++;
    }
    return found;
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SOLVERS_COMMON_HPP
