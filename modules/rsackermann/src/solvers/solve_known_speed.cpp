// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"
#include "polynomial.hpp"

namespace cv { namespace rsackermann {

namespace {

// With n = first x second parallel to (1, D, B): D^2 + B^2 - scaledSpeed^2, times n_e^2. Each component of n is a
// product of two constraints of degree 2 in alpha, but for terms of higher order in the small angles.
struct SpeedExcess
{
    const VerticalSegment* segments;
    Heading heading;
    double scaledSpeed;

    double operator()(double alpha) const
    {
        const Constraint n = RotatedSegment(segments[0], alpha, heading)
                                 .constraint()
                                 .cross(RotatedSegment(segments[1], alpha, heading).constraint());
        return n.d * n.d + n.b * n.b - scaledSpeed * scaledSpeed * n.e * n.e;
    }
};

} // namespace

// doc/theory.md, "Solvers": the alphas at which the walls of two segments have the given speed.
int solveKnownSpeed(const VerticalSegment* segments, bool twoWalls, double scaledSpeed, const SolverOptions& options,
                    MinimalSolution solutions[8])
{
    if (!(scaledSpeed > 0) || cvIsInf(scaledSpeed))
        return 0;
    enum { DEGREE = 8 };
    const Heading heading(options.heading);
    const SpeedExcess excess = {segments, heading, scaledSpeed};
    double alphas[DEGREE];
    const int found = smoothRoots<DEGREE>(excess, options.maxAlpha, alphas);
    return solutionsAt<2>(alphas, found, segments, twoWalls, options, solveWalls, solutions);
}

}} // namespace cv::rsackermann
