// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_MOTION_SEQUENCE_VALUES_HPP
#define OPENCV_RSACKERMANN_SRC_MOTION_SEQUENCE_VALUES_HPP

#include "../camera/axis_rotations.hpp"
#include "model.hpp"

namespace cv { namespace rsackermann {

//! The state of a sequence, from one frame to the next. Lengths are metres if the camera's height is given, and near to
//! that if not.
enum SequenceValue {
    SEQUENCE_YAW_RATE,  //!< rad/s
    SEQUENCE_SPEED,     //!< m/s, negative in reverse
    SEQUENCE_DIRECTION, //!< azimuth along the walls in the upright frame, radians
    SEQUENCE_LEFT,      //!< inverse distance of the left wall, 1/m; 0: none
    SEQUENCE_RIGHT,     //!< the same of the right wall
    SEQUENCE_ROAD,      //!< inverse height of the camera above the road, 1/m
    SEQUENCE_ROLL,      //!< corrections of gravity, radians
    SEQUENCE_PITCH,
    SEQUENCE_VALUES
};

/** The state of a sequence, and the differences of other frames from the present one: turns about the other axes from
the frame before and to the frame after, and the change of the yaw rate. */
enum {
    FLOW_PITCH_BEFORE = SEQUENCE_VALUES,
    FLOW_ROLL_BEFORE,
    FLOW_PITCH_AFTER,
    FLOW_ROLL_AFTER,
    FLOW_YAW_CHANGE, //!< rad/s^2
    FLOW_VALUES
};

typedef Vec<double, SEQUENCE_VALUES> SequenceVector;
typedef Matx<double, SEQUENCE_VALUES, SEQUENCE_VALUES> SequenceMatrix;

//! Of a way, 1/m, up to that of the tightest turn; positive to the right.
inline double curvatureOf(double yawRate, double speed)
{
    const double tightest = 0.2, curvature = speed != 0 ? yawRate / speed : 0;
    return std::min(std::max(curvature, -tightest), tightest);
}

//! Upright frame of the camera to that of a state, whose gravity is corrected.
inline Matx33d tiltOf(const double* values)
{
    return tiltRotation(values[SEQUENCE_ROLL], values[SEQUENCE_PITCH]);
}

/** The motion during one image in units of row time.
@param unit seconds per unit of row time.
@param jacobian receives, unless it is null, the derivatives by the values. */
Model toModel(const SequenceVector& value, double unit, Matx<double, PARAMETERS, SEQUENCE_VALUES>* jacobian);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_MOTION_SEQUENCE_VALUES_HPP
