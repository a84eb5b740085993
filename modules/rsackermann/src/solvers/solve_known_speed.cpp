// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"
#include "polynomial.hpp"

namespace cv {
namespace rsackermann {

// With n = first x second parallel to (1, D, B): D^2 + B^2 - size^2, times n_e^2.
static double speedExcess(const VerticalSegment* segments, const Heading& heading, double size, double alpha)
{
    const Constraint n = TurnedSegment(segments[0], alpha, heading).constraint().cross(TurnedSegment(segments[1], alpha, heading).constraint());
    return n.d * n.d + n.b * n.b - size * size * n.e * n.e;
}

enum { DEGREE = 8 };

// Coefficients of the polynomial in alpha / maxAlpha through the excess at evenly spread alphas, by divided differences. Each
// component of n is a product of two constraints of degree 2, but for terms of higher order in the small angles.
static void interpolateExcess(const VerticalSegment* segments, const Heading& heading, double size, double maxAlpha, double c[DEGREE + 1])
{
    double x[DEGREE + 1], difference[DEGREE + 1];
    for (int i = 0; i <= DEGREE; i++)
    {
        x[i] = 2. * i / DEGREE - 1;
        difference[i] = speedExcess(segments, heading, size, maxAlpha * x[i]);
    }
    for (int k = 1; k <= DEGREE; k++)
        for (int i = DEGREE; i >= k; i--)
            difference[i] = (difference[i] - difference[i - 1]) / (x[i] - x[i - k]);
    std::fill(c, c + DEGREE + 1, 0.);
    for (int i = DEGREE; i >= 0; i--)
    {
        // c = c * (x - x[i]) + difference[i]
        for (int j = DEGREE; j > 0; j--)
            c[j] = c[j - 1] - x[i] * c[j];
        c[0] = difference[i] - x[i] * c[0];
    }
}

// Secant steps on the exact excess.
static double polish(const VerticalSegment* segments, const Heading& heading, double size, double maxAlpha, double alpha)
{
    double before = alpha + 1e-5 * maxAlpha, valueBefore = speedExcess(segments, heading, size, before);
    for (int i = 0; i < 8; i++)
    {
        const double value = speedExcess(segments, heading, size, alpha);
        if (value == valueBefore)
            return alpha;
        const double step = value * (alpha - before) / (value - valueBefore);
        before = alpha;
        valueBefore = value;
        alpha -= step;
        if (std::abs(step) < 1e-14 * maxAlpha)
            return alpha;
    }
    return alpha;
}

// doc/theory.md, "Solvers": the alphas at which the walls of two segments have the given speed.
int solveKnownSpeed(const VerticalSegment* segments, bool twoWalls, double size, const SolverOptions& options, MinimalSolution solutions[8])
{
    if (!(size > 0) || cvIsInf(size))
        return 0;
    const int n = twoWalls ? 3 : 2;
    for (int i = 0; i < n; i++)
        if (!isUsable(segments[i]))
            return 0;
    const Heading heading(options.heading);
    double polynomial[DEGREE + 1], roots[DEGREE];
    interpolateExcess(segments, heading, size, options.maxAlpha, polynomial);
    const int found = realRoots(polynomial, DEGREE, -1, 1, roots);
    int count = 0;
    for (int k = 0; k < found; k++)
    {
        MinimalSolution& s = solutions[count];
        s.alpha = polish(segments, heading, size, options.maxAlpha, roots[k] * options.maxAlpha);
        if (!(std::abs(s.alpha) <= options.maxAlpha))
            continue;
        TurnedSegment turned[3];
        Constraint constraints[3];
        for (int i = 0; i < n; i++)
        {
            turned[i] = TurnedSegment(segments[i], s.alpha, heading);
            constraints[i] = turned[i].constraint();
        }
        if (solveWalls(constraints[0], constraints[1], twoWalls ? constraints + 2 : 0, s) && isWithinLimits(s, options) &&
            areOnWalls(s, turned, 2, twoWalls))
            count++;
    }
    return count;
}

}} // namespace cv::rsackermann
