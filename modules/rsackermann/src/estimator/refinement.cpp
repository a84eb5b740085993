// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "refinement.hpp"
#include "vertical_residual.hpp"
#include <Eigen/Cholesky>

namespace cv {
namespace rsackermann {

typedef Eigen::Matrix<double, PARAMETERS, PARAMETERS> Hessian;
typedef Eigen::Matrix<double, PARAMETERS, 1> Gradient;

static bool isWithin(const MotionLimits& limits, const Model& m)
{
    return std::abs(m[P_ALPHA]) <= limits.maxAlpha && std::hypot(m[P_B], m[P_D]) <= limits.maxSpeed && m[P_LAMBDA] >= 0;
}

double refinementCost(const RefinementProblem& problem, const Model& model)
{
    const RobustLoss loss(problem.lossScale);
    const double scale = problem.focal / problem.sigma;
    double cost = 0;
    for (size_t i = 0; i < problem.candidates->size(); i++)
    {
        int wall;
        const double r = scale * verticalResidual((*problem.candidates)[i], model, problem.heading, wall, 0);
        cost += loss(r * r);
    }
    return cost;
}

// Adds the weighted normal equations of all residuals; returns the cost.
static double accumulate(const RefinementProblem& problem, const Model& model, Hessian& hessian, Gradient& gradient)
{
    const RobustLoss loss(problem.lossScale);
    const double scale = problem.focal / problem.sigma;
    double cost = 0;
    hessian.setZero();
    gradient.setZero();
    Gradient jacobian;
    for (size_t i = 0; i < problem.candidates->size(); i++)
    {
        int wall;
        const double r = scale * verticalResidual((*problem.candidates)[i], model, problem.heading, wall, jacobian.data());
        const double weight = loss.weight(r * r) * scale;
        hessian.noalias() += (weight * scale) * jacobian * jacobian.transpose();
        gradient.noalias() += (weight * r) * jacobian;
        cost += loss(r * r);
    }
    return cost;
}

// The free unknowns keep their rows and columns, the others become fixed.
static void fixUnknowns(const Structure& structure, Hessian& hessian, Gradient& gradient)
{
    bool isFree[PARAMETERS] = {structure.turns(), structure.translates(), structure.translates(), structure.walls == 2, false, false};
    for (int i = 0; i < PARAMETERS; i++)
    {
        if (isFree[i])
            continue;
        hessian.row(i).setZero();
        hessian.col(i).setZero();
        hessian(i, i) = 1;
        gradient[i] = 0;
    }
}

double refine(const RefinementProblem& problem, const Structure& structure, int maxIterations, Model& model)
{
    Hessian hessian;
    Gradient gradient;
    double cost = accumulate(problem, model, hessian, gradient);
    double damping = 1e-3;
    for (int iteration = 0; iteration < maxIterations; iteration++)
    {
        fixUnknowns(structure, hessian, gradient);
        Hessian damped = hessian;
        damped.diagonal() *= 1 + damping;
        damped.diagonal().array() += 1e-9;
        const Gradient step = damped.ldlt().solve(-gradient);
        Model next = model;
        for (int i = 0; i < PARAMETERS; i++)
            next.value[i] += step[i];
        const bool allowed = step.allFinite() && isWithin(problem.limits, next);
        const double nextCost = allowed ? refinementCost(problem, next) : DBL_MAX;
        if (nextCost < cost)
        {
            const double gain = cost - nextCost;
            model = next;
            damping = std::max(damping * 0.2, 1e-9);
            cost = accumulate(problem, model, hessian, gradient);
            if (gain < 1e-6 * (cost + 1e-6))
                break;
        }
        else
        {
            damping *= 8;
            if (damping > 1e8)
                break;
        }
    }
    return cost;
}

}} // namespace cv::rsackermann
