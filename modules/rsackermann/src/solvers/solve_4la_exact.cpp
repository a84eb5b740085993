// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"
#include "polynomial.hpp"

namespace cv { namespace rsackermann {

namespace {

// The determinant of three constraints, each of degree 2 in alpha, but for terms of higher order in the small angles.
struct Determinant
{
    const VerticalSegment* segments;
    Heading heading;

    double operator()(double alpha) const
    {
        double scale2;
        return at(alpha, scale2);
    }

    // Whether it is anything else than rounding errors at an alpha.
    bool isInformative(double alpha) const
    {
        const double degenerate = 1e-13;
        double scale2;
        const double value = at(alpha, scale2);
        return value * value > degenerate * degenerate * scale2;
    }

    double at(double alpha, double& scale2) const
    {
        Constraint c[3];
        for (int i = 0; i < 3; i++)
            c[i] = RotatedSegment(segments[i], alpha, heading).constraint();
        scale2 = c[0].length2() * c[1].length2() * c[2].length2();
        return determinant(c[0], c[1], c[2]);
    }
};

} // namespace

// doc/theory.md, "Solvers": the constraints of three segments have a solution (1, D, B) if their determinant vanishes.
int solve4LAExact(const VerticalSegment* segments, bool twoWalls, const SolverOptions& options,
                  MinimalSolution solutions[8])
{
    enum { DEGREE = 6 };
    const Determinant determinantAt = {segments, options.heading};
    if (!determinantAt.isInformative(options.maxAlpha) && !determinantAt.isInformative(-options.maxAlpha))
        return 0;
    double alphas[DEGREE];
    const int found = smoothRoots<DEGREE>(determinantAt, options.maxAlpha, alphas);
    return solutionsAt<3>(alphas, found, segments, twoWalls, options, solveWallsFromThree, solutions);
}

}} // namespace cv::rsackermann
