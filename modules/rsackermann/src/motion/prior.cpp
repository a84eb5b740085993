// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../checks.hpp"

namespace cv {
namespace rsackermann {

MotionPrior::MotionPrior()
    : speed(0), speedSigma(0), yawRate(0), yawRateSigma(0), wallDirection(0), wallDirectionSigma(0), previousNoise(0)
{
}

void MotionPrior::check() const
{
    checkFinite(speed, "prior.speed");
    checkNotNegative(speedSigma, "prior.speedSigma", "not known");
    checkFinite(yawRate, "prior.yawRate");
    checkNotNegative(yawRateSigma, "prior.yawRateSigma", "not known");
    checkFinite(wallDirection, "prior.wallDirection");
    checkNotNegative(wallDirectionSigma, "prior.wallDirectionSigma", "not known");
    checkNotNegative(previousNoise, "prior.previousNoise", "no previous frame");
}

}} // namespace cv::rsackermann
