// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "lo_ransac.hpp"
#include "selection.hpp"
#include "street_direction.hpp"
#include "vertical_residual.hpp"

namespace cv {
namespace rsackermann {

// Two walls are only seen together by a camera that looks along the street.
static bool canSeeTwoWalls(double heading)
{
    return std::abs(std::cos(heading)) > 0.5;
}

static std::vector<Structure> allowedStructures(int model, double heading)
{
    std::vector<Structure> structures;
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
static bool fitVerticals(const RefinementProblem& problem, const AckermannEstimator::Params& params, Fit& fit)
{
    if (fit.structure.motion == MODEL_NONE)
        return true;
    RansacOptions options;
    options.confidence = params.confidence;
    options.maxIterations = params.maxIterations;
    options.seed = (uint64)params.seed;
    CandidateConsensus consensus(problem, fit.structure, params.threshold);
    double score;
    if (!loRansac(consensus, options, fit.model, score))
        return false;
    refine(problem, fit.structure, VERTICALS_ONLY, 20, fit.model);
    return true;
}

// Joint refinement from the direction of the street that the verticals tell and from the one that the other segments tell.
static void fitAllSegments(const RefinementProblem& problem, Fit& fit)
{
    Model fromLines = fit.model;
    const bool hasLines = startFromStreetDirection(problem, fit.structure, fromLines);
    fit.cost = refine(problem, fit.structure, ALL_SEGMENTS, 30, fit.model, &fit.covariance);
    if (hasLines)
    {
        Fit other = fit;
        other.model = fromLines;
        other.cost = refine(problem, fit.structure, ALL_SEGMENTS, 30, other.model, &other.covariance);
        if (other.cost < fit.cost)
            fit = other;
    }
    fit.criterion = fit.cost + fit.structure.unknowns() * std::log((double)problem.verticals.size());
}

Fit selectMotion(const RefinementProblem& problem, const AckermannEstimator::Params& params)
{
    std::vector<Structure> structures = allowedStructures(params.model, problem.heading);
    structures.insert(structures.begin(), Structure(MODEL_NONE, 0));
    Fit best(structures[0]);
    for (size_t i = 0; i < structures.size(); i++)
    {
        Fit next(structures[i]);
        if (!fitVerticals(problem, params, next))
            continue;
        fitAllSegments(problem, next);
        if (next.criterion < best.criterion)
            best = next;
    }
    return best;
}

}} // namespace cv::rsackermann
