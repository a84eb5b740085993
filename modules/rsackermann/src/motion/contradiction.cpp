// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "contradiction.hpp"

namespace cv { namespace rsackermann {

bool contradicts(double seen, double seenSigma, double given, double givenSigma)
{
    return seenSigma > 0 && givenSigma > 0 &&
           std::abs(seen - given) > CONTRADICTION * std::hypot(seenSigma, givenSigma);
}

// Without a wall's distance the sign is known, if the speed is.
bool showsOtherDirection(const AckermannMotion& seen, const MotionPrior& prior)
{
    const double B = seen.wallSlope, D = seen.wallOffset, scaled = std::hypot(B, D);
    const Matx44d& C = seen.covariance;
    const double sigma =
        std::sqrt(std::max(B * B * C(1, 1) + 2 * B * D * C(1, 2) + D * D * C(2, 2), 0.)) / std::max(scaled, DBL_MIN);
    return prior.speedSigma > 0 && seen.direction * prior.speed < -CONTRADICTION * prior.speedSigma && sigma > 0 &&
           scaled > CONTRADICTION * sigma;
}

void compareWithGiven(const MotionPrior& prior, bool isOtherDirection, AckermannMotion& motion)
{
    motion.contradictsPrior =
        isOtherDirection ||
        contradicts(motion.seenYawRate, motion.seenYawRateSigma, prior.yawRate, prior.yawRateSigma) ||
        contradicts(motion.seenSpeed, motion.seenSpeedSigma, prior.speed, prior.speedSigma);
}

void compareAgain(const MotionPrior& used, const MotionPrior& given, AckermannMotion& motion)
{
    const bool isOther = contradicts(motion.seenYawRate, motion.seenYawRateSigma, used.yawRate, used.yawRateSigma);
    const bool isOtherDirection = motion.contradictsPrior && !isOther; // or the speed, which is compared once more
    if (!(given.yawRateSigma > 0))
        motion.seenYawRate = motion.seenYawRateSigma = 0;
    compareWithGiven(given, isOtherDirection, motion);
}

}} // namespace cv::rsackermann
