// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_MOTION_HPP
#define OPENCV_RSACKERMANN_MOTION_HPP

#include "opencv2/rsackermann/camera.hpp"

namespace cv { namespace rsackermann {

//! @addtogroup rsackermann
//! @{

//! The outcome of an estimate. Only with MOTION_OK is the image changed beyond the lens correction.
enum MotionStatus {
    MOTION_OK = 0, //!< a significant motion was found
    //! No motion explains the segments so much better than a camera at rest that its correction is expected to help
    MOTION_NOT_SIGNIFICANT = 1,
    MOTION_TOO_FEW_SEGMENTS = 2, //!< there are too few vertical segments
    MOTION_NO_CONSENSUS = 3,     //!< no motion within the limits agrees with enough segments
    MOTION_NOT_OBSERVABLE = 4    //!< the shutter goes along the columns
};

//! The motion models, named by the number of line segments (lines, "L") that determine them.
enum MotionModel {
    //! For AckermannEstimator::Params::model: average over all possible motions
    MODEL_AUTO = -1,
    MODEL_NONE = 0, //!< camera at rest
    MODEL_1LA = 1,  //!< pure rotation: yaw rate
    MODEL_3LA = 3,  //!< pure translation: speed and walls
    MODEL_4LA = 4   //!< yaw rate, speed and walls
};

//! The source of a motion's metres.
enum MotionScale {
    SCALE_UNKNOWN = 0, //!< there are none: the road is where the prior expects it
    SCALE_WALL = 1,    //!< AckermannEstimator::Params::wallDistance
    SCALE_ROAD = 2,    //!< RollingShutterCamera::height, and walls that visibly stand on the road
    SCALE_SPEED = 3    //!< MotionPrior::speed
};

//! Motion and walls in metric values, see AckermannMotion::fromMetric.
class CV_EXPORTS_W_SIMPLE MetricMotion
{
public:
    CV_WRAP MetricMotion();      //!< a camera at rest, without walls
    CV_PROP_RW double yawRate;   //!< radians per second, positive if the car turns to the right
    CV_PROP_RW double pitchRate; //!< radians per second, positive if the camera looks further down
    CV_PROP_RW double rollRate;  //!< radians per second, positive if it turns clockwise as seen from behind
    CV_PROP_RW double speed;     //!< metres per second, negative in reverse
    //! Metres from the camera to the wall on the left of wallDirection; 0: no left wall
    CV_PROP_RW double leftDistance;
    CV_PROP_RW double rightDistance; //!< the same on the right
    //! Radians from the horizontal optical axis to the direction along the walls, positive to the right; a street that
    //! the car follows has the heading
    CV_PROP_RW double wallDirection;
};

/** @brief The motion of the car during one image and the coarse depth of the scene.

The scaled inverse depth \f$w = \beta / s\f$ of the scene is linear on each plane at the global-shutter point
\f$(x, y)\f$ of the upright frame: left (or only) wall \f$D - B x\f$, right wall \f$\lambda (B x - D)\f$, road \f$G y\f$
with the slope B (wallSlope) and the offset D (wallOffset) of the left wall, the ratio \f$\lambda\f$ (wallRatio) and the
slope G (roadSlope). The nearest plane is seen; if the motion has an inverse-depth offset, it is added. A scene with
only one wall has \f$\lambda = 0\f$; there the wall may be on either side and B may have either sign.

The methods take the values as they are, whatever the status, unless stated otherwise.

Const methods may run at the same time in several threads on the same object; changes need an object that no other
thread uses meanwhile.
 */
class CV_EXPORTS_W_SIMPLE AckermannMotion
{
public:
    //! A camera at rest, with status #MOTION_NOT_SIGNIFICANT.
    CV_WRAP AckermannMotion();

    /** @brief A motion made from metric values, for simulation and for callers that know all of them.
    @param camera camera with lineDelay and, for the road, height.
    @param metric motion and walls. A speed needs a wall or the height, which give its unit of length: any will do where
    only points with depths are moved.
    @return the motion, of status #MOTION_OK unless it is that of a camera at rest; throws cv::Exception if a value is
    out of range or missing.
     */
    CV_WRAP static AckermannMotion fromMetric(const RollingShutterCamera& camera, const MetricMotion& metric);

    //! Column of the vanishing point of the walls in the upright frame, wallOffset / wallSlope; 0 if the walls are
    //! parallel to the image.
    CV_WRAP double delta() const;

    /** @brief Yaw rate, 2 alpha / secondsPerUnitTime, in radians per second; positive to the right.
    @param camera the camera with which the motion was estimated.
    @param radiansPerSecond receives the yaw rate; 0 if it is unknown.
    @return false if lineDelay is unknown, or if the motion is, at a #status other than #MOTION_OK and
    #MOTION_NOT_SIGNIFICANT. With the latter the yaw rate is 0: that of a camera at rest.
     */
    CV_WRAP bool yawRate(const RollingShutterCamera& camera, CV_OUT double& radiansPerSecond) const;

    /** @brief Speed, \f$\pm\sqrt{B^2+D^2} \cdot wallDistance\f$ / secondsPerUnitTime, or, without a wall, by #roadSlope
    and RollingShutterCamera::height, in metres per second; negative in reverse.
    @param camera the camera with which the motion was estimated.
    @param metresPerSecond receives the speed; 0 if it is unknown.
    @return false if lineDelay is unknown, or both wallDistance and, with #scale, the height. The estimator sets
    wallDistance with #MOTION_OK alone; #scale is its source. With #SCALE_SPEED the result of a single image is the
    given speed, no measurement; that of a sequence is what it and the frames say together, by their standard
    deviations.
     */
    CV_WRAP bool speed(const RollingShutterCamera& camera, CV_OUT double& metresPerSecond) const;

    /** @brief Pose of the camera at a row time, relative to the pose at the reference row.

    It turns by yaw, then roll, then pitch, each proportional to the row time, and then by #rotationCurve, in the frame
    of #uprightRotation.
    @param camera the camera.
    @param time row time, see RollingShutterCamera::rowTime.
    @param R rotation from the camera frame at that time to the camera frame at the reference row.
    @param T position of the camera at that time in the camera frame at the reference row, in the unit of length in
    which the horizontal depth of a point with scaled inverse depth w is 1/|w|; 0 if the motion is a pure rotation. In
    metres, on the same conditions as speed(), with the factor \f$|speed| \cdot secondsPerUnitTime\f$.
     */
    CV_WRAP void pose(const RollingShutterCamera& camera, double time, CV_OUT Matx33d& R, CV_OUT Vec3d& T) const;

    /** @brief Covariance of the metric values yaw rate (rad/s), speed (m/s), delta and wallRatio, in this order.

    It includes the uncertainty of gravity. Rows and columns of values that are unknown, see yawRate() and speed(), or
    not part of the model are 0.
    @param camera the camera with which the motion was estimated.
    @return the symmetric matrix.
     */
    CV_WRAP Matx44d metricCovariance(const RollingShutterCamera& camera) const;

    //! The camera's upright rotation with this motion's corrections of roll and pitch.
    CV_WRAP Matx33d uprightRotation(const RollingShutterCamera& camera) const;

    //! The camera's heading with this motion's correction.
    CV_WRAP double heading(const RollingShutterCamera& camera) const;

    //! Writes all fields into the present node, a map.
    void write(FileStorage& fs) const;
    //! The same for wrapped languages, in which a FileStorage is a pointer.
    CV_WRAP void write(const Ptr<FileStorage>& fs) const
    {
        CV_Assert(fs);
        write(*fs);
    }
    //! Reads the fields that write() has written; the others keep their values.
    CV_WRAP void read(const FileNode& fn);

    CV_PROP_RW int status; //!< one of #MotionStatus
    CV_PROP_RW int model;  //!< one of #MotionModel

    CV_PROP_RW double alpha; //!< half of the yaw per unit of row time
    //! Slope of the left (or only) wall's scaled inverse depth; beta in the gauge of the paper
    CV_PROP_RW double wallSlope;
    CV_PROP_RW double wallOffset; //!< left (or only) wall's scaled inverse depth at x = 0
    CV_PROP_RW double wallRatio;  //!< ratio of the wall distances left / right; 0: one wall
    CV_PROP_RW double roadSlope;  //!< slope of the road's scaled inverse depth; 0: no road
    /** By how much the scene deviates from its planes, in scaled inverse depth, which has the sign of #direction:
    control values CV_64FC1, from 4 x 4 to 1024 x 1024, rows downward and columns to the right, of a uniform cubic
    B-spline over #offsetArea. Empty (default): not at all. Beyond the area the nearest place of it counts.

    With as many cells as there are control values less 3 along each side, the value at (u, v) cells from the corner of
    the area is the sum of \f$c_{ij} N(v + 3 - i) N(u + 3 - j)\f$ with row i, column j and the cubic B-spline N on the
    knots 0 to 4.

    Frames of a sequence may have one, see RollingShutterCorrector::Params::sequence. Copies of a motion share the
    values, as copies of a Mat do. */
    CV_PROP_RW Mat inverseDepthOffset;
    CV_PROP_RW Rect2d offsetArea; //!< the rectangle of (x, y) in the upright frame that the offset covers
    CV_PROP_RW int direction;     //!< 1 forward, -1 reverse: the sign of all scaled inverse depths

    /** Radians per unit of row time by which the camera's pitch grows during the image (it looks further down), beside
    the yaw: a suspension that swings, a mount that shakes. Estimated for frames of a sequence, see
    RollingShutterCorrector::Params::sequence; 0 (default) otherwise */
    CV_PROP_RW double pitchRate;
    CV_PROP_RW double rollRate;       //!< the same of the roll, clockwise seen from behind
    CV_PROP_RW double pitchRateSigma; //!< standard deviation of pitchRate; 0: not estimated
    CV_PROP_RW double rollRateSigma;  //!< standard deviation of rollRate; 0: not estimated

    /** By how much rows turn beyond yaw, roll and pitch at constant rates while a camera shakes: rotation vectors in
    radians about the axes of the upright frame (right, down, forward; a turn to the right is positive about the
    second), CV_64FC1, from 2 x 3 to 1024 x 3, each of length up to pi. The rotation takes a direction that the row sees
    to one that a row would see that turns at the rates alone.

    The first one is that of the first row of the image, the last one that of the last row (columns, if the shutter goes
    along them), and the others are equally spaced between. A natural cubic spline, which is straight beyond the image,
    goes through their components. Empty (default): not at all.

    Frames with a gyro have one, see RollingShutterCorrector::addGyro, and so do those of a sequence whose points are
    seen in the frames before and after (RollingShutterCorrector::setNextFrame): rates that grow evenly. Copies of a
    motion share the values, as copies of a Mat do. */
    CV_PROP_RW Mat rotationCurve;

    CV_PROP_RW double rollCorrection;  //!< radians to add to the camera's roll
    CV_PROP_RW double pitchCorrection; //!< radians to add to the camera's pitch
    //! Radians to add to the camera's heading for the direction in which it moves. Estimated in sequences: of an exact
    //! heading (RollingShutterCamera::headingSigma) in bends alone, where a camera ahead of the axle moves aside
    CV_PROP_RW double headingCorrection;
    //! Metres to the vehicle's left wall, or to the only one that is seen; 0: unknown
    CV_PROP_RW double wallDistance;
    CV_PROP_RW int scale; //!< one of #MotionScale
    //! Standard deviation in metres per second of the speed that gives the metres (#SCALE_SPEED), or that a wall
    //! (#SCALE_WALL) or the road (#SCALE_ROAD) gives; 0 (default): wallDistance is exact
    CV_PROP_RW double speedSigma;

    //! Of (alpha, wallSlope, wallOffset, wallRatio), including the uncertainty of gravity and, in sequences, of the
    //! heading; 0 for values that aren't part of the model
    CV_PROP_RW Matx44d covariance;
    //! Whether roll and yaw rate can't be distinguished: the uncertainty of the roll decides that of the yaw rate
    CV_PROP_RW bool rollYawAmbiguous;

    /** Whether the image contradicts a given value: without it the estimate is more than three standard deviations of
    both away from it, or shows the other direction; or ends of segments are elsewhere than the road that a given
    distance of a wall (AckermannEstimator::Params::wallDistance) and the camera's height say. With a given yaw rate or
    speed (MotionPrior) the estimate of a single image goes where the value is all the same; a sequence goes on without
    what its frames so far contradict, until a frame excludes that the value errs as it did then. */
    CV_PROP_RW bool contradictsPrior;
    //! Yaw rate in radians per second that the image shows without the given one
    CV_PROP_RW double seenYawRate;
    CV_PROP_RW double seenYawRateSigma; //!< standard deviation of seenYawRate; 0: none is given, or it isn't known
    //! Speed in metres per second that the image shows without the given one; needs the distance of the wall, or a
    //! sequence, in which it is as uncertain as the camera's height
    CV_PROP_RW double seenSpeed;
    CV_PROP_RW double seenSpeedSigma; //!< standard deviation of seenSpeed; 0: none is given, or it isn't known

    /** What the slants of verticals in a sequence so far show of the read-out, over the one of the camera: 1 if that is
    right, 2 if it takes twice as long, -1 if rows are read in the other direction, 0 of a global shutter; of those that
    the interval between frames allows. Of a read-out that is wrong by more than three standard deviations a sequence
    says that it leaves the difference, so that frames stay as they are if the ratio is less than a half. 1 (default):
    not known */
    CV_PROP_RW double readoutRatio;
    CV_PROP_RW double readoutRatioSigma; //!< standard deviation of readoutRatio; 0: not known

    /** Heading in radians that the frames of a sequence so far show, whatever the given one is. A given one that is
    wrong by more than three standard deviations of both makes yaw rates wrong, and hardly changes what is corrected: a
    turn and a way aside look alike. 0 (default): not known */
    CV_PROP_RW double seenHeading;
    CV_PROP_RW double seenHeadingSigma; //!< standard deviation of seenHeading; 0: not known

    CV_PROP_RW int candidates; //!< segments that passed the gates
    CV_PROP_RW int inliers;    //!< candidates that agree with the motion
    CV_PROP_RW double rms;     //!< root mean square residual of the inliers in pixels

    //! Mean displacement in pixels that is to be expected of the raw image, where segments or tracked points show the
    //! scene; of a single image with a depth of the raw camera, all over
    CV_PROP_RW double expectedRaw;
    CV_PROP_RW double expectedResidual; //!< the same of the corrected image
    //! Probability that the corrected image is displaced more than the raw one
    CV_PROP_RW double probabilityWorse;
};

/** @brief Given values of the motion: from the car's bus, a gyro, calibration.

Each value is used if its standard deviation is positive.

Const methods may run at the same time in several threads on the same object; changes need an object that no other
thread uses meanwhile.
 */
class CV_EXPORTS_W_SIMPLE MotionPrior
{
public:
    //! Nothing is given.
    CV_WRAP MotionPrior();

    //! Throws cv::Exception with the name and value of the first field that is out of range.
    CV_WRAP void check() const;

    //! Writes all fields into the present node, a map.
    void write(FileStorage& fs) const;
    //! The same for wrapped languages, in which a FileStorage is a pointer.
    CV_WRAP void write(const Ptr<FileStorage>& fs) const
    {
        CV_Assert(fs);
        write(*fs);
    }
    //! Reads the fields that write() has written; the others keep their values.
    CV_WRAP void read(const FileNode& fn);

    //! Metres per second, negative in reverse; of no effect without RollingShutterCamera::lineDelay; helps most with
    //! AckermannEstimator::Params::wallDistance, and with RollingShutterCamera::height it gives the road. Of speed
    //! and wallDistance the one that is known better gives the metres. What is given counts in its own image alone: its
    //! error may be that of all
    CV_PROP_RW double speed;
    CV_PROP_RW double speedSigma; //!< standard deviation of speed; 0 (default): not given
    //! Radians per second, positive to the right, at the instant of RollingShutterCamera::referenceRow; of no
    //! effect without RollingShutterCamera::lineDelay
    CV_PROP_RW double yawRate;
    CV_PROP_RW double yawRateSigma; //!< standard deviation of yawRate; 0 (default): not given
    //! Azimuth of the vanishing point of the walls in the upright frame, radians; its column is the tangent
    CV_PROP_RW double wallDirection;
    CV_PROP_RW double wallDirectionSigma; //!< standard deviation of wallDirection; 0 (default): not given
};

//! @}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_MOTION_HPP
