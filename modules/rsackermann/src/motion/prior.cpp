// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../checks.hpp"
#include "../storage.hpp"

namespace cv { namespace rsackermann {

MotionPrior::MotionPrior()
    : speed(0), speedSigma(0), yawRate(0), yawRateSigma(0), wallDirection(0), wallDirectionSigma(0)
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
}

void MotionPrior::write(FileStorage& fs) const
{
    fs << "speed" << speed << "speed_sigma" << speedSigma << "yaw_rate" << yawRate << "yaw_rate_sigma" << yawRateSigma;
    fs << "wall_direction" << wallDirection << "wall_direction_sigma" << wallDirectionSigma;
}

void MotionPrior::read(const FileNode& fn)
{
    readFields(fn, "speed", speed, "speed_sigma", speedSigma, "yaw_rate", yawRate, "yaw_rate_sigma", yawRateSigma);
    readFields(fn, "wall_direction", wallDirection, "wall_direction_sigma", wallDirectionSigma);
}

}} // namespace cv::rsackermann
