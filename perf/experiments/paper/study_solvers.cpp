// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "setting.hpp"
#include "study.hpp"
#include "vertical_lines.hpp"

#include <cmath>
#include <limits>

namespace paper {

using namespace cv::rsackermann;

namespace {

const double NONE = std::numeric_limits<double>::quiet_NaN();

enum Kind { TURN, STRAIGHT, BOTH };

struct Solver
{
    const char* name;
    Kind kind; // of motion that it is for
    int lines;
    int (*solve)(const VerticalSegment*, SolverOptions, MinimalSolution*);
};

int solve1(const VerticalSegment* s, SolverOptions o, MinimalSolution* r)
{
    return solve1LA(s[0], o, r);
}
int solve3(const VerticalSegment* s, SolverOptions o, MinimalSolution* r)
{
    return solve3LA(s, true, o, r);
}
int solve4Global(const VerticalSegment* s, SolverOptions o, MinimalSolution* r)
{
    return solve4LA(s, true, o, r);
}

int solve4Rolling(const VerticalSegment* s, SolverOptions o, MinimalSolution* r)
{
    o.depthModel = DEPTH_ROLLING_SHUTTER;
    return solve4LA(s, true, o, r);
}

int solve4Exact(const VerticalSegment* s, SolverOptions o, MinimalSolution* r)
{
    return solve4LAExact(s, true, o, r);
}

const Solver SOLVERS[] = {{"1la", TURN, 1, solve1},
                          {"3la", STRAIGHT, 3, solve3},
                          {"4la_rolling", BOTH, 4, solve4Rolling},
                          {"4la_global", BOTH, 4, solve4Global},
                          {"4la_exact", BOTH, 4, solve4Exact}};

double wallSpeed(const MinimalSolution& s)
{
    return std::hypot(s.wallSlope, s.wallOffset);
}

struct Errors
{
    double yawRate, speed; // relative; 0 if the solver doesn't find it
    double worse() const { return std::max(yawRate, speed); }
};

Errors errorsOf(Kind kind, const MinimalSolution& solution, const MinimalSolution& truth)
{
    Errors errors = {0, 0};
    if (kind != STRAIGHT)
        errors.yawRate = std::abs(solution.alpha / truth.alpha - 1);
    if (kind != TURN)
        errors.speed = std::abs(wallSpeed(solution) / wallSpeed(truth) - 1);
    return errors;
}

// The solution that is nearest to the truth; false if there is none.
bool solveNearest(const Solver& solver, const RollingShutterCamera& camera, const cv::Mat& lines,
                  const SolverOptions& limits, const MinimalSolution& truth, int& count, MinimalSolution& nearest)
{
    std::vector<VerticalSegment> segments;
    for (int i = 0; i < lines.rows; i++)
        segments.push_back(verticalSegment(camera, lines.at<cv::Vec4d>(i)));
    MinimalSolution solutions[8];
    count = solver.solve(&segments[0], limits, solutions);
    for (int i = 0; i < count; i++)
        if (i == 0 ||
            errorsOf(solver.kind, solutions[i], truth).worse() < errorsOf(solver.kind, nearest, truth).worse())
            nearest = solutions[i];
    return count > 0;
}

// What an error of one pixel in each coordinate of the ends makes of the result, to first order.
Errors sensitivity(const Solver& solver, const RollingShutterCamera& camera, const cv::Mat& lines,
                   const SolverOptions& limits, const MinimalSolution& exact)
{
    const double step = 1e-4;
    Errors sum = {0, 0};
    for (int i = 0; i < lines.rows * 4; i++)
    {
        cv::Mat moved = lines.clone();
        moved.at<double>(i / 4, i % 4) += step;
        MinimalSolution solution = exact;
        int count = 0;
        if (!solveNearest(solver, camera, moved, limits, exact, count, solution))
            return {NONE, NONE};
        const Errors change = errorsOf(solver.kind, solution, exact);
        sum.yawRate += change.yawRate * change.yawRate / (step * step);
        sum.speed += change.speed * change.speed / (step * step);
    }
    return {std::sqrt(sum.yawRate), std::sqrt(sum.speed)};
}

// Exact lines of a minimal sample, the last one on the right wall.
cv::Mat makeSample(const street::StreetRenderer& renderer, const street::StreetCamera& view, int size, cv::RNG& rng)
{
    std::vector<int> walls;
    const cv::Mat lines = verticalLines(renderer, view, 60, 0, 0, rng, walls);
    cv::Mat sample(0, 4, CV_64F);
    for (int i = 0; i < lines.rows && sample.rows < size; i++)
        if (walls[i] == (size > 1 && sample.rows == size - 1 ? 1 : -1))
            sample.push_back(lines.row(i));
    return sample;
}

} // namespace

// Minimal problems with known solutions.
void studySolvers(const StudyOptions& options)
{
    const int problems = options.quick ? 100 : 1000;
    const std::vector<double> noises = {0, 0.1, 0.25, 0.5, 1, 2};
    const street::StreetCamera view = paperCamera();
    const RollingShutterCamera camera = rsackermann_samples::libraryCamera(view);
    const auto make = [&](int i, std::vector<std::vector<Row>>& tables) {
        cv::RNG rng(uint64(options.seed) * 100003 + uint64(i) + 4);
        const double speed = rng.uniform(20., 140.), yawRate = rng.uniform(10., 70.) * (i % 2 ? 1 : -1);
        for (const Solver& solver : SOLVERS)
        {
            const street::StreetScene scene =
                paperScene(solver.kind == TURN ? 0 : speed, solver.kind == STRAIGHT ? 0 : yawRate, 0);
            const street::StreetRenderer renderer(view, scene);
            const AckermannMotion motion = rsackermann_samples::libraryMotion(view, scene);
            const MinimalSolution truth = {motion.alpha, motion.wallSlope, motion.wallOffset, motion.wallRatio};
            const SolverOptions limits = solverLimits(camera, 90 * DEGREE, 200 * KMH, scene.left);
            cv::RNG sampling(uint64(i) + 5); // the same lines for all solvers
            const cv::Mat lines = makeSample(renderer, view, solver.lines, sampling);
            if (lines.rows < solver.lines)
                continue;
            cv::Mat errors(lines.size(), CV_64F);
            sampling.fill(errors, cv::RNG::NORMAL, 0, 1);
            for (double noise : noises)
            {
                MinimalSolution solution = MinimalSolution();
                int count = 0;
                const bool solved =
                    solveNearest(solver, camera, cv::Mat(lines + noise * errors), limits, truth, count, solution);
                const Errors e = solved ? errorsOf(solver.kind, solution, truth) : Errors{NONE, NONE};
                tables[0].push_back({solver.name, number(noise, 2), std::to_string(i), std::to_string(count),
                                     cv::format("%.3e", e.yawRate), cv::format("%.3e", e.speed),
                                     cv::format("%.3e", solved ? e.worse() : NONE)});
                if (noise > 0 || !solved)
                    continue;
                const Errors s = sensitivity(solver, camera, lines, limits, solution);
                tables[1].push_back(
                    {solver.name, std::to_string(i), cv::format("%.3e", s.yawRate), cv::format("%.3e", s.speed)});
            }
        }
    };
    const std::vector<std::vector<Row>> tables = makeRows("solvers", problems, 2, make);
    writeTable(options.folder + "/solver_condition.csv", "solver,problem,yaw_rate_per_px,speed_per_px", tables[1]);
    writeTable(options.folder + "/solvers.csv", "solver,noise_px,problem,solutions,yaw_rate_error,speed_error,error",
               tables[0]);
}

} // namespace paper
