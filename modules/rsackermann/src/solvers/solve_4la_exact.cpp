// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"
#include "polynomial.hpp"

namespace cv { namespace rsackermann {

// Degrees in alpha of the constraints and of their determinant; the terms left out are smaller than those left out of
// the constraints.
enum { ROW_DEGREE = 3, DEGREE = 6 };

// A polynomial in alpha / scale.
struct Series
{
    double c[ROW_DEGREE + 1];
};

static Series operator-(const Series& a, const Series& b)
{
    Series r;
    for (int i = 0; i <= ROW_DEGREE; i++)
        r.c[i] = a.c[i] - b.c[i];
    return r;
}

// The product without its terms above ROW_DEGREE.
static Series operator*(const Series& a, const Series& b)
{
    Series r;
    for (int i = 0; i <= ROW_DEGREE; i++)
    {
        r.c[i] = 0;
        for (int j = 0; j <= i; j++)
            r.c[i] += a.c[j] * b.c[i - j];
    }
    return r;
}

// RotatedBearing as Taylor polynomials: sin(alpha t)/alpha stands for tau, and s2 M - c2 N is s cos(.) - c sin(.) of
// alpha t.
struct BearingSeries
{
    Series N, M, gamma;

    BearingSeries(const HorizontalBearing& p, double t, const Heading& heading, double scale)
    {
        const double k = 2 * t * scale, h = t * scale;
        const double across = heading.s * p.z - heading.c * p.x, along = heading.c * p.z + heading.s * p.x;
        N.c[0] = p.x;
        N.c[1] = k * p.z;
        N.c[2] = -k * k / 2 * p.x;
        N.c[3] = -k * k * k / 6 * p.z;
        M.c[0] = p.z;
        M.c[1] = -k * p.x;
        M.c[2] = -k * k / 2 * p.z;
        M.c[3] = k * k * k / 6 * p.x;
        gamma.c[0] = t * across;
        gamma.c[1] = -t * h * along;
        gamma.c[2] = -t * h * h * across * (2. / 3);
        gamma.c[3] = t * h * h * h * along / 3;
    }
};

struct ConstraintSeries
{
    Series e, d, b;

    ConstraintSeries() {}
    ConstraintSeries(const VerticalSegment& s, const Heading& heading, double scale)
    {
        const BearingSeries u(s.u, s.timeU, heading, scale), v(s.v, s.timeV, heading, scale);
        e = u.N * v.M - v.N * u.M;
        d = u.gamma * v.M - v.gamma * u.M;
        b = u.N * v.gamma - v.N * u.gamma;
    }
};

// sum += sign x y z
static void addProduct(const Series& x, const Series& y, const Series& z, double sign, double sum[DEGREE + 1])
{
    double xy[2 * ROW_DEGREE + 1] = {0};
    for (int i = 0; i <= ROW_DEGREE; i++)
        for (int j = 0; j <= ROW_DEGREE; j++)
            xy[i + j] += x.c[i] * y.c[j];
    for (int i = 0; i <= 2 * ROW_DEGREE; i++)
        for (int j = 0; j <= std::min<int>(ROW_DEGREE, DEGREE - i); j++)
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

// Three segments on the left wall, and maybe one on the right wall, at one alpha.
struct RotatedSample
{
    int count;
    RotatedSegment segments[4];
    Constraint constraints[4];

    RotatedSample(const VerticalSegment* s, int count_) : count(count_), source(s) {}

    void rotate(double alpha, const Heading& heading)
    {
        for (int i = 0; i < count; i++)
        {
            segments[i] = RotatedSegment(source[i], alpha, heading);
            constraints[i] = segments[i].constraint();
        }
    }

    double determinantOfThree() const { return determinant(constraints[0], constraints[1], constraints[2]); }

private:
    const VerticalSegment* source;
};

/* Newton steps on the exact determinant, at first with the slope of the series and then with that of the secant. Leaves
the sample rotated by alpha. Returns false if they run away.
*/
static bool polish(RotatedSample& sample, const Heading& heading, double maxAlpha, double slope, double& alpha)
{
    // The steps shrink faster than with their square root: the error after such a one is below double precision.
    const double lastStep = 1e-12 * maxAlpha;
    double before = 0, valueBefore = 0;
    for (int i = 0; i < 10; i++)
    {
        sample.rotate(alpha, heading);
        const double value = sample.determinantOfThree();
        if (i > 0)
            slope = (value - valueBefore) / (alpha - before);
        const double step = value / slope;
        if (value == 0 || (i > 0 && std::abs(step) <= lastStep))
        {
            alpha -= value == 0 ? 0 : step;
            return true;
        }
        before = alpha;
        valueBefore = value;
        alpha -= step;
        if (!(std::abs(alpha) <= 1.5 * maxAlpha))
            return false;
    }
    return true;
}

// doc/theory.md, "Solvers": the constraints of three segments have a solution (1, D, B) if their determinant vanishes.
int solve4LAExact(const VerticalSegment* segments, bool twoWalls, const SolverOptions& options,
                  MinimalSolution solutions[8])
{
    const int n = twoWalls ? 4 : 3;
    const Heading heading(options.heading);
    ConstraintSeries series[3];
    double scale = 1;
    for (int i = 0; i < n; i++)
    {
        if (!isUsable(segments[i]))
            return 0;
        if (i == 3)
            break;
        series[i] = ConstraintSeries(segments[i], heading, options.maxAlpha);
        double sum = 0;
        for (int k = 0; k <= ROW_DEGREE; k++)
            sum += std::abs(series[i].e.c[k]) + std::abs(series[i].d.c[k]) + std::abs(series[i].b.c[k]);
        scale *= sum;
    }
    double polynomial[DEGREE + 1], roots[DEGREE];
    determinantSeries(series, polynomial);
    double largest = 0;
    for (int k = 0; k <= DEGREE; k++)
        largest = std::max(largest, std::abs(polynomial[k]));
    if (!(largest > 1e-13 * scale))
        return 0;

    // A root of the series may lie a little outside of the limit if the exact one lies inside.
    const int found = realRoots(polynomial, DEGREE, -1.05, 1.05, roots);
    RotatedSample sample(segments, n);
    int count = 0;
    for (int i = 0; i < found; i++)
    {
        MinimalSolution& solution = solutions[count];
        solution.alpha = roots[i] * options.maxAlpha;
        if (!polish(sample, heading, options.maxAlpha, slopeAt(polynomial, DEGREE, roots[i]) / options.maxAlpha,
                    solution.alpha))
            continue;
        const bool isNew =
            count == 0 || std::abs(solution.alpha - solutions[count - 1].alpha) > 1e-9 * options.maxAlpha;
        const Constraint* constraints = sample.constraints;
        if (isNew && solveWallsFromThree(constraints, twoWalls ? constraints + 3 : 0, solution) &&
            isWithinLimits(solution, options) && areOnWalls(solution, sample.segments, 3, twoWalls))
            count++;
    }
    return count;
}

}} // namespace cv::rsackermann
