// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "refinement.hpp"
#include "../factors/residual_kernels.hpp"
#include "../optim/levenberg_marquardt.hpp"
#include "../optim/normal_equations.hpp"

namespace cv { namespace rsackermann {

typedef NormalEquations<Eigen::Dynamic, PARAMETERS> ParameterEquations;

void RefinementProblem::arrange()
{
    verticalArrays.assign(verticals);
    otherArrays.assign(others);
    weigh();
}

std::vector<Point2d> RefinementProblem::ends() const
{
    std::vector<Point2d> points;
    for (const std::vector<UprightSegment>* segments : {&verticals, &others})
        for (const UprightSegment& s : *segments)
        {
            points.push_back(Point2d(s.u[0], s.u[1]));
            points.push_back(Point2d(s.v[0], s.v[1]));
        }
    return points;
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
        (!problem.others.empty() || problem.given().streetSigma > 0))
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
    if (problem.prior)
    {
        Jet prior[DrivingPrior::MAX_RESIDUALS];
        const int n = problem.prior->evaluate(model, hypothesis, prior);
        for (int i = 0; i < n; i++)
            addJet(prior[i], unknowns, sums);
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

// Whether no wall of a model is missing: one that would be in the image has verticals. Of a wall beside the image
// nothing is known.
static bool wallsAreSeen(const RefinementProblem& problem, const MotionHypothesis& hypothesis, const Model& m)
{
    const auto hasBothSides = [&](double leftmost, double rightmost) {
        return (m[P_D] - m[P_B] * leftmost) * (m[P_D] - m[P_B] * rightmost) < 0;
    };
    return hypothesis.walls != 2 || !hasBothSides(problem.leftmost, problem.rightmost) ||
           hasBothSides(problem.verticals.front().u[0], problem.verticals.back().u[0]);
}

bool isAllowed(const RefinementProblem& problem, const MotionHypothesis& hypothesis, const Model& model)
{
    return problem.limits.allow(model) && wallsAreSeen(problem, hypothesis, model);
}

static ResidualSums sumResiduals(const RefinementProblem& problem, const MotionHypothesis& hypothesis,
                                 Evidence evidence, const FreeParameters& unknowns, const Model& model)
{
    const RobustLoss loss(problem.lossScale, problem.verticalWeight), otherLoss(problem.lossScale, problem.otherWeight);
    const PreparedModel prepared(model, problem.heading, problem.roadRatio, hypothesis.translates());
    ResidualSums sums;
    // Before the noise is known nothing but the way to a minimum is of use.
    (problem.noiseIsKnown ? addVerticals : addVerticalsInSinglePrecision)(problem.verticalArrays, prepared, loss,
                                                                          unknowns, sums);
    if (evidence == ALL_SEGMENTS)
        addDirections(problem.otherArrays, prepared, otherLoss, unknowns, sums);
    addPriors(problem, hypothesis, unknowns, model, sums);
    return sums;
}

double costOf(const RefinementProblem& problem, const MotionHypothesis& hypothesis, const Model& model)
{
    const PreparedModel prepared(model, problem.heading, problem.roadRatio, hypothesis.translates());
    ResidualSums sums;
    addVerticalsInSinglePrecision(problem.verticalArrays, prepared,
                                  RobustLoss(problem.lossScale, problem.verticalWeight), FreeParameters(), sums);
    addDirections(problem.otherArrays, prepared, RobustLoss(problem.lossScale, problem.otherWeight), FreeParameters(),
                  sums);
    addPriors(problem, hypothesis, FreeParameters(), model, sums);
    return sums.cost;
}

// Sums over segments and priors as normal equations of the free parameters.
static void toEquations(const ResidualSums& sums, int size, ParameterEquations& equations)
{
    equations.cost = sums.cost;
    equations.gradient = Eigen::Map<const Eigen::Matrix<double, PARAMETERS, 1>>(sums.gradient).head(size);
    equations.information =
        Eigen::Map<const Eigen::Matrix<double, PARAMETERS, PARAMETERS, Eigen::RowMajor>>(sums.hessian[0])
            .topLeftCorner(size, size);
}

namespace {

// The refinement as minimize() takes it.
class ModelProblem
{
public:
    typedef Model State;
    typedef ParameterEquations Equations;
    typedef Equations::Vector Step;

    ModelProblem(const RefinementProblem& data_, const MotionHypothesis& hypothesis_, Evidence evidence_)
        : data(data_), hypothesis(hypothesis_), evidence(evidence_),
          unknowns(freeParameters(data_, hypothesis_, evidence_))
    {
    }

    void evaluate(const Model& model, Equations& equations) const
    {
        toEquations(sumResiduals(data, hypothesis, evidence, unknowns, model), unknowns.count, equations);
    }

    Model moved(Model model, const Step& step) const
    {
        for (int i = 0; i < unknowns.count; i++)
            model.value[unknowns.index[i]] += step[i];
        return model;
    }

    bool allows(const Model& model) const { return isAllowed(data, hypothesis, model); }

    // The covariance of all parameters; 0 for those that aren't free.
    Matx<double, PARAMETERS, PARAMETERS> covariance(const Equations& equations) const
    {
        const int n = unknowns.count;
        const Equations::Matrix inverse = scaledInverse<Equations::Matrix>(equations.symmetric());
        Matx<double, PARAMETERS, PARAMETERS> result = Matx<double, PARAMETERS, PARAMETERS>::zeros();
        if (inverse.allFinite())
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++)
                    result(unknowns.index[i], unknowns.index[j]) = inverse(i, j);
        return result;
    }

    const RefinementProblem& data;
    const MotionHypothesis& hypothesis;
    const Evidence evidence;
    const FreeParameters unknowns;
};

} // namespace

double refine(const RefinementProblem& problem, const MotionHypothesis& hypothesis, Evidence evidence,
              int maxIterations, Model& model, Matx<double, PARAMETERS, PARAMETERS>* covariance, double farthest)
{
    const ModelProblem ofModel(problem, hypothesis, evidence);
    ModelProblem::Equations equations;
    MinimizerOptions options(maxIterations, 1e-12, problem.noiseIsKnown ? 3e-6 : 1e-4);
    options.farthest = farthest;
    minimize(ofModel, options, model, equations);
    if (covariance)
        *covariance = ofModel.covariance(equations);
    return equations.cost < DBL_MAX ? equations.cost : DBL_MAX;
}

void Fit::refine(const RefinementProblem& problem, double farthest)
{
    const int iterations = 30;
    model = withLeftWallFirst(model, problem.heading); // two names of one motion would count twice
    cost = rsackermann::refine(problem, hypothesis, ALL_SEGMENTS, iterations, model, &covariance, farthest);
}

namespace {

// The unknowns that are free, with their standard deviations and correlations.
struct FreeUnknowns
{
    typedef Eigen::Matrix<double, Eigen::Dynamic, 1, 0, PARAMETERS, 1> Vector;
    typedef Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, PARAMETERS, PARAMETERS> Matrix;

    int index[PARAMETERS], count;
    Vector sigma;
    Matrix correlation;

    explicit FreeUnknowns(const Fit& fit) : count(0)
    {
        for (int i = 0; i < PARAMETERS; i++)
            if (fit.covariance(i, i) > 0)
                index[count++] = i;
        sigma.resize(count);
        correlation.resize(count, count);
        for (int i = 0; i < count; i++)
            sigma[i] = std::sqrt(fit.covariance(index[i], index[i]));
        for (int i = 0; i < count; i++)
            for (int j = 0; j < count; j++)
                correlation(i, j) = fit.covariance(index[i], index[j]) / (sigma[i] * sigma[j]);
    }
};

} // namespace

double logVolume(const Fit& fit)
{
    const FreeUnknowns unknowns(fit);
    return unknowns.sigma.array().log().sum() +
           0.5 * std::log(std::max(unknowns.correlation.ldlt().vectorD().prod(), 1e-30));
}

bool isAt(const Fit& fit, const Model& model)
{
    const double onePeak = 2; // sigmas between two normal distributions that have one peak together
    const FreeUnknowns unknowns(fit);
    FreeUnknowns::Vector distance(unknowns.count);
    for (int i = 0; i < unknowns.count; i++)
    {
        const int k = unknowns.index[i];
        distance[i] = (model.value[k] - fit.model.value[k]) / unknowns.sigma[i];
    }
    return fit.model.direction == model.direction &&
           (unknowns.count == 0 || distance.dot(unknowns.correlation.ldlt().solve(distance)) <= onePeak * onePeak);
}

}} // namespace cv::rsackermann
