// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_SEQUENCE_STATE_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_SEQUENCE_STATE_HPP

#include "opencv2/rsackermann/estimator.hpp"
#include "../motion/sequence_values.hpp"

namespace cv { namespace rsackermann {

//! Seconds after which a value is forgotten: each wanders about its stationary mean (an Ornstein-Uhlenbeck process).
extern const double MEMORY[SEQUENCE_VALUES];

//! What of a camera may be otherwise than given.
enum CameraValue {
    CAMERA_READOUT, //!< over the given one
    CAMERA_HEADING, //!< beyond the given one, radians
    CAMERA_LEVER,   //!< ahead of the axle that moves straight ahead, metres
    CAMERA_VALUES
};

//! Metres. A camera ahead of the rear axle moves aside in bends; tyres that slip make up for it, the faster the more.
const double LEVER_SIGMA = 1;

typedef Vec<double, CAMERA_VALUES> CameraVector;
typedef Matx<double, CAMERA_VALUES, CAMERA_VALUES> CameraMatrix;

/** The motion of the car and the scene with a covariance (doc/theory.md, "Sequence").

A wall that isn't there is infinitely far away: walls come, go and change sides without a change of the unknowns.
*/
struct SequenceState
{
    SequenceVector value;
    SequenceMatrix covariance;
    //! Derivatives by what the frames so far were explained with.
    Matx<double, SEQUENCE_VALUES, CAMERA_VALUES> byCamera;

    //! The stationary state, before anything is seen.
    SequenceState(const RollingShutterCamera& camera, const AckermannEstimator::Params& params);

    //! The state some seconds later.
    void predict(double seconds);

    //! A measurement of one value; ignored unless sigma is positive.
    void measure(SequenceValue which, double measured, double sigma);

    //! Measurements of what is known from elsewhere.
    void measure(const MotionPrior& prior);

    //! Multiplies the deviation of a value by a factor.
    void scale(SequenceValue which, double factor);

    //! With another stationary state: the first values stay as they are.
    void change(const RollingShutterCamera& camera, const AckermannEstimator::Params& params, int kept);

    /** A value as the frames show it, without what is expected of all cars.
    Stays as it is if they don't. */
    void seen(SequenceValue which, double& mean, double& sigma) const;

    //! The same frames, seen by another camera. @param difference of its values.
    void change(const CameraVector& difference);

    //! With the uncertainty of the camera's values.
    SequenceState marginal(const CameraMatrix& ofCamera) const;

    //! Whether it rules out a camera at rest: by the yaw rate, the speed, or what the scene shows of it at any of its
    //! distances.
    bool excludesRest() const;

    //! As a motion during one image, with its covariance; the status and the counts of segments are left as they are.
    void toMotion(double unit, AckermannMotion& motion) const;

private:
    SequenceVector stationary, stationarySigma;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_SEQUENCE_STATE_HPP
