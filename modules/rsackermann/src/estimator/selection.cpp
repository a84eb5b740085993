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

namespace cv {
namespace rsackermann {

// Two walls are only seen together by a camera that looks along the street.
static bool canSeeTwoWalls(const Heading& heading)
{
    return std::abs(heading.c) > 0.5;
}

// From simple to rich: the richer ones start from the simpler ones, too.
static std::vector<MotionHypothesis> allowedStructures(int model, const Heading& heading)
{
    std::vector<MotionHypothesis> structures(1, MotionHypothesis(MODEL_NONE, 0));
    const int motions[3] = {MODEL_1LA, MODEL_3LA, MODEL_4LA};
    for (int i = 0; i < 3; i++)
    {
        if (model != MODEL_AUTO && model != motions[i])
            continue;
        if (motions[i] == MODEL_1LA)
        {
            structures.push_back(MotionHypothesis(MODEL_1LA, 0));
            continue;
        }
        structures.push_back(MotionHypothesis(motions[i], 1));
        if (canSeeTwoWalls(heading))
            structures.push_back(MotionHypothesis(motions[i], 2));
    }
    return structures;
}

// The best model of a hypothesis for the verticals alone. Returns false where there is none.
static bool fitVerticals(const RefinementProblem& problem, const AckermannEstimator::Params& params, const MotionHypothesis& hypothesis, Model& model)
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
static Fit fitAllSegments(const RefinementProblem& problem, const MotionHypothesis& hypothesis, const std::vector<Model>& starts)
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
    residuals.erase(std::remove_if(residuals.begin(), residuals.end(), [gross](double r) { return !(r < gross); }), residuals.end());
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
    const double low = 0.005, high = 0.6;
    problem.sigma = std::min(std::max(medianSigma(verticals, 4 * problem.sigma, problem.sigma), low), high);
    problem.directionSigma = std::min(std::max(medianSigma(others, 3 * problem.directionSigma, problem.directionSigma), problem.sigma), 1.);
    // Less noise doesn't make the deviations of real walls from planes smaller.
    problem.lossScale = std::max(problem.lossScale, 0.6 * lossWidth / problem.sigma);
    problem.weigh();
}

// What is far behind can't win with another noise, and need not be refined again.
static void dropHopeless(std::vector<Fit>& fits)
{
    const double far = 100, best = bestOf(fits).criterion;
    fits.erase(std::remove_if(fits.begin(), fits.end(), [best, far](const Fit& f) { return f.criterion > best + far; }), fits.end());
}

// What a hypothesis makes of the model of another one; false where that says nothing of its walls.
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

// Structures compare fairly where each has the best minimum that it can have: starts from the one of the best fit, too.
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
    const std::vector<MotionHypothesis> structures = allowedStructures(params.model, problem.heading);
    std::vector<Fit> fits;
    for (size_t i = 0; i < structures.size(); i++)
    {
        std::vector<Model> starts(1);
        if (!fitVerticals(problem, params, structures[i], starts[0]))
            continue;
        for (size_t j = 0; j < fits.size(); j++)
            if (structures[i].motion == MODEL_4LA && fits[j].hypothesis.walls == structures[i].walls)
                starts.push_back(fits[j].model);
        fits.push_back(fitAllSegments(problem, structures[i], starts));
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

    const double relevant = 10, lowest = bestOf(fits).criterion;
    for (size_t i = 0; i < fits.size(); i++)
        if (fits[i].criterion < lowest + relevant)
            exploreValley(problem, fits[i]);
    Fit best = bestOf(fits);
    addOtherStructures(fits, best);
    return best;
}

}} // namespace cv::rsackermann
