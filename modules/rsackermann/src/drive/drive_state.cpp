// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "drive_state.hpp"

namespace cv {
namespace rsackermann {

namespace {

// Each value wanders about what is usual, and forgets where it was (an Ornstein-Uhlenbeck process).
struct Usual
{
    double mean, sigma, memory; // seconds
};

void usualValues(const RollingShutterCamera& camera, Usual usual[DRIVE_VALUES])
{
    const double height = camera.height > 0 ? camera.height : 1.3, heightSigma = camera.height > 0 ? 0.15 : 0.35;
    const Usual values[DRIVE_VALUES] = {
        {0, 15 * CV_PI / 180, 2},          // yaw rate
        {8, 10, 10},                       // speed
        {camera.heading, 0.4, 1},          // direction
        {0.1, 0.1, 1},                     // left
        {0.1, 0.1, 1},                     // right
        {1 / height, heightSigma / height, 1} // road
    };
    std::copy(values, values + DRIVE_VALUES, usual);
}

} // namespace

DriveState::DriveState(const RollingShutterCamera& camera)
{
    Usual usual[DRIVE_VALUES];
    usualValues(camera, usual);
    for (int i = 0; i < DRIVE_VALUES; i++)
    {
        value[i] = usual[i].mean;
        covariance(i, i) = usual[i].sigma * usual[i].sigma;
    }
}

void DriveState::predict(const RollingShutterCamera& camera, double seconds)
{
    Usual usual[DRIVE_VALUES];
    usualValues(camera, usual);
    double kept[DRIVE_VALUES];
    for (int i = 0; i < DRIVE_VALUES; i++)
    {
        kept[i] = std::exp(-seconds / usual[i].memory);
        value[i] = usual[i].mean + kept[i] * (value[i] - usual[i].mean);
    }
    for (int i = 0; i < DRIVE_VALUES; i++)
    {
        for (int j = 0; j < DRIVE_VALUES; j++)
            covariance(i, j) *= kept[i] * kept[j];
        covariance(i, i) += (1 - kept[i] * kept[i]) * usual[i].sigma * usual[i].sigma;
    }
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

void DriveState::toMotion(const RollingShutterCamera& camera, AckermannMotion& motion) const
{
    const double unit = camera.secondsPerUnitTime(), length = value[DRIVE_SPEED] * unit;
    const double c = std::cos(value[DRIVE_DIRECTION]), s = std::sin(value[DRIVE_DIRECTION]);
    const double left = std::max(value[DRIVE_LEFT], 0.), right = std::max(value[DRIVE_RIGHT], 0.), hardly = 1e-3;
    const bool hasLeft = left > hardly * right, hasRight = right > 0;
    // A right wall alone has the equation of a left one with the other sign.
    const double wall = hasLeft ? left : -right, sign = hasLeft ? 1 : -1;
    motion.alpha = value[DRIVE_YAW_RATE] * unit / 2;
    motion.wallSlope = length * wall * c;
    motion.wallOffset = length * wall * s;
    motion.wallRatio = hasLeft && hasRight ? right / left : 0;
    motion.roadSlope = length * value[DRIVE_ROAD];
    motion.direction = length < 0 ? -1 : 1;

    Matx<double, 4, DRIVE_VALUES> J;
    const int which = hasLeft ? DRIVE_LEFT : DRIVE_RIGHT;
    J(0, DRIVE_YAW_RATE) = unit / 2;
    J(1, DRIVE_SPEED) = unit * wall * c;
    J(1, DRIVE_DIRECTION) = -length * wall * s;
    J(1, which) = sign * length * c;
    J(2, DRIVE_SPEED) = unit * wall * s;
    J(2, DRIVE_DIRECTION) = length * wall * c;
    J(2, which) = sign * length * s;
    if (motion.wallRatio > 0)
    {
        J(3, DRIVE_LEFT) = -right / (left * left);
        J(3, DRIVE_RIGHT) = 1 / left;
    }
    motion.covariance = J * covariance * J.t();
}

}} // namespace cv::rsackermann
