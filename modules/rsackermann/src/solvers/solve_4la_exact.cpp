// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"
#include "polynomial.hpp"

namespace cv {
namespace rsackermann {

enum { ROW_DEGREE = 2, DEGREE = 3 * ROW_DEGREE };

// A polynomial in alpha / scale of degree ROW_DEGREE.
struct Quadratic
{
    double c[ROW_DEGREE + 1];
};

static Quadratic operator-(const Quadratic& a, const Quadratic& b)
{
    Quadratic r;
    for (int i = 0; i <= ROW_DEGREE; i++)
        r.c[i] = a.c[i] - b.c[i];
    return r;
}

// The product without its terms above ROW_DEGREE.
static Quadratic operator*(const Quadratic& a, const Quadratic& b)
{
    Quadratic r;
    for (int i = 0; i <= ROW_DEGREE; i++)
    {
        r.c[i] = 0;
        for (int j = 0; j <= i; j++)
            r.c[i] += a.c[j] * b.c[i - j];
    }
    return r;
}

// TurnedBearing as Taylor polynomials: sin(alpha t)/alpha stands for tau, and s2 M - c2 N is s cos(.) - c sin(.) of alpha t.
struct BearingSeries
{
    Quadratic N, M, G;

    BearingSeries(const Point2d& p, double t, double cosHeading, double sinHeading, double scale)
    {
        const double k = 2 * t * scale, h = t * scale;
        const double across = sinHeading * p.y - cosHeading * p.x, along = cosHeading * p.y + sinHeading * p.x;
        N.c[0] = p.x;
        N.c[1] = k * p.y;
        N.c[2] = -k * k / 2 * p.x;
        M.c[0] = p.y;
        M.c[1] = -k * p.x;
        M.c[2] = -k * k / 2 * p.y;
        G.c[0] = t * across;
        G.c[1] = -t * h * along;
        G.c[2] = -t * h * h * across * (2. / 3);
    }
};

struct ConstraintSeries
{
    Quadratic e, d, b;

    ConstraintSeries() {}
    ConstraintSeries(const VerticalSegment& s, double cosHeading, double sinHeading, double scale)
    {
        const BearingSeries u(s.u, s.timeU, cosHeading, sinHeading, scale), v(s.v, s.timeV, cosHeading, sinHeading, scale);
        e = u.N * v.M - v.N * u.M;
        d = u.G * v.M - v.G * u.M;
        b = u.N * v.G - v.N * u.G;
    }
};

// sum += sign x y z
static void addProduct(const Quadratic& x, const Quadratic& y, const Quadratic& z, double sign, double sum[DEGREE + 1])
{
    double xy[2 * ROW_DEGREE + 1] = {0};
    for (int i = 0; i <= ROW_DEGREE; i++)
        for (int j = 0; j <= ROW_DEGREE; j++)
            xy[i + j] += x.c[i] * y.c[j];
    for (int i = 0; i <= 2 * ROW_DEGREE; i++)
        for (int j = 0; j <= ROW_DEGREE; j++)
            sum[i + j] += sign * xy[i] * z.c[j];
}

static void determinantSeries(const ConstraintSeries r[3], double sum[DEGREE + 1])
{
    std::fill(sum, sum + DEGREE + 1, 0.);
    for (int i = 0; i < 3; i++)
    {
        const ConstraintSeries &p = r[i], &q = r[(i + 1) % 3], &s = r[(i + 2) % 3];
        addProduct(p.e, q.d, s.b, 1, sum);
        addProduct(p.e, q.b, s.d, -1, sum);
    }
}

static Constraint constraintAt(const VerticalSegment& s, double heading, double alpha)
{
    return exactConstraint(TurnedBearing(s.u, RowMotion(alpha, heading, s.timeU)), TurnedBearing(s.v, RowMotion(alpha, heading, s.timeV)));
}

static double exactDeterminant(const VerticalSegment* segments, double heading, double alpha)
{
    return determinant(constraintAt(segments[0], heading, alpha), constraintAt(segments[1], heading, alpha),
                       constraintAt(segments[2], heading, alpha));
}

// Newton steps on the exact determinant, with the slope of the secant. Returns false where they run away.
static bool polish(const VerticalSegment* segments, const SolverOptions& options, double& alpha)
{
    double before = alpha + 1e-4 * options.maxAlpha;
    double valueBefore = exactDeterminant(segments, options.heading, before);
    for (int i = 0; i < 10; i++)
    {
        const double value = exactDeterminant(segments, options.heading, alpha);
        if (value == valueBefore)
            return true;
        const double step = value * (alpha - before) / (value - valueBefore);
        before = alpha;
        valueBefore = value;
        alpha -= step;
        if (!(std::abs(alpha) <= 1.5 * options.maxAlpha))
            return false;
        if (std::abs(step) <= 1e-14 * options.maxAlpha)
            return true;
    }
    return true;
}

// doc/theory.md, "Solvers": the constraints of three segments have a solution (1, D, B) where their determinant vanishes.
int solve4LAExact(const VerticalSegment* segments, bool twoWalls, const SolverOptions& options, MinimalSolution solutions[8])
{
    const int n = twoWalls ? 4 : 3;
    const double c = std::cos(options.heading), s = std::sin(options.heading);
    ConstraintSeries series[3];
    double size = 1;
    for (int i = 0; i < n; i++)
    {
        if (!isUsable(segments[i]))
            return 0;
        if (i == 3)
            break;
        series[i] = ConstraintSeries(segments[i], c, s, options.maxAlpha);
        double sum = 0;
        for (int k = 0; k <= ROW_DEGREE; k++)
            sum += std::abs(series[i].e.c[k]) + std::abs(series[i].d.c[k]) + std::abs(series[i].b.c[k]);
        size *= sum;
    }
    double polynomial[DEGREE + 1], roots[DEGREE];
    determinantSeries(series, polynomial);
    double largest = 0;
    for (int k = 0; k <= DEGREE; k++)
        largest = std::max(largest, std::abs(polynomial[k]));
    if (!(largest > 1e-13 * size))
        return 0;

    // A root of the series may lie a little outside of the limit where the exact one lies inside.
    const int found = realRoots(polynomial, DEGREE, -1.05, 1.05, roots);
    int count = 0;
    for (int i = 0; i < found; i++)
    {
        MinimalSolution& solution = solutions[count];
        solution.alpha = roots[i] * options.maxAlpha;
        if (!polish(segments, options, solution.alpha))
            continue;
        Constraint at[4];
        for (int j = 0; j < n; j++)
            at[j] = constraintAt(segments[j], options.heading, solution.alpha);
        const bool isNew = count == 0 || std::abs(solution.alpha - solutions[count - 1].alpha) > 1e-9 * options.maxAlpha;
        if (isNew && solveWallsFromThree(at, twoWalls ? at + 3 : 0, solution) && isPlausible(solution, segments, 3, twoWalls, options))
            count++;
    }
    return count;
}

}} // namespace cv::rsackermann
