// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "lo_ransac.hpp"
#include "selection.hpp"

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

static void fit(const RefinementProblem& problem, const AckermannEstimator::Params& params, Fit& result)
{
    RansacOptions options;
    options.confidence = params.confidence;
    options.maxIterations = params.maxIterations;
    options.seed = (uint64)params.seed;
    CandidateConsensus consensus(problem, result.structure, params.threshold);
    double score;
    if (!loRansac(consensus, options, result.model, score))
        return;
    result.cost = refine(problem, result.structure, 30, result.model);
    result.criterion = result.cost + result.structure.unknowns() * std::log((double)problem.candidates->size());
}

Fit selectMotion(const RefinementProblem& problem, const AckermannEstimator::Params& params)
{
    Fit best(Structure(MODEL_NONE, 0));
    best.cost = best.criterion = refinementCost(problem, best.model);
    const std::vector<Structure> structures = allowedStructures(params.model, problem.heading);
    for (size_t i = 0; i < structures.size(); i++)
    {
        Fit next(structures[i]);
        fit(problem, params, next);
        if (next.criterion < best.criterion)
            best = next;
    }
    return best;
}

}} // namespace cv::rsackermann
