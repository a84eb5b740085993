// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../estimator/account.hpp"
#include "../estimator/residuals/usual_drive.hpp"
#include "drive_state.hpp"

namespace cv { namespace rsackermann {

// Seconds after which a value is forgotten, for each DriveValue: each wanders about its usual value (an
// Ornstein-Uhlenbeck process).
static const double MEMORY[DRIVE_VALUES] = {2, 10, 1, 1, 1, 1, 10, 10};
static const double KNOWN = 1e-6; // radians, for the standard deviation of a gravity that is exact

Model toModel(const DriveVector& value, double unit, Matx<double, PARAMETERS, DRIVE_VALUES>* jacobian)
{
    const double length = value[DRIVE_SPEED] * unit, c = std::cos(value[DRIVE_DIRECTION]),
                 s = std::sin(value[DRIVE_DIRECTION]);
    const double left = std::max(value[DRIVE_LEFT], 0.), right = std::max(value[DRIVE_RIGHT], 0.), hardly = 1e-3;
    const bool hasLeft = left > hardly * right, hasRight = right > 0;
    // A right wall alone has the equation of a left one with the other sign.
    const double wall = hasLeft ? left : -right, sign = hasLeft ? 1 : -1;
    Model m;
    m[P_ALPHA] = value[DRIVE_YAW_RATE] * unit / 2;
    m[P_B] = length * wall * c;
    m[P_D] = length * wall * s;
    m[P_LAMBDA] = hasLeft && hasRight ? right / left : 0;
    m[P_ROLL] = value[DRIVE_ROLL];
    m[P_PITCH] = value[DRIVE_PITCH];
    m.direction = length < 0 ? -1 : 1;
    if (!jacobian)
        return m;
    Matx<double, PARAMETERS, DRIVE_VALUES>& J = *jacobian;
    J = Matx<double, PARAMETERS, DRIVE_VALUES>();
    const int which = hasLeft ? DRIVE_LEFT : DRIVE_RIGHT;
    J(P_ALPHA, DRIVE_YAW_RATE) = unit / 2;
    J(P_B, DRIVE_SPEED) = unit * wall * c;
    J(P_B, DRIVE_DIRECTION) = -length * wall * s;
    J(P_B, which) = sign * length * c;
    J(P_D, DRIVE_SPEED) = unit * wall * s;
    J(P_D, DRIVE_DIRECTION) = length * wall * c;
    J(P_D, which) = sign * length * s;
    if (m[P_LAMBDA] > 0)
    {
        J(P_LAMBDA, DRIVE_LEFT) = -right / (left * left);
        J(P_LAMBDA, DRIVE_RIGHT) = 1 / left;
    }
    J(P_ROLL, DRIVE_ROLL) = J(P_PITCH, DRIVE_PITCH) = 1;
    return m;
}

DriveState::DriveState(const RollingShutterCamera& camera, const AckermannEstimator::Params& params)
{
    const double height = camera.height > 0 ? camera.height : USUAL_HEIGHT,
                 heightSigma = camera.height > 0 ? 0.15 : LOG_HEIGHT_SIGMA;
    const bool isExact = !(params.gravitySigma > 0);
    const double pitchSigma = isExact || !(params.vehiclePitchSigma > 0) ? KNOWN : params.vehiclePitchSigma;
    usual = DriveVector(0, 8, camera.heading, 0.1, 0.1, 1 / height, 0, 0);
    // Over seconds yaw rates stay what they are, and bends of three times the usual ones are no exception.
    usualSigma = DriveVector(3 * params.usualYawRate, 10, 0.4, 0.1, 0.1, heightSigma / height,
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
