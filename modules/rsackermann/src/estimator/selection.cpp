// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "direction_residual.hpp"
#include "lo_ransac.hpp"
#include "selection.hpp"
#include "street_direction.hpp"
#include "vertical_residual.hpp"

namespace cv {
namespace rsackermann {

// Two walls are only seen together by a camera that looks along the street.
static bool canSeeTwoWalls(const Heading& heading)
{
    return std::abs(heading.c) > 0.5;
}

// From simple to rich: the richer ones start from the simpler ones, too.
static std::vector<Structure> allowedStructures(int model, const Heading& heading)
{
    std::vector<Structure> structures(1, Structure(MODEL_NONE, 0));
    const int motions[3] = {MODEL_1LA, MODEL_3LA, MODEL_4LA};
    for (int i = 0; i < 3; i++)
    {
        if (model != MODEL_AUTO && model != motions[i])
            continue;
        if (motions[i] == MODEL_1LA)
        {
            structures.push_back(Structure(MODEL_1LA, 0));
            continue;
        }
        structures.push_back(Structure(motions[i], 1));
        if (canSeeTwoWalls(heading))
            structures.push_back(Structure(motions[i], 2));
    }
    return structures;
}

// The best model of a structure for the verticals alone. Returns false where there is none.
static bool fitVerticals(const RefinementProblem& problem, const AckermannEstimator::Params& params, const Structure& structure, Model& model)
{
    if (structure.motion == MODEL_NONE)
        return true;
    RansacOptions options;
    options.confidence = params.confidence;
    options.maxIterations = params.maxIterations;
    options.seed = (uint64)params.seed;
    CandidateConsensus consensus(problem, structure, params.threshold);
    double score;
    if (!loRansac(consensus, options, model, score))
        return false;
    refine(problem, structure, VERTICALS_ONLY, 20, model);
    return true;
}

// Bayesian information criterion, with a larger penalty than for independent errors: those of neighbouring segments are
// alike. A second wall belongs to the scene rather than to the motion and costs no more than what it explains by chance.
static double criterion(const RefinementProblem& problem, const Structure& structure, double cost)
{
    const double dependence = 1.5, secondWall = 2;
    const int unknowns = (structure.turns() ? 1 : 0) + (structure.translates() ? 2 : 0);
    return cost + dependence * unknowns * std::log((double)problem.verticals.size()) + (structure.walls == 2 ? secondWall : 0);
}

static void refineFrom(const RefinementProblem& problem, const Model& start, const Structure& structure, std::vector<Fit>& minima)
{
    Fit next(structure);
    next.model = start;
    next.cost = refine(problem, structure, ALL_SEGMENTS, 30, next.model, &next.covariance);
    minima.push_back(next);
}

static bool isCheaper(const Fit& a, const Fit& b)
{
    return a.cost < b.cost;
}

// Mean square deviation of a fit's motion, with its covariance, from another model.
static Matx<double, PARAMETERS, PARAMETERS> covarianceAround(const Fit& fit, const Model& model)
{
    Vec<double, PARAMETERS> difference;
    for (int k = 0; k < PARAMETERS; k++)
        difference[k] = fit.model.value[k] - model.value[k];
    return fit.covariance + difference * difference.t();
}

// The best minimum, with the covariance of the mixture of all of them: another one that is nearly as good is as likely.
static Fit mixture(std::vector<Fit>& minima)
{
    std::sort(minima.begin(), minima.end(), isCheaper);
    Fit best = minima[0];
    double sum = 1;
    for (size_t i = 1; i < minima.size(); i++)
    {
        const double likelihood = std::exp(-(minima[i].cost - best.cost) / 2);
        bool isNew = minima[i].model.direction == best.model.direction;
        for (size_t j = 0; j < i && isNew; j++)
            isNew = std::abs(minima[i].model[P_ALPHA] - minima[j].model[P_ALPHA]) > 0.2 * std::sqrt(minima[0].covariance(P_ALPHA, P_ALPHA));
        if (!isNew || !(likelihood > 1e-6))
            continue;
        best.covariance += likelihood * covarianceAround(minima[i], minima[0].model);
        sum += likelihood;
    }
    best.covariance *= 1 / sum;
    return best;
}

// Joint refinement from several starts, and from each with the street where the other segments see it.
static Fit fitAllSegments(const RefinementProblem& problem, const Structure& structure, const std::vector<Model>& starts)
{
    std::vector<Fit> minima;
    for (size_t i = 0; i < starts.size(); i++)
    {
        refineFrom(problem, starts[i], structure, minima);
        Model turned = starts[i];
        if (startFromStreetDirection(problem, structure, turned))
            refineFrom(problem, turned, structure, minima);
    }
    Fit fit = *std::min_element(minima.begin(), minima.end(), isCheaper);
    fit.criterion = criterion(problem, structure, fit.cost);
    return fit;
}

// Refinement of a fit for another noise.
static void refineAgain(const RefinementProblem& problem, Fit& fit)
{
    fit.cost = refine(problem, fit.structure, ALL_SEGMENTS, 30, fit.model, &fit.covariance);
    fit.criterion = criterion(problem, fit.structure, fit.cost);
}

// Yaw rate and walls can take each other's place: looks for other minima to both sides along that valley.
static void exploreValley(const RefinementProblem& problem, Fit& fit)
{
    const double sigma = std::sqrt(fit.covariance(P_ALPHA, P_ALPHA));
    if (fit.structure.motion != MODEL_4LA || !(sigma > 0))
        return;
    std::vector<Fit> minima(1, fit);
    const double steps[] = {-4, -2, 2, 4};
    for (int k = 0; k < 4; k++)
    {
        Model start = fit.model;
        for (int i = 0; i < PARAMETERS; i++)
            start.value[i] += steps[k] * fit.covariance(i, P_ALPHA) / sigma;
        if (problem.limits.allow(start))
            refineFrom(problem, start, fit.structure, minima);
    }
    fit = mixture(minima);
    fit.criterion = criterion(problem, fit.structure, fit.cost);
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
    const PreparedModel prepared(fit.model, problem.heading, problem.roadRatio, fit.structure.translates());
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

Fit selectMotion(RefinementProblem& problem, const AckermannEstimator::Params& params)
{
    const std::vector<Structure> structures = allowedStructures(params.model, problem.heading);
    std::vector<Fit> fits;
    for (size_t i = 0; i < structures.size(); i++)
    {
        std::vector<Model> starts(1);
        if (!fitVerticals(problem, params, structures[i], starts[0]))
            continue;
        for (size_t j = 0; j < fits.size(); j++)
            if (structures[i].motion == MODEL_4LA && fits[j].structure.walls == structures[i].walls)
                starts.push_back(fits[j].model);
        fits.push_back(fitAllSegments(problem, structures[i], starts));
    }

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

    // A motion without yaw doesn't say how well its yaw rate of 0 is known: the richer one does, as seen from it.
    Fit best = bestOf(fits);
    exploreValley(problem, best);
    for (size_t i = 0; i < fits.size(); i++)
        if (best.structure.motion == MODEL_3LA && fits[i].structure.motion == MODEL_4LA && fits[i].structure.walls == best.structure.walls)
        {
            exploreValley(problem, fits[i]);
            best.covariance = covarianceAround(fits[i], best.model);
        }
    return best;
}

}} // namespace cv::rsackermann
