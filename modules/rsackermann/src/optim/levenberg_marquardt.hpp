// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_OPTIM_LEVENBERG_MARQUARDT_HPP
#define OPENCV_RSACKERMANN_SRC_OPTIM_LEVENBERG_MARQUARDT_HPP

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <utility>

namespace cv { namespace rsackermann {

//! When the steps end.
struct MinimizerOptions
{
    int maxSteps;             // those that are tried
    double absoluteTolerance; // gain of a step that is too small for another one
    double relativeTolerance; // the same as a part of the cost; both count
    double farthest;          // cost above which there are no more steps if those that are left don't promise less

    MinimizerOptions(int maxSteps_, double absolute, double relative = 0)
        : maxSteps(maxSteps_), absoluteTolerance(absolute), relativeTolerance(relative), farthest(DBL_MAX)
    {
    }

    double enough(double cost) const { return absoluteTolerance + relativeTolerance * cost; }
};

struct MinimizerStats
{
    int steps = 0;          // tried
    bool converged = false; // whether another step would hardly gain
};

/** Levenberg-Marquardt: Gauss-Newton steps, damped as long as they don't lower the cost.

A Problem has
-# the types State, Step and Equations, which have a cost and double solve(double damping, Step&) const: the step, and
the gain that is expected of it;
-# void evaluate(const State&, Equations&) const: cost and normal equations at a state. The derivatives come along:
nearly all steps are taken;
-# State moved(const State&, const Step&) const;
-# bool allows(const State&) const: whether a state is within its limits.

@param state start and result; it is never one that isn't allowed, nor one with a larger cost than the start.
@param equations receives those at the result. */
template <class Problem>
MinimizerStats minimize(const Problem& problem, const MinimizerOptions& options, typename Problem::State& state,
                        typename Problem::Equations& equations)
{
    MinimizerStats stats;
    typename Problem::Equations next;
    typename Problem::Step step;
    problem.evaluate(state, equations);
    const double firstDamping = 1e-3, largestDamping = 1e8; // with the largest one no step is tried
    double damping = firstDamping;
    while (!stats.converged && stats.steps < options.maxSteps && damping < largestDamping)
    {
        const double expected = equations.solve(damping, step);
        // Far from where the cost is quadratic the damping is larger.
        stats.converged = damping <= firstDamping && expected < options.enough(equations.cost);
        if (stats.converged)
            break;
        stats.steps++;
        typename Problem::State there = problem.moved(state, step);
        const bool isAllowed = std::isfinite(expected) && problem.allows(there);
        if (isAllowed)
            problem.evaluate(there, next);
        if (!isAllowed || !(next.cost < equations.cost))
        {
            damping *= 8;
            continue;
        }
        stats.converged = equations.cost - next.cost < options.enough(next.cost);
        damping = std::max(damping * 0.2, 1e-9);
        state = std::move(there);
        equations = std::move(next);
        // Even if each step that is left gained as much as was expected of this one.
        if (equations.cost - (options.maxSteps - stats.steps) * expected > options.farthest)
            break;
    }
    return stats;
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_OPTIM_LEVENBERG_MARQUARDT_HPP
