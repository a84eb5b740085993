// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"

namespace opencv_test { namespace {

using simulation::Drive;
using simulation::Street;
using simulation::Surface;

const int problems = 10000;

enum Motion { ROTATION, TRANSLATION, BOTH };

//! A motion along walls and the images of vertical lines: three on the left wall and one on the right wall.
struct Problem
{
    SolverOptions options;
    MinimalSolution truth;
    VerticalSegment segments[4];
};

double randomHeading(RNG& rng)
{
    const double headings[] = {0, CV_PI / 2, -CV_PI / 2, CV_PI, rng.uniform(-CV_PI, CV_PI)};
    return headings[rng.uniform(0, 5)];
}

void randomTimes(VerticalSegment& segment, RNG& rng)
{
    do
    {
        segment.timeU = rng.uniform(-0.25, 0.25);
        segment.timeV = rng.uniform(-0.25, 0.25);
    }
    while (std::abs(segment.timeU - segment.timeV) < 0.05);
}

//! Any positive length is a bearing.
void stretch(HorizontalBearing& bearing, double factor)
{
    bearing.x *= factor;
    bearing.z *= factor;
}

/** Makes the images of vertical lines on walls.

A derived class says what the rolling shutter does: simulate() fills v for a given u, or says that the line isn't seen.
 */
class Generator
{
public:
    Generator() : leastAlpha(0), mostAlpha(0.05), limit(SolverOptions().maxAlpha) {}
    virtual ~Generator() {}

    double leastAlpha, mostAlpha; // of |alpha|
    double limit;                 // of the options

    Problem problem(Motion motion, bool twoWalls, RNG& rng)
    {
        Problem result;
        while (!tryProblem(motion, twoWalls, rng, result))
        {
        }
        return result;
    }

protected:
    virtual bool simulate(const Problem& problem, Surface wall, VerticalSegment& segment) const = 0;

    Drive drive;
    Street street;

private:
    bool tryProblem(Motion motion, bool twoWalls, RNG& rng, Problem& result)
    {
        const double alpha =
            motion == TRANSLATION ? 0 : rng.uniform(leastAlpha, mostAlpha) * (rng.uniform(0, 2) ? 1 : -1);
        // the left wall is at distance 1
        const double beta = motion == ROTATION ? 0 : rng.uniform(0.02, 0.6) * (rng.uniform(0, 2) ? 1 : -1);
        const double lambda = twoWalls ? rng.uniform(0.4, 2.5) : 0;
        // both walls are seen if their vanishing point is in the image
        const double direction =
            twoWalls ? rng.uniform(-0.4, 0.4) + (rng.uniform(0, 2) ? CV_PI : 0) : rng.uniform(-CV_PI, CV_PI);
        result.options.heading = randomHeading(rng);
        result.options.maxAlpha = limit;
        result.truth.alpha = alpha;
        result.truth.wallSlope = beta * std::cos(direction);
        result.truth.wallOffset = beta * std::sin(direction);
        result.truth.wallRatio = lambda;
        drive = Drive(2 * alpha, beta, result.options.heading);
        street = Street(1, twoWalls ? 1 / lambda : 0, 0, direction);

        for (int i = 0; i < (twoWalls ? 4 : 3); i++)
        {
            VerticalSegment& segment = result.segments[i];
            bool found = false;
            for (int tries = 0; tries < 20 && !found; tries++)
            {
                randomTimes(segment, rng);
                segment.u = HorizontalBearing(rng.uniform(-0.6, 0.6), 1);
                found = simulate(result, i < 3 ? simulation::LEFT : simulation::RIGHT, segment);
            }
            if (!found)
                return false;
            stretch(segment.u, rng.uniform(0.5, 2.));
            stretch(segment.v, rng.uniform(0.5, 2.));
        }
        return true;
    }
};

//! The exact motion in space.
class ExactGenerator : public Generator
{
public:
    //! Whether a motion shows the segments that all solvers take as they are, each on its own wall.
    bool shows(const MinimalSolution& s, const Problem& problem, bool twoWalls)
    {
        const std::vector<int> taken = twoWalls ? std::vector<int>{0, 1, 3} : std::vector<int>{0, 1};
        bool areShown = false;
        for (const int sign : {1, -1}) // forward or in reverse: the left wall is on either side
        {
            drive = Drive(2 * s.alpha, sign * std::hypot(s.wallSlope, s.wallOffset), problem.options.heading);
            street = Street(1, twoWalls ? 1 / s.wallRatio : 0, 0, std::atan2(sign * s.wallOffset, sign * s.wallSlope));
            areShown = areShown || std::all_of(taken.begin(), taken.end(), [&](int i) {
                           VerticalSegment shown = problem.segments[i];
                           const HorizontalBearing seen = shown.v;
                           return simulate(problem, i < 3 ? simulation::LEFT : simulation::RIGHT, shown) &&
                                  std::abs(std::atan2(seen.x, seen.z) - std::atan2(shown.v.x, shown.v.z)) < 1e-6;
                       });
        }
        return areShown;
    }

private:
    bool simulate(const Problem&, Surface wall, VerticalSegment& segment) const CV_OVERRIDE
    {
        const Vec3d origin = drive.position(segment.timeU),
                    ray = drive.turn(Vec3d(segment.u.x, 0, segment.u.z), segment.timeU);
        const double distance = street.distance(wall, origin, ray);
        if (!(distance < 1e6))
            return false;
        const Vec3d v = drive.toCamera(origin + distance * ray, segment.timeV);
        segment.v = HorizontalBearing(v[0], v[2]);
        return v[2] > 0;
    }
};

//! The model of the cubic: first order in alpha, depth at the rolling-shutter point.
class CubicGenerator : public Generator
{
    static double compensated(const Problem& problem, Surface wall, double x, double t)
    {
        const double a = problem.truth.alpha, c = std::cos(problem.options.heading),
                     s = std::sin(problem.options.heading);
        const double scale = wall == simulation::LEFT ? 1 : -problem.truth.wallRatio;
        const double w = scale * (problem.truth.wallOffset - problem.truth.wallSlope * x);
        const double X = x + 2 * a * t * (1 + x * x);
        const double g = t * (s + a * t * c) - t * (x * c + a * t * (2 * (1 + x * x) * c - x * s));
        return X + g * w;
    }

    bool simulate(const Problem& problem, Surface wall, VerticalSegment& segment) const CV_OVERRIDE
    {
        const double target = compensated(problem, wall, segment.u.x, segment.timeU);
        double low = -3, high = 3;
        if (compensated(problem, wall, low, segment.timeV) > target ||
            compensated(problem, wall, high, segment.timeV) < target)
            return false;
        for (int i = 0; i < 100; i++)
        {
            const double middle = 0.5 * (low + high);
            (compensated(problem, wall, middle, segment.timeV) < target ? low : high) = middle;
        }
        segment.v = HorizontalBearing(0.5 * (low + high), 1);
        return isSeen(wall, segment.u.x) && isSeen(wall, segment.v.x) && isSeen(wall, target);
    }

    bool isSeen(Surface wall, double x) const { return street.distance(wall, Vec3d(), Vec3d(x, 0, 1)) < 1e6; }
};

typedef int (*Solver)(const Problem&, bool twoWalls, MinimalSolution* solutions);

int run1LA(const Problem& p, bool, MinimalSolution* s)
{
    return solve1LA(p.segments[0], p.options, s);
}

int run3LA(const Problem& p, bool twoWalls, MinimalSolution* s)
{
    const VerticalSegment segments[] = {p.segments[0], p.segments[1], p.segments[3]};
    return solve3LA(segments, twoWalls, p.options, s);
}

int run4LA(const Problem& p, bool twoWalls, MinimalSolution* s)
{
    return solve4LA(p.segments, twoWalls, p.options, s);
}

int run4LAAsPaper(const Problem& p, bool twoWalls, MinimalSolution* s)
{
    SolverOptions options = p.options;
    options.depthModel = DEPTH_ROLLING_SHUTTER;
    return solve4LA(p.segments, twoWalls, options, s);
}

int run4LAExact(const Problem& p, bool twoWalls, MinimalSolution* s)
{
    return solve4LAExact(p.segments, twoWalls, p.options, s);
}

int runKnownYawRate(const Problem& p, bool twoWalls, MinimalSolution* s)
{
    const VerticalSegment segments[] = {p.segments[0], p.segments[1], p.segments[3]};
    return solveKnownYawRate(segments, twoWalls, p.truth.alpha, p.options, s);
}

int runKnownSpeed(const Problem& p, bool twoWalls, MinimalSolution* s)
{
    const VerticalSegment segments[] = {p.segments[0], p.segments[1], p.segments[3]};
    return solveKnownSpeed(segments, twoWalls, std::hypot(p.truth.wallSlope, p.truth.wallOffset), p.options, s);
}

int runKnownWallDirection(const Problem& p, bool twoWalls, MinimalSolution* s)
{
    const VerticalSegment segments[] = {p.segments[0], p.segments[1], p.segments[3]};
    return solveKnownWallDirection(segments, twoWalls, std::atan2(p.truth.wallOffset, p.truth.wallSlope), p.options, s);
}

//! The same with the opposite of the walls' two directions.
int runKnownOppositeDirection(const Problem& p, bool twoWalls, MinimalSolution* s)
{
    const VerticalSegment segments[] = {p.segments[0], p.segments[1], p.segments[3]};
    return solveKnownWallDirection(segments, twoWalls, std::atan2(-p.truth.wallOffset, -p.truth.wallSlope), p.options,
                                   s);
}

//! Largest relative difference of yaw, walls and their ratio.
double difference(const MinimalSolution& a, const MinimalSolution& truth)
{
    double worst = 0;
    if (truth.alpha != 0)
        worst = std::abs(a.alpha / truth.alpha - 1);
    else if (a.alpha != 0)
        return std::numeric_limits<double>::infinity();
    const double speed = std::hypot(truth.wallSlope, truth.wallOffset);
    if (speed != 0)
        worst = std::max(worst, std::hypot(a.wallSlope - truth.wallSlope, a.wallOffset - truth.wallOffset) / speed);
    else if (a.wallSlope != 0 || a.wallOffset != 0)
        return std::numeric_limits<double>::infinity();
    if (truth.wallRatio != 0)
        worst = std::max(worst, std::abs(a.wallRatio / truth.wallRatio - 1));
    else if (a.wallRatio != 0)
        return std::numeric_limits<double>::infinity();
    return worst;
}

bool isFinite(double value)
{
    return !cvIsNaN(value) && !cvIsInf(value);
}

//! Whether a solution is finite and within the limits of the options.
bool admissible(const MinimalSolution& s, const SolverOptions& options)
{
    return isFinite(s.alpha) && isFinite(s.wallSlope) && isFinite(s.wallOffset) && isFinite(s.wallRatio) &&
           std::abs(s.alpha) <= options.maxAlpha &&
           std::hypot(s.wallSlope, s.wallOffset) <= options.maxScaledSpeed * (1 + 1e-12) && s.wallRatio >= 0;
}

//! Runs a solver on random problems; the error of the best solution of each.
std::vector<double> bestErrors(Generator& generator, Solver solver, Motion motion, bool twoWalls, int maxSolutions)
{
    RNG rng(twoWalls ? 1 : 2);
    std::vector<double> errors;
    for (int i = 0; i < problems; i++)
    {
        const Problem problem = generator.problem(motion, twoWalls, rng);
        MinimalSolution solutions[9];
        const int n = solver(problem, twoWalls, solutions);
        EXPECT_GE(n, 0);
        EXPECT_LE(n, maxSolutions);
        double best = std::numeric_limits<double>::infinity();
        for (int j = 0; j < n; j++)
        {
            EXPECT_TRUE(admissible(solutions[j], problem.options)) << "problem " << i;
            for (int k = 0; k < j; k++) // the same one twice is none
                EXPECT_GT(std::abs(solutions[j].alpha - solutions[k].alpha), 1e-10) << "problem " << i;
            best = std::min(best, difference(solutions[j], problem.truth));
        }
        errors.push_back(best);
    }
    return errors;
}

double shareBelow(const std::vector<double>& errors, double limit)
{
    int n = 0;
    for (size_t i = 0; i < errors.size(); i++)
        n += errors[i] <= limit;
    return double(n) / errors.size();
}

class RSAckermann_WallSolvers : public testing::TestWithParam<bool /* two walls */>
{
};
INSTANTIATE_TEST_CASE_P(/*nothing*/, RSAckermann_WallSolvers, testing::Bool());

TEST(RSAckermann_Solvers, solve1LA_finds_pure_rotation)
{
    ExactGenerator generator;
    const std::vector<double> errors = bestErrors(generator, run1LA, ROTATION, false, 1);
    EXPECT_EQ(1, shareBelow(errors, 1e-6));
}

// At least the given share of random problems has the true motion among its solutions.
template <class Generator>
void expectFound(Generator generator, Solver solver, Motion motion, bool twoWalls, int maxSolutions, double least)
{
    const double share = shareBelow(bestErrors(generator, solver, motion, twoWalls, maxSolutions), 1e-6);
    testing::Test::RecordProperty("share", format("%.4f", share));
    EXPECT_GE(share, least);
}

TEST_P(RSAckermann_WallSolvers, solve3LA_finds_pure_translation)
{
    expectFound(ExactGenerator(), run3LA, TRANSLATION, GetParam(), 1, 0.999);
}

TEST_P(RSAckermann_WallSolvers, solve4LA_finds_its_own_model)
{
    expectFound(CubicGenerator(), run4LAAsPaper, BOTH, GetParam(), 3, 0.999);
}

TEST_P(RSAckermann_WallSolvers, solve4LAExact_finds_exact_motion)
{
    expectFound(ExactGenerator(), run4LAExact, BOTH, GetParam(), 8, 0.99);
}

// Up to the default limit of the yaw, where series and interpolated functions have their largest errors.
TEST_P(RSAckermann_WallSolvers, finds_motions_at_the_limit)
{
    ExactGenerator generator;
    generator.leastAlpha = 0.2;
    generator.mostAlpha = 0.25;
    expectFound(generator, run4LAExact, BOTH, GetParam(), 8, 0.99);
    expectFound(generator, runKnownSpeed, BOTH, GetParam(), 8, 0.99);
    expectFound(generator, runKnownWallDirection, BOTH, GetParam(), 6, 0.99);
}

// So far away that polynomials hardly follow.
TEST_P(RSAckermann_WallSolvers, far_limits)
{
    ExactGenerator generator;
    generator.limit = 1.5;
    expectFound(generator, run4LAExact, BOTH, GetParam(), 8, 0.9);
    expectFound(generator, runKnownSpeed, BOTH, GetParam(), 8, 0.9);
    expectFound(generator, runKnownWallDirection, BOTH, GetParam(), 6, 0.9);
}

TEST_P(RSAckermann_WallSolvers, solveKnownYawRate_finds_exact_motion)
{
    expectFound(ExactGenerator(), runKnownYawRate, BOTH, GetParam(), 1, 0.999);
}

TEST_P(RSAckermann_WallSolvers, solveKnownSpeed_finds_exact_motion)
{
    expectFound(ExactGenerator(), runKnownSpeed, BOTH, GetParam(), 8, 0.99);
}

TEST_P(RSAckermann_WallSolvers, solveKnownWallDirection_finds_exact_motion)
{
    expectFound(ExactGenerator(), runKnownWallDirection, BOTH, GetParam(), 6, 0.99);
    expectFound(ExactGenerator(), runKnownOppositeDirection, BOTH, GetParam(), 6, 0.99);
}

//! A random motion of the paper's experiments and the images of three lines on the left and one on the right wall.
Problem paperProblem(RNG& rng)
{
    const double yawRate = rng.uniform(10., 70.) * CV_PI / 180 * (rng.uniform(0, 2) ? 1 : -1);
    const double speed = rng.uniform(10., 140.) / 3.6, left = 2.5, right = 3, direction = rng.uniform(-0.05, 0.05);
    const simulation::Simulator simulator =
        simulation::Simulator::fromMetric(simulation::paperCamera(), yawRate, speed, left, right, direction);
    const double w = simulator.drive.speed / left;
    Problem result;
    result.truth.alpha = simulator.drive.yaw / 2;
    result.truth.wallSlope = w * std::cos(direction);
    result.truth.wallOffset = w * std::sin(direction);
    result.truth.wallRatio = left / right;
    for (int i = 0; i < 4; i++)
    {
        Vec4d segment;
        Surface wall = simulation::NOTHING;
        const Surface wanted = i < 3 ? simulation::LEFT : simulation::RIGHT;
        while (!simulation::randomVertical(simulator, simulation::SegmentOptions(), rng, segment, wall) ||
               wall != wanted)
        {
        }
        result.segments[i] = simulation::toVerticalSegment(simulator, segment);
    }
    return result;
}

//! Median over the paper's motions of the larger relative error of yaw rate and speed; a problem without solution
//! counts as infinite.
double medianPaperError(Solver solver)
{
    RNG rng(3);
    std::vector<double> errors;
    for (int i = 0; i < 2000; i++)
    {
        const Problem problem = paperProblem(rng);
        const MinimalSolution& truth = problem.truth;
        MinimalSolution solutions[8];
        const int n = solver(problem, true, solutions);
        double best = std::numeric_limits<double>::infinity();
        for (int j = 0; j < n; j++)
            best = std::min(best, std::max(std::abs(solutions[j].alpha / truth.alpha - 1),
                                           std::abs(std::hypot(solutions[j].wallSlope, solutions[j].wallOffset) /
                                                        std::hypot(truth.wallSlope, truth.wallOffset) -
                                                    1)));
        errors.push_back(best);
    }
    return median(errors);
}

// Whatever else a solver finds is a motion that shows the same segments on the same walls.
TEST_P(RSAckermann_WallSolvers, each_solution_shows_the_segments)
{
    const Solver solvers[] = {run4LAExact, runKnownYawRate, runKnownSpeed, runKnownWallDirection};
    ExactGenerator generator, other;
    RNG rng(8);
    for (const Solver& solver : solvers)
    {
        int all = 0, shown = 0;
        for (int i = 0; i < 1000; i++)
        {
            const Problem problem = generator.problem(BOTH, GetParam(), rng);
            MinimalSolution solutions[9];
            const int n = solver(problem, GetParam(), solutions);
            for (int j = 0; j < n; j++)
                shown += other.shows(solutions[j], problem, GetParam());
            all += n;
        }
        EXPECT_EQ(all, shown) << &solver - solvers;
    }
}

TEST(RSAckermann_Solvers, median_errors_at_the_papers_motions)
{
    const double cubic = medianPaperError(run4LAAsPaper), globalDepth = medianPaperError(run4LA),
                 exact = medianPaperError(run4LAExact);
    RecordProperty("cubic", format("%.3g", cubic));
    RecordProperty("cubic_with_global_shutter_depth", format("%.3g", globalDepth));
    RecordProperty("exact", format("%.3g", exact));
    EXPECT_LT(cubic, 0.15);
    EXPECT_LT(globalDepth, cubic);
    EXPECT_LT(exact, 1e-8);
}

TEST(RSAckermann_Solvers, fromAzimuths)
{
    const VerticalSegment s = VerticalSegment::fromAzimuths(0.3, 0.1, -0.2, -0.15);
    EXPECT_DOUBLE_EQ(0.3, std::atan2(s.u.x, s.u.z));
    EXPECT_DOUBLE_EQ(-0.2, std::atan2(s.v.x, s.v.z));
    EXPECT_EQ(0.1, s.timeU);
    EXPECT_EQ(-0.15, s.timeV);
}

// The car turns to the right: the scene moves to the left as time goes on.
TEST(RSAckermann_Solvers, solve1LA_sign)
{
    MinimalSolution solution;
    ASSERT_EQ(1, solve1LA(VerticalSegment::fromAzimuths(0.1, -0.1, 0.08, 0.1), SolverOptions(), &solution));
    EXPECT_NEAR(0.05, solution.alpha, 1e-15);
    EXPECT_EQ(0, solution.wallSlope);
    EXPECT_EQ(0, solution.wallOffset);
    EXPECT_EQ(0, solution.wallRatio);
}

TEST_P(RSAckermann_WallSolvers, limits_drop_solutions)
{
    const bool twoWalls = GetParam();
    ExactGenerator generator;
    RNG rng(5);
    for (int i = 0; i < 1000; i++)
    {
        Problem problem = generator.problem(BOTH, twoWalls, rng);
        problem.options.maxAlpha = 0.9 * std::abs(problem.truth.alpha);
        MinimalSolution solutions[8];
        for (int j = run4LAExact(problem, twoWalls, solutions) - 1; j >= 0; j--)
            ASSERT_LE(std::abs(solutions[j].alpha), problem.options.maxAlpha);
        for (int j = run4LA(problem, twoWalls, solutions) - 1; j >= 0; j--)
            ASSERT_LE(std::abs(solutions[j].alpha), problem.options.maxAlpha);

        problem = generator.problem(TRANSLATION, twoWalls, rng);
        problem.options.maxScaledSpeed = 0.9 * std::hypot(problem.truth.wallSlope, problem.truth.wallOffset);
        ASSERT_EQ(0, run3LA(problem, twoWalls, solutions));

        problem = generator.problem(ROTATION, false, rng);
        problem.options.maxAlpha = 0.9 * std::abs(problem.truth.alpha);
        ASSERT_EQ(0, run1LA(problem, false, solutions));
    }
}

//! How many solutions each of the solvers that look at walls has for the segments.
void expectNoSolution(const VerticalSegment segments[4], const char* what, bool knownSpeedIsDegenerate = true)
{
    for (int i = 0; i < 10; i++)
    {
        SolverOptions options;
        options.heading = (i % 5 - 2) * CV_PI / 4;
        const bool twoWalls = i >= 5;
        const VerticalSegment three[] = {segments[0], segments[1], segments[3]};
        MinimalSolution solutions[8];
        EXPECT_EQ(0, solve3LA(three, twoWalls, options, solutions)) << what << ", heading " << options.heading;
        EXPECT_EQ(0, solveKnownYawRate(three, twoWalls, 0, options, solutions))
            << what << ", heading " << options.heading;
        if (knownSpeedIsDegenerate)
        {
            EXPECT_EQ(0, solveKnownWallDirection(three, twoWalls, 0.2, options, solutions))
                << what << ", heading " << options.heading;
            EXPECT_EQ(0, solveKnownSpeed(three, twoWalls, 0.2, options, solutions))
                << what << ", heading " << options.heading;
        }
        EXPECT_EQ(0, solve4LA(segments, twoWalls, options, solutions)) << what << ", heading " << options.heading;
        EXPECT_EQ(0, solve4LAExact(segments, twoWalls, options, solutions)) << what << ", heading " << options.heading;
    }
}

VerticalSegment slanted(double x, double slope, double timeU, double timeV)
{
    return VerticalSegment::fromAzimuths(std::atan(x + slope * timeU), timeU, std::atan(x + slope * timeV), timeV);
}

TEST(RSAckermann_Solvers, degenerate_identical)
{
    const VerticalSegment s = slanted(0.2, 0.1, -0.1, 0.15);
    const VerticalSegment segments[] = {s, s, s, s};
    expectNoSolution(segments, "identical");

    // the same with the ends exchanged and other lengths of the bearings
    VerticalSegment turned = s;
    std::swap(turned.u, turned.v);
    std::swap(turned.timeU, turned.timeV);
    stretch(turned.u, 2);
    const VerticalSegment mixed[] = {s, turned, s, turned};
    expectNoSolution(mixed, "identical, ends exchanged");
}

TEST(RSAckermann_Solvers, degenerate_zero_length)
{
    const VerticalSegment point = slanted(0.2, 0.1, 0.1, 0.1);
    const VerticalSegment good[] = {slanted(0.3, 0.1, -0.2, 0.1), slanted(-0.1, 0.04, -0.1, 0.2),
                                    slanted(0.1, 0.02, 0.05, 0.2), slanted(-0.3, 0.03, -0.1, 0.2)};
    for (int i = 0; i < 3; i++)
    {
        VerticalSegment segments[] = {good[0], good[1], good[2], good[3]};
        segments[i] = point;
        MinimalSolution solutions[8];
        EXPECT_EQ(0, solve4LA(segments, true, SolverOptions(), solutions)) << i;
        EXPECT_EQ(0, solve4LAExact(segments, true, SolverOptions(), solutions)) << i;
        if (i < 2)
        {
            EXPECT_EQ(0, solve3LA(segments, false, SolverOptions(), solutions)) << i;
        }
    }
    const VerticalSegment all[] = {point, point, point, point};
    expectNoSolution(all, "points");
    MinimalSolution solution;
    EXPECT_EQ(0, solve1LA(point, SolverOptions(), &solution));
}

// A horizontal segment: both ends have the same row time.
TEST(RSAckermann_Solvers, degenerate_horizontal)
{
    VerticalSegment segments[4];
    for (int i = 0; i < 4; i++)
        segments[i] = VerticalSegment::fromAzimuths(0.1 * i - 0.3, 0.05 * i, 0.1 * i - 0.1, 0.05 * i);
    expectNoSolution(segments, "horizontal");
    MinimalSolution solution;
    EXPECT_EQ(0, solve1LA(segments[0], SolverOptions(), &solution));
}

TEST(RSAckermann_Solvers, degenerate_one_column)
{
    const double times[4][2] = {{-0.2, 0.1}, {-0.1, 0.2}, {0.05, 0.2}, {-0.25, -0.1}};
    VerticalSegment segments[4];
    for (int i = 0; i < 4; i++)
        segments[i] = VerticalSegment::fromAzimuths(0.15, times[i][0], 0.15, times[i][1]);
    expectNoSolution(segments, "one column");
}

// Vertical segments that stay where they are: there is no motion that could say where the walls are.
TEST(RSAckermann_Solvers, degenerate_parallel)
{
    const double times[4][2] = {{-0.2, 0.1}, {-0.1, 0.2}, {0.05, 0.2}, {-0.25, -0.1}};
    VerticalSegment segments[4];
    for (int i = 0; i < 4; i++)
        segments[i] = VerticalSegment::fromAzimuths(0.1 * i - 0.2, times[i][0], 0.1 * i - 0.2, times[i][1]);
    // With a known speed a yaw rate can make up for the walls: that is a solution.
    expectNoSolution(segments, "parallel", false);
}

/** Special values in all places: whatever comes out is finite and within the limits.

Every segment has one of the values in each of its six places; every other segment is a usual one now and then.
 */
TEST(RSAckermann_Solvers, special_values)
{
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    const double values[] = {0,      -0.,     1,        -1,       0.1,       -0.1,        0.25,      1e-9,       -1e-9,
                             1e-17,  1e-160,  1e-300,   DBL_MIN,  4.9e-324,  DBL_EPSILON, 1e9,       -1e9,       1e160,
                             -1e160, DBL_MAX, -DBL_MAX, infinity, -infinity, nan,         CV_PI / 2, -CV_PI / 2, CV_PI};
    const int count = int(sizeof(values) / sizeof(values[0]));
    const Solver solvers[] = {
        run1LA, run3LA, run4LA, run4LAExact, runKnownYawRate, runKnownSpeed, runKnownWallDirection};
    const int most[] = {1, 1, 3, 8, 1, 8, 6};
    const int solverCount = int(sizeof(solvers) / sizeof(solvers[0]));
    ExactGenerator generator;
    RNG rng(7);
    for (int i = 0; i < 100000; i++)
    {
        const bool twoWalls = rng.uniform(0, 2) == 1;
        Problem problem = generator.problem(BOTH, twoWalls, rng);
        const int spoilt = rng.uniform(0, 3); // how many values of ten are special
        for (int j = 0; j < 4; j++)
        {
            VerticalSegment& s = problem.segments[j];
            double* const places[] = {&s.u.x, &s.u.z, &s.timeU, &s.v.x, &s.v.z, &s.timeV};
            for (int k = 0; k < 6; k++)
                if (spoilt == 2 || rng.uniform(0, 10) <= spoilt)
                    *places[k] = values[rng.uniform(0, count)];
        }
        if (rng.uniform(0, 10) == 0)
            problem.options.heading = values[rng.uniform(0, count)];
        if (rng.uniform(0, 10) == 0)
            problem.options.maxAlpha = values[rng.uniform(0, count)];
        if (rng.uniform(0, 10) == 0)
            problem.options.maxScaledSpeed = values[rng.uniform(0, count)];
        for (int j = 0; j < solverCount; j++)
        {
            MinimalSolution solutions[9];
            const int n = solvers[j](problem, twoWalls, solutions);
            ASSERT_GE(n, 0);
            ASSERT_LE(n, most[j]);
            for (int k = 0; k < n; k++)
                ASSERT_TRUE(admissible(solutions[k], problem.options)) << "solver " << j << ", problem " << i;
        }
    }
}

}} // namespace
