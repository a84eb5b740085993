// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "refinement.hpp"
#include "residuals/residual_kernels.hpp"
#include <Eigen/Cholesky>

namespace cv { namespace rsackermann {

typedef Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, PARAMETERS, PARAMETERS> Hessian;
typedef Eigen::Matrix<double, Eigen::Dynamic, 1, 0, PARAMETERS, 1> Gradient;

void RefinementProblem::arrange()
{
    verticalArrays.assign(verticals);
    otherArrays.assign(others);
    weigh();
}

void RefinementProblem::weigh()
{
    verticalArrays.weigh(verticals, focal, sigma, lean);
    otherArrays.weigh(others, focal, directionSigma, lean);
}

static FreeParameters freeParameters(const RefinementProblem& problem, const MotionHypothesis& hypothesis,
                                     Evidence evidence)
{
    FreeParameters unknowns;
    if (hypothesis.turns())
        unknowns.add(P_ALPHA);
    if (hypothesis.translates())
    {
        unknowns.add(P_B);
        unknowns.add(P_D);
    }
    if (hypothesis.walls == 2)
        unknowns.add(P_LAMBDA);
    if (problem.gravitySigma > 0)
    {
        unknowns.add(P_ROLL);
        unknowns.add(P_PITCH);
    }
    if (!hypothesis.translates() && evidence == ALL_SEGMENTS &&
        (!problem.others.empty() || problem.prior.streetSigma > 0))
        unknowns.add(P_STREET);
    return unknowns;
}

// A residual that isn't robust.
static void addJet(const Jet& residual, const FreeParameters& unknowns, ResidualSums& sums)
{
    sums.cost += residual.value * residual.value;
    for (int i = 0; i < unknowns.count; i++)
    {
        const double derivative = residual.derivative[unknowns.index[i]];
        sums.gradient[i] += derivative * residual.value;
        for (int j = 0; j <= i; j++)
            sums.hessian[i][j] += derivative * residual.derivative[unknowns.index[j]];
    }
}

static void addPriors(const RefinementProblem& problem, const MotionHypothesis& hypothesis,
                      const FreeParameters& unknowns, const Model& model, ResidualSums& sums)
{
    Jet prior[PriorTerms::MAX_RESIDUALS];
    const int n = problem.prior.evaluate(model, hypothesis, prior);
    for (int i = 0; i < n; i++)
        addJet(prior[i], unknowns, sums);
    if (problem.usual)
    {
        Jet usual[UsualDrive::MAX_RESIDUALS];
        const int m = problem.usual->evaluate(model, hypothesis, usual);
        for (int i = 0; i < m; i++)
            addJet(usual[i], unknowns, sums);
    }
    if (problem.gravitySigma > 0)
    {
        // About the vehicle's axes: the crown of a road and the suspension roll a car more than they pitch it.
        const Jet roll = Jet::variable(model[P_ROLL], P_ROLL), pitch = Jet::variable(model[P_PITCH], P_PITCH);
        addJet((1 / problem.gravitySigma) * (problem.heading.c * roll - problem.heading.s * pitch), unknowns, sums);
        addJet((1 / problem.vehiclePitchSigma) * (problem.heading.s * roll + problem.heading.c * pitch), unknowns,
               sums);
    }
}

static ResidualSums evaluate(const RefinementProblem& problem, const MotionHypothesis& hypothesis, Evidence evidence,
                             const FreeParameters& unknowns, const Model& model)
{
    const RobustLoss loss(problem.lossScale, problem.verticalWeight), otherLoss(problem.lossScale, problem.otherWeight);
    const PreparedModel prepared(model, problem.heading, problem.roadRatio, hypothesis.translates());
    ResidualSums sums;
    addVerticals(problem.verticalArrays, prepared, loss, unknowns, sums);
    if (evidence == ALL_SEGMENTS)
        addDirections(problem.otherArrays, prepared, otherLoss, unknowns, sums);
    addPriors(problem, hypothesis, unknowns, model, sums);
    return sums;
}

static Hessian hessianOf(const ResidualSums& sums, int size)
{
    Hessian hessian(size, size);
    for (int i = 0; i < size; i++)
        for (int j = 0; j <= i; j++)
            hessian(i, j) = hessian(j, i) = sums.hessian[i][j];
    return hessian;
}

bool wallsAreSeen(const RefinementProblem& problem, const MotionHypothesis& hypothesis, const Model& m)
{
    if (hypothesis.walls != 2)
        return true;
    const double left = m[P_D] - m[P_B] * problem.verticals.front().u[0],
                 right = m[P_D] - m[P_B] * problem.verticals.back().u[0];
    return left * right < 0;
}

// Covariance of an M-estimator over the inverse of its weighted normal equations (doc/theory.md, "Estimation"): what
// the outliers that still count and the unknowns themselves cost.
static double covarianceInflation(const ResidualSums& sums, double unknowns)
{
    if (!(sums.slopes > 0) || !(sums.weights > unknowns))
        return 1;
    return std::max(1., sums.influence2 * sums.weights / (sums.slopes * sums.slopes) * sums.weights /
                            (sums.weights - unknowns));
}

// The covariance of all parameters at a model with the given sums; 0 for those that aren't free.
static Matx<double, PARAMETERS, PARAMETERS> covarianceAt(const RefinementProblem& problem,
                                                         const MotionHypothesis& hypothesis,
                                                         const FreeParameters& unknowns, const Model& model,
                                                         const ResidualSums& sums)
{
    Matx<double, PARAMETERS, PARAMETERS> covariance = Matx<double, PARAMETERS, PARAMETERS>::zeros();
    const int n = unknowns.count;
    if (n == 0)
        return covariance;
    // The inflation takes from the information of the segments, but not from that of the priors.
    ResidualSums prior;
    addPriors(problem, hypothesis, unknowns, model, prior);
    const Hessian priorHessian = hessianOf(prior, n);
    const Hessian hessian = (hessianOf(sums, n) - priorHessian) / covarianceInflation(sums, n) + priorHessian;
    // The unknowns differ by orders of magnitude: with a diagonal of ones the inverse keeps its digits.
    const Gradient scale = (hessian.diagonal().array() + 1e-9).sqrt().inverse();
    Hessian scaled = scale.asDiagonal() * hessian * scale.asDiagonal();
    scaled.diagonal().array() += 1e-12;
    const Hessian inverse = scale.asDiagonal() * scaled.llt().solve(Hessian::Identity(n, n)) * scale.asDiagonal();
    if (inverse.allFinite())
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                covariance(unknowns.index[i], unknowns.index[j]) = inverse(i, j);
    return covariance;
}

double refine(const RefinementProblem& problem, const MotionHypothesis& hypothesis, Evidence evidence,
              int maxIterations, Model& model, Matx<double, PARAMETERS, PARAMETERS>* covariance, double* inflation)
{
    const FreeParameters unknowns = freeParameters(problem, hypothesis, evidence);
    const int n = unknowns.count;
    ResidualSums sums = evaluate(problem, hypothesis, evidence, unknowns, model);
    const double startDamping = 1e-3, tolerance = 1e-6;
    double damping = startDamping;
    for (int iteration = 0; iteration < maxIterations && n > 0 && damping < 1e8; iteration++)
    {
        Hessian damped = hessianOf(sums, n);
        damped.diagonal() *= 1 + damping;
        damped.diagonal().array() += 1e-9;
        const Eigen::Map<const Gradient> gradient(sums.gradient, n);
        const Gradient step = damped.ldlt().solve(-gradient);
        // The gain of a step if the cost is quadratic; far from there the damping is larger.
        if (damping <= startDamping && -step.dot(gradient) < tolerance * (sums.cost + tolerance))
            break;
        Model next = model;
        for (int i = 0; i < n; i++)
            next.value[unknowns.index[i]] += step[i];
        const bool allowed = step.allFinite() && problem.limits.allow(next) && wallsAreSeen(problem, hypothesis, next);
        // The derivatives come along: nearly all steps are taken.
        const ResidualSums nextSums = allowed ? evaluate(problem, hypothesis, evidence, unknowns, next) : sums;
        if (!(nextSums.cost < sums.cost))
        {
            damping *= 8;
            continue;
        }
        const double before = sums.cost;
        model = next;
        sums = nextSums;
        damping = std::max(damping * 0.2, 1e-9);
        if (before - sums.cost < tolerance * (sums.cost + tolerance))
            break;
    }
    if (inflation)
        *inflation = covarianceInflation(sums, n);
    if (covariance)
        *covariance = covarianceAt(problem, hypothesis, unknowns, model, sums);
    return sums.cost < DBL_MAX ? sums.cost : DBL_MAX;
}

}} // namespace cv::rsackermann
