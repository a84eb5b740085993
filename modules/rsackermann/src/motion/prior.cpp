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

// The limits are far beyond what any car does or any estimate returns. Within them nothing overflows that is computed from the motion.
static void checkPrevious(const AckermannMotion& m)
{
    const double maxAlpha = 10, maxWall = 100, maxRoad = 1e6, maxRatio = 1e6;
    checkRange(m.alpha, -maxAlpha, maxAlpha, "prior.previous.alpha");
    checkRange(m.wallSlope, -maxWall, maxWall, "prior.previous.wallSlope");
    checkRange(m.wallOffset, -maxWall, maxWall, "prior.previous.wallOffset");
    checkRange(m.wallRatio, 0, maxRatio, "prior.previous.wallRatio");
    checkRange(m.roadSlope, -maxRoad, maxRoad, "prior.previous.roadSlope");
    checkRange(m.rollCorrection, -CV_PI, CV_PI, "prior.previous.rollCorrection");
    checkRange(m.pitchCorrection, -CV_PI, CV_PI, "prior.previous.pitchCorrection");
    checkNotNegative(m.wallDistance, "prior.previous.wallDistance", "unknown");
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            checkFinite(m.covariance(i, j), format("prior.previous.covariance(%d, %d)", i, j).c_str());
    checkFinite(m.rms, "prior.previous.rms");
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
    checkPrevious(previous);
}

void MotionPrior::write(FileStorage& fs) const
{
    fs << "speed" << speed << "speed_sigma" << speedSigma << "yaw_rate" << yawRate << "yaw_rate_sigma" << yawRateSigma;
    fs << "wall_direction" << wallDirection << "wall_direction_sigma" << wallDirectionSigma;
    fs << "previous" << "{";
    previous.write(fs);
    fs << "}" << "previous_noise" << previousNoise;
}

void MotionPrior::read(const FileNode& fn)
{
    cv::read(fn["speed"], speed, speed);
    cv::read(fn["speed_sigma"], speedSigma, speedSigma);
    cv::read(fn["yaw_rate"], yawRate, yawRate);
    cv::read(fn["yaw_rate_sigma"], yawRateSigma, yawRateSigma);
    cv::read(fn["wall_direction"], wallDirection, wallDirection);
    cv::read(fn["wall_direction_sigma"], wallDirectionSigma, wallDirectionSigma);
    previous.read(fn["previous"]);
    cv::read(fn["previous_noise"], previousNoise, previousNoise);
}

void MotionPrior::setPrevious(const AckermannMotion& motion)
{
    previous = motion;
}

AckermannMotion MotionPrior::getPrevious() const
{
    return previous;
}

}} // namespace cv::rsackermann
