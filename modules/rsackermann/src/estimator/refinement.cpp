// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "direction_residual.hpp"
#include "refinement.hpp"
#include "robust_loss.hpp"
#include "vertical_residual.hpp"
#include <Eigen/Cholesky>

namespace cv {
namespace rsackermann {

typedef Eigen::Matrix<double, PARAMETERS, PARAMETERS> Hessian;
typedef Eigen::Matrix<double, PARAMETERS, 1> Gradient;

namespace {

// Sums the cost and, where wanted, the weighted normal equations.
struct NormalEquations
{
    Hessian hessian;
    Gradient gradient;
    double cost;
    bool wanted;
    double weights, influence2, slopes; // sums over the segments: weight, squared influence, slope of the influence

    explicit NormalEquations(bool wanted_)
        : hessian(Hessian::Zero()), gradient(Gradient::Zero()), cost(0), wanted(wanted_), weights(0), influence2(0), slopes(0)
    {
    }

    // The residual of a segment, with a robust loss.
    void addSegment(double r, const double* jacobian, double scale, const RobustLoss& loss)
    {
        const double r2 = r * r, weight = loss.weight(r2);
        add(r, jacobian, scale, loss(r2), weight);
        weights += weight;
        influence2 += weight * weight * r2;
        slopes += loss.influenceSlope(r2);
    }

    // A residual r with the derivatives scale * jacobian.
    void add(double r, const double* jacobian, double scale, double loss, double weight)
    {
        cost += loss;
        if (!wanted)
            return;
        const Eigen::Map<const Gradient> J(jacobian);
        hessian.noalias() += (weight * scale * scale) * J * J.transpose();
        gradient.noalias() += (weight * scale * r) * J;
    }
};

} // namespace

// A detector fits a chord to an image that the lens has bent: its ends are off by a part of the sagitta.
static double segmentSigma(const Candidate& segment, double sigma)
{
    const double part = 0.3;
    return std::hypot(sigma, part * segment.sagitta);
}

static void addPriors(const RefinementProblem& problem, const Structure& structure, const Model& model, NormalEquations& sum)
{
    Jet prior[PriorTerms::MAX_RESIDUALS];
    const int n = problem.prior.evaluate(model, structure, prior);
    for (int i = 0; i < n; i++)
        sum.add(prior[i].value, prior[i].derivative, 1, prior[i].value * prior[i].value, 1);
    if (problem.gravitySigma > 0)
        for (int p = P_ROLL; p <= P_PITCH; p++)
        {
            const Jet tilt = Jet::variable(model.value[p] / problem.gravitySigma, Parameter(p));
            sum.add(tilt.value, tilt.derivative, 1 / problem.gravitySigma, tilt.value * tilt.value, 1);
        }
}

static void evaluate(const RefinementProblem& problem, const Structure& structure, Evidence evidence, const Model& model, NormalEquations& sum)
{
    const RobustLoss loss(problem.lossScale);
    const PreparedModel prepared(model, problem.heading);
    double jacobian[PARAMETERS];
    for (size_t i = 0; i < problem.verticals.size(); i++)
    {
        int wall;
        const double scale = problem.focal / segmentSigma(problem.verticals[i], problem.sigma);
        const double r = scale * verticalResidual(problem.verticals[i], prepared, wall, sum.wanted ? jacobian : 0);
        sum.addSegment(r, jacobian, scale, loss);
    }
    if (evidence == ALL_SEGMENTS)
    {
        for (size_t i = 0; i < problem.others.size(); i++)
        {
            const double directionScale = problem.focal / segmentSigma(problem.others[i], problem.directionSigma);
            Jet jet;
            if (sum.wanted)
                jet = directionResidual(problem.others[i], model, problem.heading, problem.roadRatio, structure.translates());
            else
                jet.value = directionResidualValue(problem.others[i], model, problem.heading, problem.roadRatio, structure.translates());
            const double r = directionScale * jet.value;
            sum.addSegment(r, jet.derivative, directionScale, loss);
        }
    }
    addPriors(problem, structure, model, sum);
}

double refinementCost(const RefinementProblem& problem, const Structure& structure, Evidence evidence, const Model& model)
{
    NormalEquations sum(false);
    evaluate(problem, structure, evidence, model, sum);
    return sum.cost;
}

// Two walls are seen together where the line at infinity lies between their verticals.
static bool wallsAreSeen(const RefinementProblem& problem, const Structure& structure, const Model& m)
{
    if (structure.walls != 2)
        return true;
    const double left = m[P_D] - m[P_B] * problem.verticals.front().u[0], right = m[P_D] - m[P_B] * problem.verticals.back().u[0];
    return left * right < 0;
}

// Where an unknown is fixed its row and column are those of the identity and its gradient is 0.
static void fixUnknowns(const RefinementProblem& problem, const Structure& structure, Evidence evidence, bool isFree[PARAMETERS], NormalEquations& sum)
{
    isFree[P_ALPHA] = structure.turns();
    isFree[P_B] = isFree[P_D] = structure.translates();
    isFree[P_LAMBDA] = structure.walls == 2;
    isFree[P_ROLL] = isFree[P_PITCH] = problem.gravitySigma > 0;
    isFree[P_STREET] = !structure.translates() && evidence == ALL_SEGMENTS && (!problem.others.empty() || problem.prior.streetSigma > 0);
    for (int i = 0; i < PARAMETERS; i++)
    {
        if (isFree[i])
            continue;
        sum.hessian.row(i).setZero();
        sum.hessian.col(i).setZero();
        sum.hessian(i, i) = 1;
        sum.gradient[i] = 0;
    }
}

// Covariance of an M-estimator over the inverse of its weighted normal equations (doc/theory.md, "Estimation"): what the
// outliers that still count and the unknowns themselves cost.
static double covarianceInflation(const NormalEquations& sum, double unknowns)
{
    if (!(sum.slopes > 0) || !(sum.weights > unknowns))
        return 1;
    return std::max(1., sum.influence2 * sum.weights / (sum.slopes * sum.slopes) * sum.weights / (sum.weights - unknowns));
}

double refine(const RefinementProblem& problem, const Structure& structure, Evidence evidence, int maxIterations, Model& model,
              Matx<double, PARAMETERS, PARAMETERS>* covariance)
{
    NormalEquations sum(true);
    evaluate(problem, structure, evidence, model, sum);
    bool isFree[PARAMETERS];
    double damping = 1e-3;
    for (int iteration = 0; iteration < maxIterations && damping < 1e8; iteration++)
    {
        fixUnknowns(problem, structure, evidence, isFree, sum);
        Hessian damped = sum.hessian;
        damped.diagonal() *= 1 + damping;
        damped.diagonal().array() += 1e-9;
        const Gradient step = damped.ldlt().solve(-sum.gradient);
        Model next = model;
        for (int i = 0; i < PARAMETERS; i++)
            next.value[i] += step[i];
        const bool allowed = step.allFinite() && problem.limits.allow(next) && wallsAreSeen(problem, structure, next);
        if (!allowed || !(refinementCost(problem, structure, evidence, next) < sum.cost))
        {
            damping *= 8;
            continue;
        }
        const double before = sum.cost;
        model = next;
        damping = std::max(damping * 0.2, 1e-9);
        sum = NormalEquations(true);
        evaluate(problem, structure, evidence, model, sum);
        if (before - sum.cost < 1e-6 * (sum.cost + 1e-6))
            break;
    }
    if (covariance)
    {
        fixUnknowns(problem, structure, evidence, isFree, sum);
        // What the segments say is worth less by the inflation, what the priors say is not.
        NormalEquations prior(true);
        addPriors(problem, structure, model, prior);
        fixUnknowns(problem, structure, evidence, isFree, prior);
        const double inflation = covarianceInflation(sum, std::count(isFree, isFree + PARAMETERS, true));
        sum.hessian = (sum.hessian - prior.hessian) / inflation + prior.hessian;
        // The unknowns differ by orders of magnitude: with a diagonal of ones the inverse keeps its digits.
        const Gradient scale = (sum.hessian.diagonal().array() + 1e-9).sqrt().inverse();
        Hessian scaled = scale.asDiagonal() * sum.hessian * scale.asDiagonal();
        scaled.diagonal().array() += 1e-12;
        const Hessian inverse = scale.asDiagonal() * scaled.llt().solve(Hessian::Identity()) * scale.asDiagonal();
        for (int i = 0; i < PARAMETERS; i++)
            for (int j = 0; j < PARAMETERS; j++)
                (*covariance)(i, j) = isFree[i] && isFree[j] && inverse.allFinite() ? inverse(i, j) : 0;
    }
    return sum.cost;
}

}} // namespace cv::rsackermann
