// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_CORRECTOR_HPP
#define OPENCV_RSACKERMANN_CORRECTOR_HPP

#include "opencv2/rsackermann/estimator.hpp"
#include "opencv2/rsackermann/warp.hpp"

namespace cv { namespace rsackermann {

//! @addtogroup rsackermann
//! @{

/** @brief Undoes the rolling shutter of an image in one call: detects segments, estimates the motion, makes the maps
and remaps.

If the motion's status isn't #MOTION_OK only the lens is corrected; without lens coefficients the image is copied.

Each thread needs its own object: a correction changes its buffers, segments, maps and the state of a sequence. Objects
share no state.
@sa AckermannEstimator, WarpMapGenerator
 */
class CV_EXPORTS_W RollingShutterCorrector : public Algorithm
{
public:
    /** @brief Parameters of the correction.

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
        //! Sets warp, for the same reason.
        CV_WRAP void setWarpParams(const WarpMapGenerator::Params& params);
        //! A copy of warp.
        CV_WRAP WarpMapGenerator::Params getWarpParams() const;

        AckermannEstimator::Params estimator; //!< of the estimation
        WarpMapGenerator::Params warp;        //!< of the maps
        CV_PROP_RW int interpolation;         //!< of cv::remap, one of cv::InterpolationFlags, default cv::INTER_LINEAR
        /** whether the images are consecutive frames of one sequence, default false: motion and scene are propagated
        between frames, and with trackPoints deviations of the scene from planes are estimated
        (AckermannMotion::inverseDepthOffset); needs RollingShutterCamera::lineDelay, without which create() and
        corrections throw cv::Exception */
        CV_PROP_RW bool sequence;
        //! Whether points are tracked from frame to frame if sequence is set, default true. Then the estimator's
        //! model has to be #MODEL_AUTO. A frame whose points are found again is estimated by other means: without its
        //! seed, confidence, maxIterations, minCandidates, reverseProbability, roadRatio and harmAversion and without
        //! RollingShutterCamera::distortionSigma, and maxYawRate and maxSpeed don't limit it.
        CV_PROP_RW bool trackPoints;
        //! Seconds from one frame to the next without setTimestamp(), default 1/30
        CV_PROP_RW double frameInterval;
        /** @name What is known of a gyro beforehand, as standard deviations; without effect without addGyro()
        Of what it isn't known for sure the points of a sequence are asked.
        @{ */
        //! Seconds; of its clock against that of setTimestamp(), default 0.02
        CV_PROP_RW double gyroDelaySigma;
        CV_PROP_RW double gyroAxesSigma; //!< radians; of the directions of its axes, default 2 degrees
        CV_PROP_RW double gyroBiasSigma; //!< rad/s; of its bias about each axis, default 1 deg/s
        //! Relative; of the focal length over what it says of pitch and yaw, beside that of
        //! RollingShutterCamera::focalSigma, default 0.03
        CV_PROP_RW double gyroScaleSigma;
        //! @}

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

    /** @brief Creates a corrector.
    @param camera the camera; copied.
    @param params see RollingShutterCorrector::Params.
    @return the corrector; throws cv::Exception if the camera or a parameter is out of range.
     */
    CV_WRAP static Ptr<RollingShutterCorrector>
    create(const RollingShutterCamera& camera,
           const RollingShutterCorrector::Params& params = RollingShutterCorrector::Params());

    /** @brief Loads the camera and the parameters that Algorithm::save() has written.
    @param filename the file.
    @param objname name of the object in the file; empty: the first one.
    @return an object in the same state as one that was just created; throws cv::Exception if the file has none, or
    not all of what save() has written. A file written by hand, without the key "format", needs the camera; other
    parameters have their defaults.
     */
    CV_WRAP static Ptr<RollingShutterCorrector> load(const String& filename, const String& objname = String());

    //! Sets another camera; throws cv::Exception if RollingShutterCamera::check() does.
    CV_WRAP virtual void setCamera(const RollingShutterCamera& camera) = 0;
    //! The present camera.
    CV_WRAP virtual RollingShutterCamera getCamera() const = 0;
    //! Sets other parameters; throws cv::Exception with the name and value of the first one that is out of range.
    CV_WRAP virtual void setParams(const RollingShutterCorrector::Params& params) = 0;
    //! The present parameters.
    CV_WRAP virtual RollingShutterCorrector::Params getParams() const = 0;

    /** @brief Sets given values of the motion; used for all images until they are set again.
    @param prior see MotionPrior.
     */
    CV_WRAP virtual void setPrior(const MotionPrior& prior) = 0;
    //! The present prior.
    CV_WRAP virtual MotionPrior getPrior() const = 0;

    /** @brief Sets the time of the next image of a sequence.

    Times of consecutive images increase: an image that isn't later than the one before begins another sequence.
    @param seconds time of its reference row from any origin, up to 1e12; not finite: Params::frameInterval after the
    image before. Used once: by correct(), correctWithSegments() or skipFrame().
     */
    CV_WRAP virtual void setTimestamp(double seconds) = 0;

    /** @brief Adds what a gyro on the camera has measured: how rows turn, at rates and beyond them
    (AckermannMotion::rotationCurve).

    In a sequence with Params::trackPoints the points of the frames show the gyro's bias, the delay of its clock and by
    how much its axes are turned (a few degrees), and whether it says anything true at all. Without points, and of a
    single image, they count by their mean over the instants that Params::gyroDelaySigma leaves possible, with a bias
    of 0 up to Params::gyroBiasSigma: what shakes while the clock isn't known is left as it is.
    A single image needs a time of setTimestamp().
    An image is corrected with samples that reach beyond both its ends; others are corrected without the gyro, and so is
    an image in a gap of more than 0.1 s.
    @param times seconds, on the clock of setTimestamp(), as N x 1 matrix CV_64F or vector<double>: increasing, and
    after those of earlier calls; throws cv::Exception otherwise. A call may forget samples that are more than a minute
    earlier than the last image.
    @param rates rad/s about the axes of the camera (x to the right, y down, z ahead), right-handed: the first one is
    positive if the camera turns upwards, unlike AckermannMotion::pitchRate, the second one if it turns to the right,
    the third one if it rolls clockwise as seen from behind: N x 3 matrix CV_64F.
     */
    CV_WRAP virtual void addGyro(InputArray times, InputArray rates) = 0;

    /** @brief What is between the gyro and the camera, as the points of the last ten seconds or so show it.
    @param delay seconds by which the gyro's clock is ahead of that of the frames; found from -2 to 2.
    @param axes rotation vector in radians, about the axes of the camera: what a gyro shows is turned by it.
    @param bias rad/s about these axes that is added to what the gyro shows.
    @return true, with zeros, as long as nothing is shown; false if the points of a second or so contradict the gyro,
    which isn't used then: its unit, its axes or its clock may be another.
     */
    CV_WRAP virtual bool getGyroAlignment(CV_OUT double& delay, CV_OUT Vec3d& axes, CV_OUT Vec3d& bias) const = 0;

    /** @brief Whether samples of addGyro() say how the rows of the last image turn.
    @return false without a motion, too. */
    CV_WRAP virtual bool isGyroUsed() const = 0;

    //! Forgets all samples of addGyro().
    CV_WRAP virtual void clearGyro() = 0;

    /** @brief Lets the time of an image of a sequence pass without the image: for one that is missing or damaged, or
    whose correction threw an exception.

    Its time is that of setTimestamp() or Params::frameInterval after the image before. Without this call, or the time
    of the image after it, the interval between the two images beside the gap would be wrong.
     */
    CV_WRAP virtual void skipFrame() = 0;

    /** @brief Sets the image after the one that is corrected next: points are tracked into it, too, and more of them
    determine the inverse-depth offset if the image is large.

    For recorded sequences, of which each frame or at least the first one can be corrected with later ones, as
    `rsackermann_correct` does with `--smooth` and `--carry`.
    Used if Params::sequence and Params::trackPoints are set.
    @param image raw image of the camera's size, of a type for the detection; copied.
    @param seconds time of its reference row, as in setTimestamp(); not finite: Params::frameInterval after the one
    before it. An image that isn't later than that isn't used.
     */
    CV_WRAP virtual void setNextFrame(InputArray image, double seconds) = 0;

    /** @brief Resets the state of the sequence, its time and the frame after it: for the first frame of another
    sequence.

    The state is also reset if a camera is set that differs in more than uprightRotation and standard deviations, after
    #LONGEST_INTERVAL without an image, and if hardly any point of the image before is found again, unless images are
    missing between them or that one was lost itself. The image after a damaged one goes on from the image before that.
    An image that shows no points is corrected by the predicted motion, for a second and as long as that is expected to
    help.
     */
    CV_WRAP virtual void reset() = 0;

    //! Forgets all but the camera and the parameters: what reset() resets, the prior and the gyro.
    CV_WRAP virtual void clear() CV_OVERRIDE = 0;

    /** @brief Corrects an image.
    @param src raw image of the camera's size, up to 32766 pixels along each side; any type that cv::remap takes, and 8
    or 16 bit with 1, 3 or 4 channels for the detection.
    @param dst corrected image of the same type; may be src. Pixels that the raw image doesn't show are 0.
    @param mask receives a CV_8U mask, 255 where a pixel is seen in the raw image and 0 elsewhere; with a depth
    #MASK_HIDDEN marks pixels that something hides in the raw image. Another matrix than src and dst.
    @param depth see DepthMap and WarpMapGenerator::initRectifyMap(); empty (default): none is given. A metric one
    is used by the maps if the motion has metres. A relative one is evidence: the motion is that with it. See
    isDepthUsed().
    @return the motion; see AckermannMotion::status.
     */
    CV_WRAP virtual AckermannMotion correct(InputArray src, OutputArray dst, OutputArray mask = noArray(),
                                            const DepthMap& depth = DepthMap()) = 0;

    /** @brief Corrects an image with segments that were found elsewhere.
    @param src raw image of the camera's size, of any type that cv::remap takes, with up to 4 channels for INTER_CUBIC
    and INTER_LANCZOS4 (Params::interpolation); of a type for the detection, as in correct(), if points are tracked
    (Params::sequence and Params::trackPoints).
    @param segments as in AckermannEstimator::estimate.
    @param dst corrected image, as in correct().
    @param mask as in correct().
    @param depth as in correct().
    @return the motion, as from correct().
     */
    CV_WRAP virtual AckermannMotion correctWithSegments(InputArray src, InputArray segments, OutputArray dst,
                                                        OutputArray mask = noArray(),
                                                        const DepthMap& depth = DepthMap()) = 0;

    /** @brief Corrects an image with a given motion. It isn't a frame of the sequence, see skipFrame().
    @param src raw image of the camera's size, of any type that cv::remap takes, as in correctWithSegments().
    @param motion the motion; if its status isn't #MOTION_OK only the lens is corrected.
    @param dst corrected image, as in correct().
    @param mask as in correct().
    @param depth as in correct().
     */
    CV_WRAP virtual void correctWithMotion(InputArray src, const AckermannMotion& motion, OutputArray dst,
                                           OutputArray mask = noArray(), const DepthMap& depth = DepthMap()) = 0;

    /** @brief Whether tracked points showed the motion of the last image: a frame of a sequence, see
    Params::trackPoints, some of whose points were found again in the frame before or in that of setNextFrame().

    If no frame is, those of a sequence may be none for their times, see setTimestamp(). */
    CV_WRAP virtual bool isTracked() const = 0;

    /** @brief Whether the given depth of the last image was used.

    A depth in metres needs a motion in metres: AckermannMotion::wallDistance, or AckermannMotion::roadSlope,
    RollingShutterCamera::height and an AckermannMotion::scale. A given speed (MotionPrior::speed) or
    AckermannEstimator::Params::wallDistance suffices for that. Without metres the planes count, and so they do for a
    motion whose status isn't #MOTION_OK, where no depth at all is known, and unless the motion is given
    (correctWithMotion()) where the depths are evidently in another unit: their median is more than 20 times or less
    than a twentieth of that of the planes, or the camera's height above the road that they show is more than three
    standard deviations (AckermannEstimator::Params::priorHeightLogSigma) away from RollingShutterCamera::height, or
    from AckermannEstimator::Params::priorHeight if that isn't known. Nor is a depth used of which verticals of the
    image have more of a slant left than of the planes: a disparity, a constant, one of another image.

    A #DEPTH_RELATIVE of the raw camera needs no metres, but a road, edges that it has in common with the image, and
    verticals: one of another image, mirrored or constant isn't used. It may show a motion where the image alone
    doesn't. With correctWithMotion() it is used as it is.

    In a frame of a sequence (Params::sequence) with tracked points the planes must not explain these better than the
    depth does. That of one in metres is what the motion's way, as surely as its speed and the depth's scale are known
    (AckermannMotion::metricCovariance(), DepthMap::scaleSigma), makes of it.
     */
    CV_WRAP virtual bool isDepthUsed() const = 0;

    /** @brief The depth that the maps of the last image follow: the given one, of a #DEPTH_RELATIVE with the scale and
    the shift that were found, of a #DEPTH_METRIC with the scale that agrees with tracked points at the motion's speed;
    empty if it wasn't used. Its values are those that were given, not a copy of them. */
    CV_WRAP virtual DepthMap getUsedDepth() const = 0;

    /** @brief The segments of the last image and their labels.
    @param segments N x 4 matrix CV_32F with (x1, y1, x2, y2) in pixels of the raw image, or vector<Vec4f>.
    @param labels N x 1 matrix CV_8U, see #SegmentLabel.
     */
    CV_WRAP virtual void getSegments(OutputArray segments, OutputArray labels) const = 0;

    /** @brief The maps with which the last image was remapped.
    @param map1 CV_32FC1, columns in the raw image.
    @param map2 CV_32FC1, rows in the raw image.
     */
    CV_WRAP virtual void getMaps(OutputArray map1, OutputArray map2) const = 0;

    //! Milliseconds that detection, estimation, maps and remapping of the last image took.
    CV_WRAP virtual Vec4d getTimings() const = 0;
};

//! @}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_CORRECTOR_HPP
