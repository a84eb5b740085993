// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_CALIBRATION_HPP
#define OPENCV_RSACKERMANN_CALIBRATION_HPP

#include "opencv2/rsackermann/estimator.hpp"

namespace cv { namespace rsackermann {

//! @addtogroup rsackermann
//! @{

/** @brief A camera's mount and line delay, self-calibrated by MountCalibrator.

Const methods may run at the same time in several threads on the same object; changes need an object that no other
thread uses meanwhile.
 */
class CV_EXPORTS_W_SIMPLE MountCalibration
{
public:
    CV_WRAP MountCalibration(); //!< of no frame

    /** @brief The horizon of the road in the image.
    @return (a, b, c) with \f$a x + b y + c = 0\f$ for pixels (x, y) of the image without lens distortion, \f$a^2 + b^2
    = 1\f$, positive below.
     */
    CV_WRAP Vec3d horizon() const;

    //! Frames of a moving car that were used; with fewer than five nothing is observable, and the camera is that of
    //! create()
    CV_PROP_RW int frames;
    //! Frames whose car clearly drives in the other direction than that of their given speed or, where none is given,
    //! backward. If they are more than half as many as frames, the camera looks to the other end of the car than its
    //! heading says
    CV_PROP_RW int contraryFrames;
    //! Frames whose given yaw rate or speed is more than three standard deviations from what they show without it
    //! through the camera of create(). If they are most of them the signs, units or times of what is given are wrong,
    //! or the heading is elsewhere
    CV_PROP_RW int contradictedFrames;
    //! Standard deviation by which the times between frames err, relative to them, as speeds show that go to and fro:
    //! of images that a conversion of the frame rate left out 0.1 and more. The relative error of the line delay may be
    //! as large, and its standard deviation has that
    CV_PROP_RW double intervalSigma;
    //! That of create() with the estimated upright rotation, heading and, if it is observable, line delay, and the
    //! standard deviation of the latter. With a gyro also with the focal length that both show, if focalSigma isn't 0
    CV_PROP_RW RollingShutterCamera camera;
    CV_PROP_RW double roll;           //!< radians, as in RollingShutterCamera::setRollPitch()
    CV_PROP_RW double rollSigma;      //!< standard deviation of roll
    CV_PROP_RW double pitch;          //!< radians, as in RollingShutterCamera::setRollPitch()
    CV_PROP_RW double pitchSigma;     //!< standard deviation of pitch
    CV_PROP_RW double heading;        //!< radians, as RollingShutterCamera::heading
    CV_PROP_RW double headingSigma;   //!< standard deviation of heading
    CV_PROP_RW double lineDelay;      //!< seconds; 0: unknown, as none was given and it is unobservable
    CV_PROP_RW double lineDelaySigma; //!< standard deviation of lineDelay

    //! Whether the roll is observable: its standard deviation is less than half of that before the calibration
    CV_PROP_RW bool rollObserved;
    CV_PROP_RW bool pitchObserved;   //!< the same of the pitch
    CV_PROP_RW bool headingObserved; //!< the same of the heading
    //! The same of the line delay, which is observable in bends and if the camera shakes, above all with a gyro; if
    //! not, as after a straight drive, it isn't changed, and the angles are those that go with it
    CV_PROP_RW bool lineDelayObserved;

    //! Frames whose rows MountCalibrator::addGyro() has turned: 0 if there is no gyro, or the points contradict it.
    //! Then the following aren't known
    CV_PROP_RW int gyroFrames;
    CV_PROP_RW double gyroDelay;      //!< seconds by which the gyro's clock is ahead of that of the frames, at the end
    CV_PROP_RW double gyroDelaySigma; //!< standard deviation of gyroDelay
    //! The true focal length over the one of create(), if the gyro's scale is right: that is within 3 % (one standard
    //! deviation)
    CV_PROP_RW double focalScale;
    CV_PROP_RW double focalScaleSigma; //!< standard deviation of focalScale
};

/** @brief Self-calibrates mounting angles and line delay from a drive.

Tracked points determine the car's motion, the images' verticals are upright, the mount stays the same while suspension
and road tilt the car, and the slants of verticals grow with the yaw rate in proportion to the line delay. All frames
are fitted together. Times of the frames are needed; speed and yaw rate of each frame (MotionPrior) are used if they
are given. A focal length that isn't exact (RollingShutterCamera::focalSigma) enters the standard deviations of all
values.

A car that leans to one side all the time, as on a road with a crown, looks like a mount that is tilted: roll is that of
the mean of the drive. A camera far ahead of the rear axle moves across the car in bends; bends to both sides keep that
from the heading. At most Params::maxFrames frames are kept, whatever the length of the drive: parts of it are omitted
evenly. An object is for one thread at a time.
 */
class CV_EXPORTS_W MountCalibrator : public Algorithm
{
public:
    /** @brief Parameters of the calibration.

    Const methods may run at the same time in several threads on the same object; changes need an object that no other
    thread uses meanwhile.
     */
    struct CV_EXPORTS_W_SIMPLE Params
    {
        CV_WRAP Params(); //!< the defaults

        //! Sets estimator: wrapped languages have no access to fields of a field.
        CV_WRAP void setEstimatorParams(const AckermannEstimator::Params& params);
        //! A copy of estimator.
        CV_WRAP AckermannEstimator::Params getEstimatorParams() const;

        //! Detector and gates of segments; gravitySigma and vehiclePitchSigma, and those of the camera's mount, aren't
        //! used
        AckermannEstimator::Params estimator;
        CV_PROP_RW int maxFrames; //!< largest number of frames that are kept, default 1000: some 20 MB
        //! Radians; standard deviation of the roll and the pitch of the camera that is given, default 3 degrees
        CV_PROP_RW double tiltSigma;
        CV_PROP_RW double headingSigma; //!< radians; the same of its heading, default 5 degrees
        //! The same of its line delay, relative, default 0.3; twice as much if none is given, and
        //! RollingShutterCamera::lineDelaySigma instead if the camera has one
        CV_PROP_RW double lineDelaySigma;
        //! Radians; by which suspension and road tilt the car, default 0.4 degrees
        CV_PROP_RW double suspensionSigma;
        //! Seconds; memory of such a tilt, default 0.5: that of a body that swings at 1.2 Hz with a damping ratio of
        //! 0.25
        CV_PROP_RW double suspensionTime;

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
    };

    /** @brief Creates a calibrator.
    @param camera the camera as far as it is known; its shutter must go along the rows. A line delay of 0 is estimated
    as well, from yaw rates in particular; one without a standard deviation is where the search starts, and has to be of
    a read-out of 2 to 100 ms.
    @param params see MountCalibrator::Params.
    @return the calibrator; throws cv::Exception if the camera or a parameter is out of range.
     */
    CV_WRAP static Ptr<MountCalibrator> create(const RollingShutterCamera& camera,
                                               const MountCalibrator::Params& params = MountCalibrator::Params());

    /** @brief Loads the camera and the parameters that Algorithm::save() has written.
    @param filename the file.
    @param objname name of the object in the file; empty: the first one.
    @return an object without frames; throws cv::Exception if the file has none, or
    not all of what save() has written. A file written by hand, without the key "format", needs the camera; other
    parameters have their defaults.
     */
    CV_WRAP static Ptr<MountCalibrator> load(const String& filename, const String& objname = String());

    //! Sets another camera and removes all frames; throws cv::Exception as create() does.
    CV_WRAP virtual void setCamera(const RollingShutterCamera& camera) = 0;
    //! The camera that is set.
    CV_WRAP virtual RollingShutterCamera getCamera() const = 0;
    //! Sets other parameters and removes all frames; throws cv::Exception with the name and value of the first one that
    //! is out of range.
    CV_WRAP virtual void setParams(const MountCalibrator::Params& params) = 0;
    //! The present parameters.
    CV_WRAP virtual MountCalibrator::Params getParams() const = 0;

    /** @brief Adds the next frame of the drive.
    @param image raw image of the camera's size, 8 or 16 bit with 1, 3 or 4 channels.
    @param seconds time of its reference row, from any origin. A second or more after the frame before, or not after it:
    another drive begins.
    @param prior speed and yaw rate, if they are given.
    @return whether the frame is used: the car moves, and enough points could be tracked from the frame before, which
    was given as an image, too.
     */
    CV_WRAP virtual bool addFrame(InputArray image, double seconds, const MotionPrior& prior = MotionPrior()) = 0;

    /** @brief Adds the next frame of the drive with points that were tracked and segments that were found elsewhere.
    @param points N x 4 matrix or N x 1 four-channel matrix, CV_32F or CV_64F, with (x, y) in the raw image of the frame
    before, then (x, y) in that of this frame; empty for the first frame. Points close to where a wall meets the road
    don't count: tracked ones would contain both.
    @param segments as in AckermannEstimator::estimate.
    @param seconds as in addFrame().
    @param prior as in addFrame().
    @return as in addFrame().
     */
    CV_WRAP virtual bool addPoints(InputArray points, InputArray segments, double seconds,
                                   const MotionPrior& prior = MotionPrior()) = 0;

    /** @brief Adds what a gyro on the camera has measured: how rows turn while a camera that shakes is read out.

    It shows the line delay much better than bends do. Bias, axes and the delay of its clock are found from the points,
    as RollingShutterCorrector::addGyro does; where they contradict the gyro it isn't used.
    @param times seconds, increasing, after those that were added before, on the clock of the frames or up to two
    seconds beside it: N x 1 or 1 x N of type CV_64F.
    @param rates rad/s about the axes x (to the right), y (down) and z (ahead) of the camera: N x 3 of type CV_64F.
    Throws cv::Exception if they are others.
     */
    CV_WRAP virtual void addGyro(InputArray times, InputArray rates) = 0;
    //! Forgets all samples of addGyro().
    CV_WRAP virtual void clearGyro() = 0;

    //! Removes all frames and forgets all samples of addGyro().
    CV_WRAP virtual void clear() CV_OVERRIDE = 0;

    /** @brief Fits all frames together.
    @return mount and line delay; may be called again after more frames.
     */
    CV_WRAP virtual MountCalibration calibrate() const = 0;
};

//! @}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_CALIBRATION_HPP
