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
    const DrivingPrior driving(prior, other, params);
    RefinementProblem rescaled = problem;
    rescaled.limits = MotionLimits(other, params);
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

namespace {

class OtherLens
{
public:
    OtherLens(const Matx33d& upright_, double distortion_) : upright(upright_), distortion(distortion_) {}

    // Of an upright bearing with z = 1.
    bool bend(const Vec3d& bearing, Vec3d& bent) const
    {
        const Vec3d ray = upright.t() * bearing;
        const double r2 = (ray[0] * ray[0] + ray[1] * ray[1]) / (ray[2] * ray[2]), stretch = 1 + distortion * r2;
        if (!(1 + 3 * distortion * r2 > 0)) // the derivative of r (1 + distortion r^2)
            return false;
        bent = upright * Vec3d(ray[0] * stretch, ray[1] * stretch, ray[2]);
        if (!(bent[2] > 0))
            return false;
        bent *= 1 / bent[2];
        return true;
    }

    bool bendSegment(UprightSegment& s) const { return bend(s.u, s.u) && bend(s.v, s.v); }

private:
    Matx33d upright;
    double distortion;
};

} // namespace

static double slantOf(const UprightSegment& s)
{
    return (s.u[0] - s.v[0]) / norm(s.u - s.v);
}

// d(slant through the lens) / d(slant), by finite differences.
static bool slantDerivative(const OtherLens& lens, const UprightSegment& s, double& derivative)
{
    const Vec3d step(1e-4, 0, 0);
    UprightSegment more = s, less = s;
    more.u += step;
    more.v -= step;
    less.u -= step;
    less.v += step;
    const double before = slantOf(more) - slantOf(less);
    if (!lens.bendSegment(more) || !lens.bendSegment(less))
        return false;
    derivative = std::abs((slantOf(more) - slantOf(less)) / before);
    return true;
}

bool seeThroughOtherLens(double distortion, RefinementProblem& problem, double& logJacobian)
{
    const OtherLens lens(problem.uprightRotation, distortion);
    logJacobian = 0;
    for (size_t i = 0; i < problem.verticals.size(); i++)
    {
        double derivative;
        if (!slantDerivative(lens, problem.verticals[i], derivative) || !lens.bendSegment(problem.verticals[i]))
            return false;
        logJacobian += std::log(derivative);
    }
    for (size_t i = 0; i < problem.others.size(); i++)
        if (!lens.bendSegment(problem.others[i]))
            return false;
    problem.arrange();
    return true;
}

}} // namespace cv::rsackermann
