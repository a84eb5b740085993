// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "posterior.hpp"

namespace cv { namespace rsackermann {

// The road keeps its distance over that of the wall.
static double roadOf(const Posterior& found, const Model& model)
{
    const double speed = std::hypot(found.model[P_B], found.model[P_D]);
    return speed > 0 ? found.G * std::hypot(model[P_B], model[P_D]) / speed : found.G;
}

void addFocalUncertainty(const RefinementProblem& problem, const RollingShutterCamera& camera,
                         const AckermannEstimator::Params& params, const MotionPrior& prior, const Mat& segments,
                         Posterior& found)
{
    if (!(camera.focalSigma > 0))
        return;
    const double longer = 1 + camera.focalSigma / camera.cameraMatrix(0, 0);
    RollingShutterCamera other = camera;
    other.cameraMatrix(0, 0) *= longer;
    other.cameraMatrix(1, 1) *= longer;
    const MotionLimits limits(other, params);
    const DrivingPrior driving(prior, other, params, limits);
    RefinementProblem rescaled = problem;
    rescaled.limits = limits;
    rescaled.prior = &driving;
    rescaled.focal = other.cameraMatrix(0, 0);
    selectCandidates(segments, other, params, rescaled.verticals, rescaled.others);
    if (rescaled.verticals.empty())
        return; // a camera that sees nothing upright
    rescaled.arrange();

    Fit fit(found.hypothesis), otherFit(found.hypothesis);
    Model &model = fit.model, &otherModel = otherFit.model;
    model = otherModel = found.model;
    fit.refine(problem);
    otherFit.refine(rescaled);
    if (!(fit.cost < DBL_MAX && otherFit.cost < DBL_MAX))
        return;
    DisplacementField::Values displacement, otherDisplacement;
    DisplacementField(camera, problem.ends()).displacement(model, roadOf(found, model), displacement);
    DisplacementField(other, rescaled.ends()).displacement(otherModel, roadOf(found, otherModel), otherDisplacement);
    const double moved =
        DisplacementField::meanDistance(displacement, otherDisplacement, DisplacementField::Variances());
    found.expectedResidual = std::hypot(found.expectedResidual, moved);

    // A motion per second is another one per unit of row time.
    otherModel[P_ALPHA] /= longer;
    otherModel[P_B] /= longer;
    otherModel[P_D] /= longer;
    const Vec<double, PARAMETERS> difference = otherModel.value - model.value;
    found.covariance += difference * difference.t();
}

}} // namespace cv::rsackermann
