// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "drive_estimator.hpp"

namespace cv {
namespace rsackermann {

void DriveEstimator::reset()
{
    tracker.reset();
    state = DriveState(camera);
    hasFrame = false;
    isFirst = true;
}

bool DriveEstimator::estimate(const Mat& gray, int scale, double seconds, const MotionPrior& prior, AckermannMotion& motion)
{
    const double longest = 1, least = 20;
    const double passed = seconds - time;
    const bool follows = hasFrame && passed != 0 && std::abs(passed) < longest;
    if (!follows)
        reset();
    tracker.track(gray, scale, pairs);
    time = seconds;
    hasFrame = true;
    if (follows)
        state.predict(camera, std::abs(passed));
    state.measure(DRIVE_YAW_RATE, prior.yawRate, prior.yawRateSigma);
    state.measure(DRIVE_SPEED, prior.speed, prior.speedSigma);
    if (!follows || pairs.size() < least)
        return false;
    const FlowFit fit = fitFlow(camera, pairs, passed, state, isFirst);
    isFirst = false;
    if (fit.explained < 0.3)
        return false;
    state = fit.state;
    state.toMotion(camera, motion);
    motion.expectedRaw = fit.expectedRaw;
    motion.expectedLeft = std::min(fit.expectedLeft, fit.expectedRaw);
    motion.status = fit.expectedLeft < fit.expectedRaw ? MOTION_OK : MOTION_NOT_SIGNIFICANT;
    motion.model = MODEL_4LA;
    return true;
}

}} // namespace cv::rsackermann
