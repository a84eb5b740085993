// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "peak_moments.hpp"
#include "yaw_sweep.hpp"

namespace cv { namespace rsackermann {

double logEvidence(const RefinementProblem& problem, const Fit& fit)
{
    double volume = logVolume(fit) - problem.prior->logVolume(fit.hypothesis);
    // In the logarithms of the wall's scaled speed and of the ratio, and in the azimuth.
    if (fit.hypothesis.translates())
        volume -= 2 * std::log(std::hypot(fit.model[P_B], fit.model[P_D]));
    if (fit.hypothesis.walls == 2)
        volume -= std::log(fit.model[P_LAMBDA]);
    return volume - fit.cost / 2;
}

YawSweep::YawSweep(const RefinementProblem& problem, const Fit& minimum, const std::vector<YawSweep>& valleys)
{
    const MotionHypothesis& hypothesis = minimum.hypothesis;
    const double scale = problem.prior->alphaScale(), variance = minimum.covariance(P_ALPHA, P_ALPHA);
    Fit middle(MotionHypothesis(hypothesis.translates() ? MODEL_3LA : MODEL_NONE, hypothesis.walls));
    middle.model = minimum.model;
    const auto addNext = [&](Fit& fit, double before, double offset, double width) {
        Model next = fit.model;
        for (int i = 0; i < PARAMETERS && variance > 0; i++)
            next.value[i] += (offset - before) * minimum.covariance(i, P_ALPHA) / variance;
        if (!isAllowed(problem, hypothesis, next))
            next = fit.model;
        next[P_ALPHA] = minimum.model[P_ALPHA] + offset;
        if (offset != 0 && !problem.limits.allow(next))
            return -DBL_MAX;
        fit.model = next;
        const double density = add(problem, width, fit);
        if (offset == 0 || !contain(valleys, fit))
            return density;
        fits.pop_back();
        logMasses.pop_back();
        return -DBL_MAX;
    };
    sweepYaw(middle, variance > 0 ? std::sqrt(variance) : scale, scale, 2 * problem.limits.maxAlpha, addNext);
}

// Refines the motion at the yaw rate of a fit. Returns the logarithm of its density.
double YawSweep::add(const RefinementProblem& problem, double width, Fit& fit)
{
    const int iterations = 8;
    fit.cost = refine(problem, fit.hypothesis, ALL_SEGMENTS, iterations, fit.model, &fit.covariance);
    const double density = logEvidence(problem, fit) + problem.prior->logYawDensity(fit.model[P_ALPHA]);
    fits.push_back(fit);
    highest = std::max(highest, density);
    if (density > highest + std::log(SMALL_SHARE))
        integratePeak(problem, fits.back());
    logMasses.push_back(density + std::log(width));
    return density;
}

// Compared with what is between the next motions on both sides.
bool YawSweep::contains(const Fit& fit) const
{
    const double alpha = fit.model[P_ALPHA];
    const Fit *below = 0, *above = 0;
    for (const Fit& f : fits)
    {
        const double other = f.model[P_ALPHA];
        if (other <= alpha && (!below || other > below->model[P_ALPHA]))
            below = &f;
        if (other >= alpha && (!above || other < above->model[P_ALPHA]))
            above = &f;
    }
    if (!below || !above)
        return false;
    const double range = above->model[P_ALPHA] - below->model[P_ALPHA],
                 share = range > 0 ? (alpha - below->model[P_ALPHA]) / range : 0;
    Fit between = share < 0.5 ? *below : *above;
    between.model.value = (1 - share) * below->model.value + share * above->model.value;
    return isAt(between, fit.model);
}

bool contain(const std::vector<YawSweep>& valleys, const Fit& fit)
{
    return std::any_of(valleys.begin(), valleys.end(), [&](const YawSweep& v) { return v.contains(fit); });
}

}} // namespace cv::rsackermann
