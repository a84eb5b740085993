// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "fit.hpp"

namespace cv { namespace rsackermann {

// Of the information criterion.
static const double ERROR_DEPENDENCE = 1.5;
static const double USUAL_SECOND_WALL = 4;
static const double UNSEEN_SECOND_WALL = 2;

// With a larger penalty than for independent errors: those of neighbouring segments are alike. The number of walls
// belongs to the scene rather than to the motion: a camera that looks along a street usually has two, and their ratio
// costs the information that is learnt of it, which is the volume of its distribution before over that after; unless no
// vertical shows the second one.
static double criterion(const RefinementProblem& problem, const Fit& fit)
{
    const int unknowns = (fit.hypothesis.turns() ? 1 : 0) + (fit.hypothesis.translates() ? 2 : 0);
    double result = fit.cost + ERROR_DEPENDENCE * unknowns * std::log((double)problem.verticals.size());
    if (fit.hypothesis.walls == 2)
    {
        const double usual = USUAL_LOG_RATIO * fit.model[P_LAMBDA];
        const double learnt = std::log(usual * usual / std::max(fit.covariance(P_LAMBDA, P_LAMBDA), DBL_MIN));
        result += learnt > std::log(2.) ? learnt - USUAL_SECOND_WALL : UNSEEN_SECOND_WALL;
    }
    return result;
}

Fit refineFrom(const RefinementProblem& problem, const Model& start, const MotionHypothesis& hypothesis)
{
    Fit fit(hypothesis);
    fit.model = start;
    refineAgain(problem, fit);
    return fit;
}

void refineAgain(const RefinementProblem& problem, Fit& fit)
{
    fit.cost = refine(problem, fit.hypothesis, ALL_SEGMENTS, 30, fit.model, &fit.covariance, &fit.inflation);
    fit.criterion = criterion(problem, fit);
}

Model turned(const Model& model, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    Model result = model;
    result[P_B] = c * model[P_B] - s * model[P_D];
    result[P_D] = s * model[P_B] + c * model[P_D];
    return result;
}

Matx<double, PARAMETERS, PARAMETERS> covarianceAround(const Fit& fit, const Model& model)
{
    Vec<double, PARAMETERS> difference;
    for (int k = 0; k < PARAMETERS; k++)
        difference[k] = fit.model.value[k] - model.value[k];
    return fit.covariance + difference * difference.t();
}

}} // namespace cv::rsackermann
