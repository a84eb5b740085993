// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"
#include "polynomial.hpp"

namespace cv { namespace rsackermann {

namespace {

// With (B, D) = scaledSpeed * (cos, sin) of the azimuth a constraint is e + scaledSpeed * q = 0. For two of them e1 q2
// - e2 q1 vanishes; it is of degree 4 in alpha, but for terms of higher order in the small angles.
struct Disagreement
{
    const VerticalSegment* segments;
    Heading heading, walls;

    double q(const Constraint& c) const { return c.d * walls.s + c.b * walls.c; }

    double operator()(double alpha) const
    {
        const Constraint first = RotatedSegment(segments[0], alpha, heading).constraint(),
                         second = RotatedSegment(segments[1], alpha, heading).constraint();
        return first.e * q(second) - second.e * q(first);
    }

    // Whether it is anything else than rounding errors at an alpha.
    bool isInformative(double alpha) const
    {
        const double degenerate = 1e-10, value = (*this)(alpha);
        return value * value > degenerate * degenerate *
                                   RotatedSegment(segments[0], alpha, heading).constraint().length2() *
                                   RotatedSegment(segments[1], alpha, heading).constraint().length2();
    }
};

} // namespace

// The walls of two segments that agree, and the ratio from a third one.
static bool solveSpeed(const Disagreement& d, const Constraint left[2], const Constraint* right,
                       MinimalSolution& solution)
{
    const double standstill = 1e-6, q0 = d.q(left[0]), q1 = d.q(left[1]);
    const double scaledSpeed = -(left[0].e * q0 + left[1].e * q1) / (q0 * q0 + q1 * q1);
    // Vertical lines that stay where they are show nothing of walls. Nor does a scaledSpeed that isn't finite.
    if (!(std::abs(scaledSpeed) > standstill))
        return false;
    solution.wallSlope = scaledSpeed * d.walls.c;
    solution.wallOffset = scaledSpeed * d.walls.s;
    solution.wallRatio = 0;
    return !right || solveRatio(*right, solution);
}

// doc/theory.md, "Solvers": the alphas at which two segments agree on the scaledSpeed of (B, D).
int solveKnownWallDirection(const VerticalSegment* segments, bool twoWalls, double azimuth,
                            const SolverOptions& options, MinimalSolution solutions[6])
{
    if (cvIsNaN(azimuth) || cvIsInf(azimuth))
        return 0;
    enum { DEGREE = 6 };
    const Heading heading(options.heading), walls(azimuth);
    const Disagreement disagreement = {segments, heading, walls};
    if (!disagreement.isInformative(options.maxAlpha) && !disagreement.isInformative(-options.maxAlpha))
        return 0;
    double alphas[DEGREE];
    const int found = smoothRoots<DEGREE>(disagreement, options.maxAlpha, alphas);
    const auto solveAt = [&](const Constraint* left, const Constraint* right, MinimalSolution& s) {
        return solveSpeed(disagreement, left, right, s);
    };
    return solutionsAt<2>(alphas, found, segments, twoWalls, options, solveAt, solutions);
}

}} // namespace cv::rsackermann
