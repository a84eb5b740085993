// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../single/inliers_and_scale.hpp"
#include "../factors/driving_prior.hpp"
#include "sequence_state.hpp"

namespace cv { namespace rsackermann {

// Seconds after which a value is forgotten, for each DriveValue: each wanders about its usual value (an
// Ornstein-Uhlenbeck process).
static const double MEMORY[DRIVE_VALUES] = {2, 10, 1, 1, 1, 1, 10, 10};
static const double KNOWN = 1e-6; // radians, for the standard deviation of a gravity that is exact

DriveState::DriveState(const RollingShutterCamera& camera, const AckermannEstimator::Params& params)
{
    const double height = camera.height > 0 ? camera.height : params.priorHeight,
                 heightSigma = camera.height > 0 ? 0.15 : params.priorHeightLogSigma;
    const bool isExact = !(params.gravitySigma > 0);
    const double pitchSigma = isExact || !(params.vehiclePitchSigma > 0) ? KNOWN : params.vehiclePitchSigma;
    usual = DriveVector(0, 8, camera.heading, 0.1, 0.1, 1 / height, 0, 0);
    // Over seconds yaw rates stay what they are, and bends of three times the usual ones are no exception.
    usualSigma = DriveVector(3 * params.priorYawRate, 10, 0.4, 0.1, 0.1, heightSigma / height,
                             isExact ? KNOWN : params.gravitySigma, pitchSigma);
    value = usual;
    covariance = DriveMatrix::diag(usualSigma.mul(usualSigma));
}

void DriveState::predict(double seconds)
{
    DriveVector kept;
    for (int i = 0; i < DRIVE_VALUES; i++)
        kept[i] = std::exp(-seconds / MEMORY[i]);
    value = usual + kept.mul(value - usual);
    covariance = covariance.mul(kept * kept.t());
    for (int i = 0; i < DRIVE_VALUES; i++)
        covariance(i, i) += (1 - kept[i] * kept[i]) * usualSigma[i] * usualSigma[i];
}

void DriveState::measure(DriveValue which, double measured, double sigma)
{
    if (!(sigma > 0))
        return;
    const DriveVector column(covariance.col(which).val);
    const DriveVector gain = column * (1 / (covariance(which, which) + sigma * sigma));
    value += gain * (measured - value[which]);
    covariance -= gain * column.t();
}

void DriveState::measure(const MotionPrior& prior)
{
    measure(DRIVE_YAW_RATE, prior.yawRate, prior.yawRateSigma);
    measure(DRIVE_SPEED, prior.speed, prior.speedSigma);
    measure(DRIVE_DIRECTION, prior.wallDirection, prior.wallDirectionSigma);
}

void DriveState::toMotion(double unit, AckermannMotion& motion) const
{
    Matx<double, PARAMETERS, DRIVE_VALUES> J;
    const Model m = toModel(value, unit, &J);
    motion.alpha = m[P_ALPHA];
    motion.wallSlope = m[P_B];
    motion.wallOffset = m[P_D];
    motion.wallRatio = m[P_LAMBDA];
    motion.roadSlope = value[DRIVE_SPEED] * unit * value[DRIVE_ROAD];
    motion.direction = m.direction;
    motion.rollCorrection = m[P_ROLL];
    motion.pitchCorrection = m[P_PITCH];
    const Matx<double, PARAMETERS, PARAMETERS> C = J * covariance * J.t();
    motion.covariance = C.get_minor<4, 4>(P_ALPHA, P_ALPHA);
    motion.rollYawAmbiguous = isRollYawAmbiguous(C);
}

}} // namespace cv::rsackermann
