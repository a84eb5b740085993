// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../motion/contradiction.hpp"
#include "contradicted_values.hpp"

namespace cv { namespace rsackermann {

bool isGiven(const MotionPrior& prior)
{
    return prior.yawRateSigma > 0 || prior.speedSigma > 0 || prior.wallDirectionSigma > 0;
}

// Returns whether a value errs, as far as is known.
static bool errs(double seen, double seenSigma, double given, double givenSigma, double& error)
{
    if (contradicts(seen, seenSigma, given, givenSigma))
        error = seen - given;
    else if (contradicts(seen, seenSigma, given + error, givenSigma))
        error = 0;
    return givenSigma > 0 && error != 0;
}

MotionPrior ContradictedValues::usable(const MotionPrior& prior, bool isOtherDirection, AckermannMotion& motion)
{
    const bool yawRateErrs =
        errs(motion.seenYawRate, motion.seenYawRateSigma, prior.yawRate, prior.yawRateSigma, yawRateError);
    const bool speedErrs = errs(motion.seenSpeed, motion.seenSpeedSigma, prior.speed, prior.speedSigma, speedError);
    motion.contradictsPrior = yawRateErrs || speedErrs || isOtherDirection;
    MotionPrior result = prior;
    if (yawRateErrs)
        result.yawRateSigma = 0;
    if (speedErrs || isOtherDirection)
        result.speedSigma = 0;
    return result;
}

}} // namespace cv::rsackermann
