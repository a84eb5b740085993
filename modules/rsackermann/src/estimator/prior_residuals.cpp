// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "prior_residuals.hpp"
#include <Eigen/Cholesky>

namespace cv {
namespace rsackermann {

PriorTerms::PriorTerms(const MotionPrior& prior, const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
                       const MotionLimits& limits)
    : alpha(0), alphaSigma(0), sampleAlpha(0), sampleAlphaSigma(0), size(0), sizeSigma(0), street(prior.wallDirection), streetSigma(prior.wallDirectionSigma), hasPrevious(false),
      usualAlpha(0.5 * limits.maxAlpha), heading(camera.heading), headingSigma(params.wallDeviationSigma), reversePenalty(-2 * std::log(params.reverseProbability))
{
    const double unit = camera.secondsPerUnitTime();
    if (unit > 0 && prior.yawRateSigma > 0)
    {
        alpha = prior.yawRate * unit / 2;
        alphaSigma = prior.yawRateSigma * unit / 2;
    }
    sampleAlpha = alpha;
    sampleAlphaSigma = alphaSigma;
    if (unit > 0 && prior.speedSigma > 0 && params.wallDistance > 0)
    {
        size = prior.speed * unit / params.wallDistance;
        sizeSigma = prior.speedSigma * unit / params.wallDistance;
    }
    const AckermannMotion& m = prior.previous;
    if (!(prior.previousNoise > 0) || m.status != MOTION_OK)
        return;
    // The covariance of the previous estimate and what may have changed since, for what was part of its model. Nothing is
    // known of the rest: its information is 0.
    const bool isKnown[4] = {m.model == MODEL_1LA || m.model == MODEL_4LA, m.wallSlope != 0 || m.wallOffset != 0, m.wallSlope != 0 || m.wallOffset != 0, m.wallRatio > 0};
    const double values[4] = {m.alpha, m.wallSlope, m.wallOffset, m.wallRatio};
    const double wall = std::hypot(m.wallSlope, m.wallOffset);
    const double ranges[4] = {limits.maxAlpha, wall, wall, m.wallRatio};
    Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();
    for (int i = 0; i < 4; i++)
    {
        previous[i] = values[i];
        if (!isKnown[i])
            continue;
        for (int j = 0; j < 4; j++)
            if (isKnown[j])
                covariance(i, j) = m.covariance(i, j);
        covariance(i, i) += std::pow(prior.previousNoise * ranges[i], 2);
    }
    const Eigen::LLT<Eigen::Matrix4d> factor(covariance);
    if (factor.info() != Eigen::Success)
        return;
    const Eigen::Matrix4d whitening = factor.matrixL().solve(Eigen::Matrix4d::Identity());
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            previousInformation(i, j) = isKnown[i] && isKnown[j] ? whitening(i, j) : 0;
    hasPrevious = true;
    const double carriedSigma = std::sqrt(covariance(0, 0));
    if (isKnown[0] && (!(sampleAlphaSigma > 0) || carriedSigma < sampleAlphaSigma))
    {
        sampleAlpha = m.alpha;
        sampleAlphaSigma = carriedSigma;
    }
}

int PriorTerms::evaluate(const Model& model, const Structure& structure, Jet residuals[MAX_RESIDUALS]) const
{
    int n = 0;
    const Jet a = Jet::variable(model[P_ALPHA], P_ALPHA), B = Jet::variable(model[P_B], P_B), D = Jet::variable(model[P_D], P_D);
    if (alphaSigma > 0)
        residuals[n++] = (1 / alphaSigma) * (a - alpha);
    if (sizeSigma > 0)
        residuals[n++] = (1 / sizeSigma) * (double(model.direction) * length(B, D) - size);
    if (streetSigma > 0 && structure.translates())
        residuals[n++] = (1 / streetSigma) * (std::cos(street) * D - std::sin(street) * B) / (length(B, D) + 1e-12);
    else if (streetSigma > 0)
        residuals[n++] = (1 / streetSigma) * (Jet::variable(model[P_STREET], P_STREET) - street);
    if (usualAlpha > 0 && structure.turns())
        residuals[n++] = (1 / usualAlpha) * a;
    // The cost of a residual is its square.
    if (headingSigma > 0 && structure.translates())
        residuals[n++] = (1 / headingSigma) * (std::cos(heading) * D - std::sin(heading) * B) / (length(B, D) + 1e-12);
    if (structure.walls == 2)
    {
        const Jet ratio = Jet::variable(model[P_LAMBDA], P_LAMBDA);
        residuals[n++] = (1 / usualLogRatio()) * ratio.apply(std::log(ratio.value), 1 / ratio.value);
    }
    if (model.direction < 0)
        residuals[n++] = Jet(std::sqrt(reversePenalty));
    if (hasPrevious)
    {
        const Jet change[4] = {a - previous[0], B - previous[1], D - previous[2], Jet::variable(model[P_LAMBDA], P_LAMBDA) - previous[3]};
        for (int i = 0; i < 4; i++)
        {
            Jet& r = residuals[n++];
            r = Jet();
            for (int j = 0; j <= i; j++)
                r = r + previousInformation(i, j) * change[j];
        }
    }
    return n;
}

}} // namespace cv::rsackermann
