// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "image_with_gyro.hpp"
#include "../motion/contradiction.hpp"
#include "expected_displacement.hpp"

namespace cv { namespace rsackermann {

AckermannMotion estimateWithGyro(const AckermannEstimator& single, const RollingShutterCamera& camera,
                                 const MeasuredTurns& turns, const Mat& segments, MotionPrior& prior, Mat& labels)
{
    const MotionPrior given = prior;
    const InstantRate& yaw = turns.yaw;
    if (prior.yawRateSigma > 0)
    {
        const double own = 1 / (yaw.sigma * yaw.sigma), other = 1 / (prior.yawRateSigma * prior.yawRateSigma);
        prior.yawRate = (own * yaw.value + other * prior.yawRate) / (own + other);
        prior.yawRateSigma = 1 / std::sqrt(own + other);
    }
    else
    {
        prior.yawRate = yaw.value;
        prior.yawRateSigma = yaw.sigma;
    }
    AckermannMotion motion = single.estimate(segments, labels, prior);
    compareAgain(prior, given, motion);
    if (contradicts(yaw.value, yaw.sigma, given.yawRate, given.yawRateSigma)) // whatever the image shows
    {
        motion.seenYawRate = yaw.value;
        motion.seenYawRateSigma = yaw.sigma;
        motion.contradictsPrior = true;
    }
    if (motion.status == MOTION_OK)
    {
        RowRates turning;
        turning.set(turns);
        turning.toMotion(camera, motion);
        expectRowTurns(DisplacementField(camera), camera, motion);
    }
    return motion;
}

void turnByGyro(const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
                const MeasuredTurns& turns, const MotionPrior& prior, AckermannMotion& motion)
{
    const double unit = camera.secondsPerUnitTime();
    AckermannMotion turned;
    turned.candidates = motion.candidates;
    turned.covariance = Matx44d::zeros();
    RowRates turning;
    turning.set(turns);
    turning.toMotion(camera, turned);
    turned.alpha = turns.yaw.value * unit / 2;
    turned.covariance(0, 0) = std::pow(turns.yaw.sigma * unit / 2, 2);
    SequenceState state(camera, params);
    state.measure(prior);
    turning.toInstant(prior, state);
    expectDisplacement(DisplacementField(camera), camera, state, true, 0, turned);
    if (!(turned.expectedResidual < turned.expectedRaw))
        return;
    motion = turned;
    motion.status = MOTION_OK;
    motion.model = MODEL_1LA;
}

}} // namespace cv::rsackermann
