// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_STATE_HPP
#define OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_STATE_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace cv {
namespace rsackermann {

//! What a drive is described by, from one frame to the next. Lengths are metres if the camera's height is told, and near to that if not.
enum DriveValue
{
    DRIVE_YAW_RATE,  //!< rad/s
    DRIVE_SPEED,     //!< m/s, negative in reverse
    DRIVE_DIRECTION, //!< azimuth along the walls in the upright frame, radians
    DRIVE_LEFT,      //!< inverse distance of the left wall, 1/m; 0: none
    DRIVE_RIGHT,     //!< the same of the right wall
    DRIVE_ROAD,      //!< inverse height of the camera above the road, 1/m
    DRIVE_VALUES
};

typedef Vec<double, DRIVE_VALUES> DriveVector;
typedef Matx<double, DRIVE_VALUES, DRIVE_VALUES> DriveMatrix;

/** The motion of the car and the scene with a covariance (doc/theory.md, "Drive").

A wall that isn't there is infinitely far away: walls come, go and change sides without a change of the unknowns.
*/
struct DriveState
{
    DriveVector value;
    DriveMatrix covariance;

    //! What is usual before anything is seen.
    explicit DriveState(const RollingShutterCamera& camera);

    //! What becomes of it after some seconds.
    void predict(const RollingShutterCamera& camera, double seconds);

    //! A measurement of one value; ignored unless sigma is positive.
    void measure(DriveValue which, double measured, double sigma);

    //! As a motion during one image, with its covariance; status and what segments say are left as they are.
    void toMotion(const RollingShutterCamera& camera, AckermannMotion& motion) const;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_STATE_HPP
