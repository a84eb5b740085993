// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"
#include "polynomial.hpp"

namespace cv { namespace rsackermann {

// A constraint to first order in alpha: at 0 and its slope.
struct LinearConstraint
{
    Constraint at0, slope;

    Constraint at(double alpha) const
    {
        return Constraint(at0.e + alpha * slope.e, at0.d + alpha * slope.d, at0.b + alpha * slope.b);
    }
};

// X and g of a bearing to first order in alpha (doc/theory.md, "Solvers").
struct LinearBearing
{
    double x, X1, g0, g1; // X = x + alpha X1, g = g0 + alpha g1

    LinearBearing(const HorizontalBearing& bearing, double t, const Heading& heading)
    {
        x = bearing.x / bearing.z;
        X1 = 2 * t * (1 + x * x);
        g0 = t * (heading.s - x * heading.c);
        g1 = t * (t * heading.c + x * t * heading.s - X1 * heading.c);
    }
};

// p1 = X + g w with w = D - B x at the rolling-shutter point x, or else the exact constraint, to first order in alpha.
static LinearConstraint linearConstraint(const VerticalSegment& s, const Heading& heading, int depthModel)
{
    const LinearBearing u(s.u, s.timeU, heading), v(s.v, s.timeV, heading);
    LinearConstraint k;
    k.at0 = Constraint(u.x - v.x, u.g0 - v.g0, 0);
    k.slope = Constraint(u.X1 - v.X1, u.g1 - v.g1, 0);
    if (depthModel == DEPTH_ROLLING_SHUTTER)
    {
        k.at0.b = v.x * v.g0 - u.x * u.g0;
        k.slope.b = v.x * v.g1 - u.x * u.g1;
    }
    else
    {
        k.at0.b = u.x * v.g0 - v.x * u.g0;
        k.slope.b = u.X1 * v.g0 + u.x * v.g1 - v.X1 * u.g0 - v.x * u.g1;
    }
    return k;
}

// Coefficients of the determinant as a cubic in alpha / scale. Returns false if it vanishes.
static bool determinantCubic(const LinearConstraint k[3], double scale, double coefficients[4])
{
    Constraint p[3], q[3];
    double size2 = 1;
    for (int i = 0; i < 3; i++)
    {
        p[i] = k[i].at0;
        q[i] = Constraint(scale * k[i].slope.e, scale * k[i].slope.d, scale * k[i].slope.b);
        size2 *= p[i].length2() + q[i].length2();
    }
    const Constraint pp = p[1].cross(p[2]), pq = p[1].cross(q[2]), qp = q[1].cross(p[2]), qq = q[1].cross(q[2]);
    coefficients[0] = p[0].dot(pp);
    coefficients[1] = q[0].dot(pp) + p[0].dot(qp) + p[0].dot(pq);
    coefficients[2] = p[0].dot(qq) + q[0].dot(pq) + q[0].dot(qp);
    coefficients[3] = q[0].dot(qq);
    double largest = 0;
    for (int i = 0; i < 4; i++)
        largest = std::max(largest, std::abs(coefficients[i]));
    const double degenerate = 1e-13;
    return largest * largest > degenerate * degenerate * size2;
}

int solve4LA(const VerticalSegment* segments, bool twoWalls, const SolverOptions& options, MinimalSolution solutions[3])
{
    LinearConstraint linear[4];
    const int n = twoWalls ? 4 : 3;
    const Heading heading(options.heading);
    for (int i = 0; i < n; i++)
    {
        if (!isUsable(segments[i]))
            return 0;
        linear[i] = linearConstraint(segments[i], heading, options.depthModel);
    }
    double cubic[4], roots[3];
    if (!determinantCubic(linear, options.maxAlpha, cubic))
        return 0;
    const int found = realRoots(cubic, 3, -1, 1, roots);
    for (int i = 0; i < found; i++)
        roots[i] *= options.maxAlpha;
    const auto solveAt = [&](const Constraint*, const Constraint*, MinimalSolution& s) {
        Constraint at[4];
        for (int j = 0; j < n; j++)
            at[j] = linear[j].at(s.alpha);
        return solveWallsFromThree(at, twoWalls ? at + 3 : 0, s);
    };
    return solutionsAt<3>(roots, found, segments, twoWalls, options, solveAt, solutions);
}

}} // namespace cv::rsackermann
