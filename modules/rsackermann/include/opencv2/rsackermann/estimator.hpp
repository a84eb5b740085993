// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_ESTIMATOR_HPP
#define OPENCV_RSACKERMANN_ESTIMATOR_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace cv { namespace rsackermann {

//! @addtogroup rsackermann
//! @{

//! Detectors of line segments.
enum SegmentDetector {
    DETECTOR_LSD = 0,      //!< cv::LineSegmentDetector of imgproc
    DETECTOR_FLD = 1,      //!< cv::ximgproc::FastLineDetector, needs the module ximgproc
    DETECTOR_EDLINES = 2,  //!< cv::ximgproc::EdgeDrawing, needs the module ximgproc
    DETECTOR_VERTICALS = 3 //!< of this module: edges that cross the rows of the image, and those that cross its columns
};

//! The estimator's verdict on a segment.
enum SegmentLabel {
    SEGMENT_REJECTED = 0,  //!< not a candidate: too short or too slanted to be the image of a vertical line
    SEGMENT_OUTLIER = 1,   //!< candidate that disagrees with the motion
    SEGMENT_LEFT_WALL = 2, //!< inlier on the vehicle's left (or only) wall
    SEGMENT_RIGHT_WALL = 3 //!< inlier on the right wall
};

/** @brief Detects line segments in an image.

Images of more than 0.8 megapixels are searched in halved form, in which straight lines can still be seen. Then, and
after detectors other than LSD, the ends are refined to a fraction of a pixel in the image itself. An edge that a lens
has bent evenly is one segment of #DETECTOR_VERTICALS, whose ends are on the edge; other detectors cut it.
@param image grey or colour image, 8 or 16 bit.
@param segments N x 4 matrix CV_32F with rows (x1, y1, x2, y2) in pixels, or vector<Vec4f>.
@param detector one of #SegmentDetector.
@param minLength length in pixels below which segments are omitted.
 */
CV_EXPORTS_W void detectSegments(InputArray image, OutputArray segments, int detector = DETECTOR_VERTICALS,
                                 double minLength = 35);

/** @brief Estimates the motion of the car during one rolling-shutter image.

The images of vertical lines of the scene (walls, posts, windows) are skewed by the motion. The estimator
-# keeps the segments that can be images of vertical lines within the limits of motion,
-# refines the motion with the exact model and a robust loss on all candidates; the other segments determine the
direction of the street and, with the candidates, the error of gravity; given values are further measurements,
-# averages the correction over all motions that are possible, a camera at rest among them, weighted by their
probability, so that the expected displacement is the smallest. If that isn't below that of the raw image, as it is if
the camera is at rest with a probability above one half, no motion is reported.

With a Params::model the average is restricted to its motions. One of the starts of the refinement is a consensus of
minimal solvers (solve1LA, solve3LA, solve4LA) in a locally optimised RANSAC @cite chum2003locally.

The result is the same for the same seed, whatever the number of threads.

All const methods, estimate() and estimateFromImage() among them, may run at the same time in several threads on the
same object; the others need an object that no other thread uses meanwhile.
@sa @cite purkait2018minimal
 */
class CV_EXPORTS_W AckermannEstimator : public Algorithm
{
public:
    /** @brief Parameters of the estimation.

    Const methods may run at the same time in several threads on the same object; changes need an object that no other
    thread uses meanwhile.
     */
    struct CV_EXPORTS_W_SIMPLE Params
    {
        CV_WRAP Params();            //!< the defaults
        CV_PROP_RW int model;        //!< one of #MotionModel, default #MODEL_AUTO
        CV_PROP_RW int detector;     //!< one of #SegmentDetector, default #DETECTOR_VERTICALS
        CV_PROP_RW double minLength; //!< pixels; shorter segments are omitted, default 35
        //! Largest tangent of the angle between a candidate and the vertical, used unless maxYawRate and maxSpeed limit
        //! it, default 0.35
        CV_PROP_RW double maxSlant;
        //! Tangent of the angle by which noise and an inexact gravity may exceed the limits of motion, default 0.06
        CV_PROP_RW double slantTolerance;
        CV_PROP_RW int minCandidates; //!< with fewer candidates no motion is estimated, default 6
        CV_PROP_RW double threshold;  //!< pixels; a candidate with a smaller residual is an inlier, default 0.5
        CV_PROP_RW double confidence; //!< probability with which RANSAC has found the best consensus, default 0.99
        CV_PROP_RW int maxIterations; //!< largest number of minimal samples, default 500
        CV_PROP_RW int seed;          //!< of the random numbers, default 0
        //! Radians per second, default 90 degrees per second; used if lineDelay is known. A given yaw rate may exceed
        //! it
        CV_PROP_RW double maxYawRate;
        //! Metres per second, default 200 km/h; used if lineDelay and the wall's distance are known. A given speed may
        //! exceed it
        CV_PROP_RW double maxSpeed;
        //! Metres to the vehicle's left wall, which a camera that looks backward has on the right of its images, or to
        //! the only one that is seen; 0: unknown (default)
        CV_PROP_RW double wallDistance;
        //! Standard deviation of the logarithm of wallDistance: facades aren't plane, and cars don't keep their
        //! distance. Where road and walls contradict the distance, they count. 0: exact; at most 10, default 0.1
        CV_PROP_RW double wallDistanceLogSigma;
        //! Distance of the left (or only) wall over the camera's height, assumed if one of them is unknown; 0
        //! (default): priorWallDistance over priorHeight. Without effect if scaleFromRoad finds it
        CV_PROP_RW double roadRatio;
        //! If wallDistance is unknown and the camera's height known: find the distance from wall segments that stand on
        //! the road, if they say more of it than what is expected; default false
        CV_PROP_RW bool scaleFromRoad;
        /** radians; standard deviation of the vehicle's roll: with that of the mount (RollingShutterCamera::rollSigma)
        the error of the camera's upright rotation against the verticals of the scene, which is then corrected. 0: the
        upright rotation is exact, whatever the mount; default 1 degree, for the
        crown of a road and the suspension */
        CV_PROP_RW double gravitySigma;
        //! Radians; the same for the vehicle's pitch, used unless gravitySigma is 0, default 0.3 degrees
        CV_PROP_RW double vehiclePitchSigma;
        //! Standard deviation of the sine of the angle between the walls and the vehicle's forward direction, 0:
        //! unknown, default 0.4
        CV_PROP_RW double wallDeviationSigma;
        /** @name The prior on motion and street, where nothing is given
        A sequence begins with the mean and the variance of the same distributions and returns to them without
        evidence: doc/theory.md, "Prior". Standard deviations of logarithms are at most 10.
        @{ */
        //! Radians per second; scale of Student's t distribution with two degrees of freedom of the yaw rate: half of
        //! all are below 0.82 of it. Default 5 degrees per second
        CV_PROP_RW double priorYawRate;
        CV_PROP_RW double priorSpeed;                //!< metres per second; median of the speed, default 12
        CV_PROP_RW double priorSpeedLogSigma;        //!< standard deviation of its logarithm, default 0.8
        CV_PROP_RW double priorWallDistance;         //!< metres; median distance of a wall, default 15
        CV_PROP_RW double priorWallDistanceLogSigma; //!< standard deviation of its logarithm, default 0.9
        //! Standard deviation of the logarithm of the ratio of both walls' distances: streets are alike, default 0.8
        CV_PROP_RW double priorWallRatioLogSigma;
        //! Correlation of the logarithms of speed and distance, below 1: drivers slow down where walls are near,
        //! default 0.6
        CV_PROP_RW double priorSpeedWallCorrelation;
        CV_PROP_RW double priorHeight;         //!< metres; median height of the camera, default 1.3
        CV_PROP_RW double priorHeightLogSigma; //!< standard deviation of its logarithm, default 0.35
        //! Seconds from the first row to the last, if RollingShutterCamera::lineDelay is unknown: median, default 0.05
        CV_PROP_RW double priorReadoutTime;
        CV_PROP_RW double priorReadoutTimeLogSigma; //!< standard deviation of its logarithm, default 0.7
        CV_PROP_RW double
            standingProbability; //!< that the car stands, or that the shutter isn't a rolling one, default 1/2
        CV_PROP_RW double reverseProbability; //!< that the car drives backward, default 0.02
        //! @}
        /** How many pixels of expected residual one pixel of expected harm is worth, E[max(0, residual - raw)]: the
        correction minimises the sum of both. 0: the residual alone; default 1 */
        CV_PROP_RW double harmAversion;

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

    /** @brief Creates an estimator.
    @param camera the camera; copied.
    @param params see AckermannEstimator::Params.
    @return the estimator; throws cv::Exception if the camera or a parameter is out of range.
     */
    CV_WRAP static Ptr<AckermannEstimator>
    create(const RollingShutterCamera& camera, const AckermannEstimator::Params& params = AckermannEstimator::Params());

    /** @brief Loads the camera and the parameters that Algorithm::save() has written.
    @param filename the file.
    @param objname name of the object in the file; empty: the first one.
    @return an object in the same state as one that was just created; throws cv::Exception if the file has none, or
    not all of what save() has written. A file written by hand, without the key "format", needs the camera; other
    parameters have their defaults.
     */
    CV_WRAP static Ptr<AckermannEstimator> load(const String& filename, const String& objname = String());

    //! Sets another camera; throws cv::Exception if RollingShutterCamera::check() does.
    CV_WRAP virtual void setCamera(const RollingShutterCamera& camera) = 0;
    //! The present camera.
    CV_WRAP virtual RollingShutterCamera getCamera() const = 0;
    //! Sets other parameters; throws cv::Exception with the name and value of the first one that is out of range.
    CV_WRAP virtual void setParams(const AckermannEstimator::Params& params) = 0;
    //! The present parameters.
    CV_WRAP virtual AckermannEstimator::Params getParams() const = 0;

    /** @brief Estimates the motion from line segments.
    @param segments N x 4 matrix or N x 1 four-channel matrix, CV_32F or CV_64F, with (x1, y1, x2, y2) in pixels of the
    raw image; vector<Vec4f> for short.
    @param labels receives an N x 1 matrix CV_8U with one of #SegmentLabel for each segment.
    @param prior given values.
    @return the motion; see AckermannMotion::status.
     */
    CV_WRAP virtual AckermannMotion estimate(InputArray segments, OutputArray labels = noArray(),
                                             const MotionPrior& prior = MotionPrior()) const = 0;

    /** @brief Detects line segments and estimates the motion.
    @param image raw image of the camera's size, see detectSegments.
    @param segments receives the detected segments, as from detectSegments().
    @param labels as in estimate().
    @param prior as in estimate().
    @return as from estimate().
     */
    CV_WRAP virtual AckermannMotion estimateFromImage(InputArray image, OutputArray segments = noArray(),
                                                      OutputArray labels = noArray(),
                                                      const MotionPrior& prior = MotionPrior()) const = 0;
};

//! @}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_ESTIMATOR_HPP
