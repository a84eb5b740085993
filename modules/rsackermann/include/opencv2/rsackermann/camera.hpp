// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_CAMERA_HPP
#define OPENCV_RSACKERMANN_CAMERA_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

//! @addtogroup rsackermann
//! @{

//! The order in which the sensor reads its lines.
enum ScanDirection {
    SCAN_TOP_TO_BOTTOM = 0, //!< row 0 is read first (default)
    SCAN_BOTTOM_TO_TOP = 1, //!< the last row is read first
    SCAN_LEFT_TO_RIGHT = 2, //!< column 0 is read first; the motion is unobservable from vertical lines
    SCAN_RIGHT_TO_LEFT = 3  //!< the last column is read first; the motion is unobservable from vertical lines
};

//! The lens models of OpenCV that a RollingShutterCamera can have.
enum LensModel {
    LENS_PINHOLE = 0, //!< the model of cv::projectPoints with 0, 4, 5, 8, 12 or 14 coefficients (default)
    LENS_FISHEYE = 1  //!< the model of cv::fisheye with 4 coefficients
};

//! Seconds that a camera may take to read all of its lines; what takes longer is in another unit.
const double LONGEST_READ_OUT = 1;

//! Seconds from one image to the next, from which on they are frames of different sequences.
const double LONGEST_INTERVAL = 1;

/** @brief A rolling-shutter camera in a car: lens, shutter timing and mounting.

All fields may be set directly; check() verifies them together and is called by every algorithm that takes a camera.

Const methods may run at the same time in several threads on the same object; changes need an object that no other
thread uses meanwhile.
 */
class CV_EXPORTS_W_SIMPLE RollingShutterCamera
{
public:
    //! An empty camera (image size 0 x 0), to be filled field by field.
    CV_WRAP RollingShutterCamera();

    /** @brief A camera with known intrinsics that looks forward, upright as far as is known: #rollSigma and #pitchSigma
    are those of an unknown mount, until setRollPitch() or setGravity() is called. Doesn't call check(), as exceptions
    of constructors aren't caught in wrapped languages.
    @param size size of the image in pixels; referenceRow becomes its middle row.
    @param K 3x3 camera matrix.
    @param dist lens coefficients, as many as lensModel takes; empty: no distortion.
    @param lens one of #LensModel.
     */
    CV_WRAP RollingShutterCamera(const Size& size, const Matx33d& K,
                                 const std::vector<double>& dist = std::vector<double>(), int lens = LENS_PINHOLE);

    /** @brief The same with the lens coefficients as calibrateCamera() and fisheye::calibrate() return them.
    @param size size of the image in pixels; referenceRow becomes its middle row.
    @param K 3x3 camera matrix.
    @param dist lens coefficients, one row or column CV_32F or CV_64F; check() refuses what comes of others. It isn't
    changed: as a constant it would take braces away from the other constructor.
    @param lens one of #LensModel.
     */
    CV_WRAP RollingShutterCamera(const Size& size, const Matx33d& K, Mat& dist, int lens = LENS_PINHOLE);

    /** @brief An uncalibrated camera: principal point at the image centre, square pixels, no distortion.
    @param size size of the image in pixels.
    @param focal focal length in pixels; 0 stands for 0.9 times the longer side, as in @cite purkait2018minimal , ± 20 %
    (focalSigma), and for a lens that isn't known, either (distortionSigma 0.15).
    @return the camera, looking forward and, as far as is known, upright (#rollSigma, #pitchSigma).
     */
    CV_WRAP static RollingShutterCamera fromFocal(const Size& size, double focal = 0);

    /** @brief Sets uprightRotation from roll and pitch, which are exact then: #rollSigma and #pitchSigma become 0.
    @param roll radians, positive if the camera is turned clockwise seen from behind it.
    @param pitch radians, positive if the camera looks down.

    Gravity in the camera frame is then \f$(\sin roll, \cos roll \cos pitch, \sin pitch)\f$ up to its length.
     */
    CV_WRAP void setRollPitch(double roll, double pitch);

    /** @brief Sets uprightRotation from the direction of gravity, which is exact then: #rollSigma and #pitchSigma
    become 0.
    @param gravity direction of gravity (pointing down) in the camera frame, of any length; not parallel to the optical
    axis. That of a level camera is (0, 1, 0); an accelerometer at rest measures the opposite.
     */
    CV_WRAP void setGravity(const Vec3d& gravity);

    //! Direction of gravity in the camera frame, of length 1.
    CV_WRAP Vec3d gravity() const;

    /** @brief Row time of a raw pixel.
    @param pixel pixel of the raw image; the row (for a column-wise shutter: the column) counts.
    @return \f$(row - referenceRow) / f_y\f$, with the opposite sign for #SCAN_BOTTOM_TO_TOP and #SCAN_RIGHT_TO_LEFT.
     */
    CV_WRAP double rowTime(const Point2d& pixel) const;

    //! Seconds per unit of row time, \f$f_y \cdot lineDelay\f$; 0 if lineDelay is unknown.
    CV_WRAP double secondsPerUnitTime() const;

    //! Whether the shutter goes along the rows, so that vertical lines determine the motion.
    CV_WRAP bool isRowShutter() const;

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

    CV_PROP_RW Size imageSize;                 //!< size of the raw image in pixels, 1 to 65535 each
    CV_PROP_RW Matx33d cameraMatrix;           //!< intrinsic parameters in pixels, without skew
    CV_PROP_RW std::vector<double> distCoeffs; //!< lens coefficients; empty: none
    CV_PROP_RW int lensModel;                  //!< one of #LensModel
    CV_PROP_RW int scanDirection;              //!< one of #ScanDirection
    //! Seconds between two lines, up to #LONGEST_READ_OUT for all of them; 0: unknown, and metric values are unknown,
    //! too
    CV_PROP_RW double lineDelay;
    //! Raw row (column-wise shutter: column) at whose instant the corrected image is taken
    CV_PROP_RW double referenceRow;
    //! Turns the camera frame into the upright frame, which has the optical axis, projected to the horizontal, along
    //! +z; check() allows for 0.05 of the axis to the side
    CV_PROP_RW Matx33d uprightRotation;
    //! Standard deviation in radians of the roll with which the camera is mounted, which adds to that of the vehicle
    //! (AckermannEstimator::Params::gravitySigma) unless that is 0; 0: exact. Of a mount that isn't given 2 degrees
    CV_PROP_RW double rollSigma;
    CV_PROP_RW double pitchSigma; //!< the same for the pitch; of a mount that isn't given 5 degrees
    //! Radians from the horizontal optical axis to the vehicle's forward direction, positive to the right; -pi/2 for a
    //! camera that looks to the right; a turn to either side at most
    CV_PROP_RW double heading;
    //! Standard deviation of heading in radians, of a mount that isn't given 5 degrees; 0: exact. Sequences estimate a
    //! heading that isn't (AckermannMotion::headingCorrection); single images take it as it is
    CV_PROP_RW double headingSigma;
    CV_PROP_RW double height; //!< metres of the camera above the road; 0: unknown
    //! Standard deviation of the focal length fx in pixels, which fy shares; 0: exact
    CV_PROP_RW double focalSigma;
    //! Standard deviation of the first radial coefficient that the lens has besides distCoeffs; 0: exact. Maps don't
    //! apply it; an image that such a lens explains better than a motion is left as it is
    CV_PROP_RW double distortionSigma;
    CV_PROP_RW double lineDelaySigma; //!< standard deviation of lineDelay in seconds; 0: exact
};

//! @}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_CAMERA_HPP
