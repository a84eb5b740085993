// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/line_delay_sigma.hpp"
#include "given_prior.hpp"

namespace cv { namespace rsackermann {

PriorTerms::PriorTerms(const MotionPrior& prior, const RollingShutterCamera& camera,
                       const AckermannEstimator::Params& params)
    : alpha(0), alphaSigma(0), scaledSpeed(0), scaledSpeedSigma(0), street(prior.wallDirection),
      streetSigma(prior.wallDirectionSigma), heading(camera.heading), headingSigma(params.wallDeviationSigma),
      reversePenalty(-2 * std::log(params.reverseProbability))
{
    const double unit = camera.secondsPerUnitTime();
    if (unit > 0 && prior.yawRateSigma > 0)
    {
        alpha = prior.yawRate * unit / 2;
        alphaSigma = rateSigma(camera, prior.yawRate, prior.yawRateSigma) * unit / 2;
    }
    if (unit > 0 && prior.speedSigma > 0 && params.wallDistance > 0)
    {
        scaledSpeed = prior.speed * unit / params.wallDistance;
        scaledSpeedSigma = rateSigma(camera, prior.speed, prior.speedSigma) * unit / params.wallDistance;
    }
}

int PriorTerms::evaluate(const Model& model, const MotionHypothesis& hypothesis, Jet residuals[MAX_RESIDUALS]) const
{
    int n = 0;
    const Jet a = Jet::variable(model[P_ALPHA], P_ALPHA), B = Jet::variable(model[P_B], P_B),
              D = Jet::variable(model[P_D], P_D);
    if (alphaSigma > 0)
        residuals[n++] = (1 / alphaSigma) * (a - alpha);
    if (scaledSpeedSigma > 0)
        residuals[n++] = (1 / scaledSpeedSigma) * (double(model.direction) * length(B, D) - scaledSpeed);
    if (streetSigma > 0 && hypothesis.translates())
        residuals[n++] = (1 / streetSigma) * (std::cos(street) * D - std::sin(street) * B) / (length(B, D) + 1e-12);
    else if (streetSigma > 0)
        residuals[n++] = (1 / streetSigma) * (Jet::variable(model[P_STREET], P_STREET) - street);
    // The cost of a residual is its square.
    if (headingSigma > 0 && hypothesis.translates())
        residuals[n++] = (1 / headingSigma) * (std::cos(heading) * D - std::sin(heading) * B) / (length(B, D) + 1e-12);
    if (hypothesis.walls == 2)
    {
        const Jet ratio = Jet::variable(model[P_LAMBDA], P_LAMBDA);
        residuals[n++] = (1 / USUAL_LOG_RATIO) * ratio.apply(std::log(ratio.value), 1 / ratio.value);
    }
    if (model.direction < 0)
        residuals[n++] = Jet(std::sqrt(reversePenalty));
    return n;
}

}} // namespace cv::rsackermann
