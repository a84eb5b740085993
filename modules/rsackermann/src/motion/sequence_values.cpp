// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "sequence_values.hpp"

namespace cv { namespace rsackermann {

Model toModel(const SequenceVector& value, double unit, Matx<double, PARAMETERS, SEQUENCE_VALUES>* jacobian)
{
    const double length = value[SEQUENCE_SPEED] * unit, c = std::cos(value[SEQUENCE_DIRECTION]),
                 s = std::sin(value[SEQUENCE_DIRECTION]);
    const double left = std::max(value[SEQUENCE_LEFT], 0.), right = std::max(value[SEQUENCE_RIGHT], 0.), hardly = 1e-3;
    const bool hasLeft = left > hardly * right, hasRight = right > 0;
    // A right wall alone has the equation of a left one with the other sign.
    const double wall = hasLeft ? left : -right, sign = hasLeft ? 1 : -1;
    Model m;
    m[P_ALPHA] = value[SEQUENCE_YAW_RATE] * unit / 2;
    m[P_B] = length * wall * c;
    m[P_D] = length * wall * s;
    m[P_LAMBDA] = hasLeft && hasRight ? right / left : 0;
    m[P_ROLL] = value[SEQUENCE_ROLL];
    m[P_PITCH] = value[SEQUENCE_PITCH];
    m.direction = length < 0 ? -1 : 1;
    if (!jacobian)
        return m;
    Matx<double, PARAMETERS, SEQUENCE_VALUES>& J = *jacobian;
    J = Matx<double, PARAMETERS, SEQUENCE_VALUES>();
    const int which = hasLeft ? SEQUENCE_LEFT : SEQUENCE_RIGHT;
    J(P_ALPHA, SEQUENCE_YAW_RATE) = unit / 2;
    J(P_B, SEQUENCE_SPEED) = unit * wall * c;
    J(P_B, SEQUENCE_DIRECTION) = -length * wall * s;
    J(P_B, which) = sign * length * c;
    J(P_D, SEQUENCE_SPEED) = unit * wall * s;
    J(P_D, SEQUENCE_DIRECTION) = length * wall * c;
    J(P_D, which) = sign * length * s;
    if (m[P_LAMBDA] > 0)
    {
        J(P_LAMBDA, SEQUENCE_LEFT) = -right / (left * left);
        J(P_LAMBDA, SEQUENCE_RIGHT) = 1 / left;
    }
    J(P_ROLL, SEQUENCE_ROLL) = J(P_PITCH, SEQUENCE_PITCH) = 1;
    return m;
}

}} // namespace cv::rsackermann
