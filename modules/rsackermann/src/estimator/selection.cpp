// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "consensus.hpp"
#include "residuals/direction_residual.hpp"
#include "lo_ransac.hpp"
#include "selection.hpp"
#include "street_direction.hpp"
#include "uncertainty.hpp"
#include "residuals/vertical_residual.hpp"

namespace cv { namespace rsackermann {

static const double GROSS = 4, GROSS_OTHERS = 3; // sigmas above which a residual tells nothing of the noise
static const double LEAST_NOISE = 0.005, LARGEST_NOISE = 0.6, LARGEST_OTHERS_NOISE = 1; // pixels
static const double KEPT_LOSS_WIDTH = 0.6; // of the loss, if the noise turns out to be smaller
static const double FAR_BEHIND = 100;      // in the criterion
static const double RELEVANT = 10;

// From simple to rich: the richer ones start from the simpler ones, too.
static std::vector<MotionHypothesis> allowedHypotheses(int model, const Heading& heading)
{
    std::vector<MotionHypothesis> hypotheses(1, MotionHypothesis(MODEL_NONE, 0));
    const int motions[3] = {MODEL_1LA, MODEL_3LA, MODEL_4LA};
    for (int i = 0; i < 3; i++)
    {
        if (model != MODEL_AUTO && model != motions[i])
            continue;
        if (motions[i] == MODEL_1LA)
        {
            hypotheses.push_back(MotionHypothesis(MODEL_1LA, 0));
            continue;
        }
        hypotheses.push_back(MotionHypothesis(motions[i], 1));
        if (heading.looksAlong()) // two walls can be seen
            hypotheses.push_back(MotionHypothesis(motions[i], 2));
    }
    return hypotheses;
}

// The best model of a hypothesis for the verticals alone. Returns false if there is none.
static bool fitVerticals(const RefinementProblem& problem, const AckermannEstimator::Params& params,
                         const MotionHypothesis& hypothesis, Model& model)
{
    if (hypothesis.motion == MODEL_NONE)
        return true;
    RansacOptions options;
    options.confidence = params.confidence;
    options.maxIterations = params.maxIterations;
    options.seed = (uint64)params.seed;
    CandidateConsensus consensus(problem, hypothesis, params.threshold);
    double score;
    if (!loRansac(consensus, options, model, score))
        return false;
    refine(problem, hypothesis, VERTICALS_ONLY, 20, model);
    return true;
}

// Joint refinement from several starts, and from each with the street where the other segments see it.
static Fit fitAllSegments(const RefinementProblem& problem, const MotionHypothesis& hypothesis,
                          const std::vector<Model>& starts)
{
    std::vector<Fit> minima;
    for (size_t i = 0; i < starts.size(); i++)
    {
        minima.push_back(refineFrom(problem, starts[i], hypothesis));
        Model towardsStreet = starts[i];
        if (startFromStreetDirection(problem, hypothesis, towardsStreet))
            minima.push_back(refineFrom(problem, towardsStreet, hypothesis));
    }
    return *std::min_element(minima.begin(), minima.end(), isCheaper);
}

static const Fit& bestOf(const std::vector<Fit>& fits)
{
    size_t best = 0;
    for (size_t i = 1; i < fits.size(); i++)
        if (fits[i].criterion < fits[best].criterion)
            best = i;
    return fits[best];
}

// Standard deviation of residuals in pixels, from the median of those that aren't gross outliers.
static double medianSigma(std::vector<double>& residuals, double gross, double otherwise)
{
    residuals.erase(std::remove_if(residuals.begin(), residuals.end(), [gross](double r) { return !(r < gross); }),
                    residuals.end());
    if (residuals.empty())
        return otherwise;
    const size_t middle = residuals.size() / 2;
    std::nth_element(residuals.begin(), residuals.begin() + middle, residuals.end());
    return 1.4826 * residuals[middle];
}

// The noise of the segments, as the residuals of a fit show it.
static void measureNoise(const Fit& fit, RefinementProblem& problem)
{
    const PreparedModel prepared(fit.model, problem.heading, problem.roadRatio, fit.hypothesis.translates());
    std::vector<double> verticals, others;
    for (size_t i = 0; i < problem.verticals.size(); i++)
    {
        int wall;
        verticals.push_back(problem.focal * std::abs(verticalResidual(problem.verticals[i], prepared, wall, 0)));
    }
    for (size_t i = 0; i < problem.others.size(); i++)
        others.push_back(problem.focal * std::abs(directionResidual(problem.others[i], prepared, 0)));
    const double lossWidth = problem.lossScale * problem.sigma;
    problem.sigma =
        std::min(std::max(medianSigma(verticals, GROSS * problem.sigma, problem.sigma), LEAST_NOISE), LARGEST_NOISE);
    problem.directionSigma = std::min(
        std::max(medianSigma(others, GROSS_OTHERS * problem.directionSigma, problem.directionSigma), problem.sigma),
        LARGEST_OTHERS_NOISE);
    // Less noise doesn't make the deviations of real walls from planes smaller.
    problem.lossScale = std::max(problem.lossScale, KEPT_LOSS_WIDTH * lossWidth / problem.sigma);
    problem.weigh();
}

// Fits far behind can't win with another noise, and need not be refined again.
static void dropHopeless(std::vector<Fit>& fits)
{
    const double best = bestOf(fits).criterion;
    fits.erase(
        std::remove_if(fits.begin(), fits.end(), [best](const Fit& f) { return f.criterion > best + FAR_BEHIND; }),
        fits.end());
}

// The model of one hypothesis as a start for another one; false if it says nothing of its walls.
static bool convert(const Fit& from, const MotionHypothesis& to, Model& model)
{
    model = from.model;
    if (!to.turns())
        model[P_ALPHA] = 0;
    if (!to.translates())
    {
        if (from.hypothesis.translates())
            model[P_STREET] = azimuthOf(from.model);
        model[P_B] = model[P_D] = model[P_LAMBDA] = 0;
        model.direction = 0;
        return true;
    }
    if (to.walls == 2 && from.hypothesis.walls == 1)
        model[P_LAMBDA] = 1;
    return from.hypothesis.walls > 0 && from.hypothesis.walls <= to.walls;
}

// Hypotheses compare fairly if each has the best minimum that it can have: starts from the one of the best fit, too.
static void startFromBest(const RefinementProblem& problem, std::vector<Fit>& fits)
{
    const Fit best = bestOf(fits);
    for (size_t i = 0; i < fits.size(); i++)
    {
        // Without translation and with gravity known little is left that could have several minima.
        const MotionHypothesis& hypothesis = fits[i].hypothesis;
        const bool isBest = hypothesis.motion == best.hypothesis.motion && hypothesis.walls == best.hypothesis.walls;
        Model start;
        if (isBest || (!hypothesis.translates() && problem.gravitySigma == 0) || !convert(best, hypothesis, start))
            continue;
        if (!problem.limits.allow(start) || !wallsAreSeen(problem, hypothesis, start))
            continue;
        const Fit other = refineFrom(problem, start, hypothesis);
        if (other.cost < fits[i].cost)
            fits[i] = other;
    }
}

Fit selectMotion(RefinementProblem& problem, const AckermannEstimator::Params& params)
{
    const std::vector<MotionHypothesis> hypotheses = allowedHypotheses(params.model, problem.heading);
    std::vector<Fit> fits;
    for (size_t i = 0; i < hypotheses.size(); i++)
    {
        std::vector<Model> starts(1);
        if (!fitVerticals(problem, params, hypotheses[i], starts[0]))
            continue;
        for (size_t j = 0; j < fits.size(); j++)
            if (hypotheses[i].motion == MODEL_4LA && fits[j].hypothesis.walls == hypotheses[i].walls)
                starts.push_back(fits[j].model);
        fits.push_back(fitAllSegments(problem, hypotheses[i], starts));
    }

    startFromBest(problem, fits);

    // Again with the noise that was found, which decides how much evidence there is; until it stays about the same.
    for (int pass = 0; pass < 4; pass++)
    {
        const double before = problem.sigma;
        measureNoise(bestOf(fits), problem);
        dropHopeless(fits);
        for (size_t i = 0; i < fits.size(); i++)
            refineAgain(problem, fits[i]);
        if (problem.sigma > before / 3)
            break;
    }

    const double lowest = bestOf(fits).criterion;
    for (size_t i = 0; i < fits.size(); i++)
        if (fits[i].criterion < lowest + RELEVANT)
            exploreValley(problem, fits[i]);
    Fit best = bestOf(fits);
    addOtherHypotheses(fits, best);
    return best;
}

}} // namespace cv::rsackermann
