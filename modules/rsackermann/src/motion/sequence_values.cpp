// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "sequence_values.hpp"

namespace cv { namespace rsackermann {

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

}} // namespace cv::rsackermann
