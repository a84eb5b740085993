// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_STATE_HPP
#define OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_STATE_HPP

#include "opencv2/rsackermann/estimator.hpp"
#include "../estimator/model.hpp"

namespace cv { namespace rsackermann {

//! The state of a drive, from one frame to the next. Lengths are metres if the camera's height is told, and near to
//! that if not.
enum DriveValue {
    DRIVE_YAW_RATE,  //!< rad/s
    DRIVE_SPEED,     //!< m/s, negative in reverse
    DRIVE_DIRECTION, //!< azimuth along the walls in the upright frame, radians
    DRIVE_LEFT,      //!< inverse distance of the left wall, 1/m; 0: none
    DRIVE_RIGHT,     //!< the same of the right wall
    DRIVE_ROAD,      //!< inverse height of the camera above the road, 1/m
    DRIVE_ROLL,      //!< corrections of gravity, radians
    DRIVE_PITCH,
    DRIVE_VALUES
};

typedef Vec<double, DRIVE_VALUES> DriveVector;
typedef Matx<double, DRIVE_VALUES, DRIVE_VALUES> DriveMatrix;

/** The motion during one image in units of row time.
@param unit seconds per unit of row time.
@param jacobian receives, unless it is null, the derivatives by the values. */
Model toModel(const DriveVector& value, double unit, Matx<double, PARAMETERS, DRIVE_VALUES>* jacobian);

/** The motion of the car and the scene with a covariance (doc/theory.md, "Drive").

A wall that isn't there is infinitely far away: walls come, go and change sides without a change of the unknowns.
*/
struct DriveState
{
    DriveVector value;
    DriveMatrix covariance;

    //! The usual state, before anything is seen.
    DriveState(const RollingShutterCamera& camera, const AckermannEstimator::Params& params);

    //! The state some seconds later.
    void predict(double seconds);

    //! A measurement of one value; ignored unless sigma is positive.
    void measure(DriveValue which, double measured, double sigma);

    //! As a motion during one image, with its covariance; the status and the counts of segments are left as they are.
    void toMotion(double unit, AckermannMotion& motion) const;

private:
    DriveVector usual, usualSigma;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_STATE_HPP
