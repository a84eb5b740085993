// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_SEQUENCE_ESTIMATOR_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_SEQUENCE_ESTIMATOR_HPP

#include "sequence_filter.hpp"
#include "row_rates.hpp"
#include "clock_noise.hpp"
#include "contradicted_values.hpp"
#include "gyro_rates.hpp"

namespace cv { namespace rsackermann {

//! What is known at a frame, for the frames after it.
struct SequenceMemory
{
    SequenceFilter filter; //!< without what is given
    RowRates rates;
    ClockNoise clockNoise;
    SequenceFit last;  //!< whose points showed the motion
    SequenceFit alone; //!< the same without what is given
    double seen;       //!< time of that; not finite if there is none
    double stillSince; //!< time of the first image up to the last one between which nothing moved; not finite if the
                       //!< last one moved
    bool isRepeated = false; //!< the image came again, or nearly

    SequenceMemory(const RollingShutterCamera& camera, const AckermannEstimator::Params& params);

    //! The same with another camera. @param difference of its values.
    void change(const CameraVector& difference);
};

//! The estimate from consecutive frames (doc/theory.md, "Sequence").
class SequenceEstimator : private SequenceMemory
{
public:
    //! @param single estimates motions of frames that have nothing to do with their neighbours; of the same camera and
    //! parameters.
    SequenceEstimator(const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
                      const Ptr<AckermannEstimator>& single);

    //! The same sequence, with another gravity or other parameters.
    void set(const RollingShutterCamera& camera, const AckermannEstimator::Params& params);

    /** Goes on to the next frame and estimates its motion: from points that are seen in the frame before or in the one
    after if there are some, else from the frames of the last second and, if they don't help, from the image alone.
    @param frame the image; a frame that was taken before the last one is as good.
    @param next the image after it, if that is known.
    @param segments of the image, N x 4, CV_64F.
    @param labels receives a #SegmentLabel for each segment. */
    AckermannMotion estimate(const GrayFrame& frame, const GrayFrame& next, const Mat& segments,
                             const MotionPrior& prior, Mat& labels);

    /** Finds scale and shift of a #DEPTH_RELATIVE of the last frame, and the motion that goes with it: by its points if
    they showed its motion, else by its verticals. The frames after don't depend on it.
    @param segments those of estimate().
    @return whether the image doesn't contradict the depth; otherwise motion and depth stay as they are. */
    bool alignDepth(const Mat& segments, AckermannMotion& motion, DepthMap& depth) const;

    //! Whether points showed the motion of the last frame.
    bool isSeen() const { return seen == filter.time && !isCopy; }

    //! The next frame belongs to another sequence.
    void reset();

    //! The motion of an image that has nothing to do with its neighbours, see estimate().
    AckermannMotion estimateSingle(double seconds, const Mat& segments, const MotionPrior& prior, Mat& labels);

    //! Whether a gyro that isn't wrong has measured how an image of that time turns.
    bool measures(double seconds) const;

    GyroRates gyro; //!< without samples if there is none

private:
    AckermannMotion estimateNew(const GrayFrame& frame, const GrayFrame& next, const Mat& segments,
                                const MotionPrior& prior, Mat& labels);
    bool estimateFromPoints(const GrayFrame& frame, const GrayFrame& next, const Mat& segments,
                            const MotionPrior& prior, AckermannMotion& motion, Mat& labels);
    CameraVector learnCamera(double longestNow);
    void expectByCamera(int sameValues);
    void turnCamera(double curvature);
    RollingShutterCamera straightCamera() const;
    bool useGiven(bool isSeen, const SequenceFilter& predicted, const AboutFit& aboutFit, const FitNuisances& nuisances,
                  MotionPrior& prior, AckermannMotion& motion);
    SequenceState marginal(const SequenceState& state) const;
    MotionPrior compareWithSeen(const SequenceFit& ofFrames, const MotionPrior& prior, const AboutFit& aboutFit,
                                AckermannMotion& motion);
    AckermannMotion estimateImage(double seconds, const Mat& segments, const MotionPrior& prior, Mat& labels);
    AckermannMotion estimateAlone(double seconds, const Mat& segments, const MotionPrior& prior, Mat& labels);
    void expectMotion(const MotionPrior& prior, AckermannMotion& motion, Mat& labels);
    void resetState();
    double putBackCopies(double passed);
    void updateRates(const SequenceState& predicted, double before, double after);
    bool measure(double seconds, MeasuredTurns& turns) const;
    void useGyro();
    void turnAlone(double seconds, const MotionPrior& prior, AckermannMotion& motion) const;
    Model predictDisplacement(const SequenceFit& fit, AckermannMotion& motion) const;
    void report(const SequenceFit& fit, const std::vector<UprightSegment>& verticals, const MotionPrior& prior,
                AckermannMotion& motion, Mat& labels) const;

    RollingShutterCamera camera;
    RollingShutterCamera turnedCamera; // into the direction in which it moves
    CameraVector cameraChange;         // by what is seen of it
    double curvature = 0;              // of the way in the last frame, 1/m
    AckermannEstimator::Params params;
    Ptr<AckermannEstimator> single;
    ContradictedValues contradicted;
    SeenCamera seenCamera;
    FrameFeatures features;
    Mat image; // the last one, with what was found in it
    AckermannMotion motionOfImage;
    MotionPrior priorOfImage; // what is known of its motion, or else was before its verticals were seen
    Mat segmentsOfImage, labelsOfImage;
    bool isKnown = false; // by its points, or expected as its image before came again
    bool isCopy = false;  // nearly the image before
    double interval = 0;  // seconds from the frame before to the last one in which its points were found
    SequenceMemory kept;  // at the frame that FrameFeatures keeps
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_SEQUENCE_ESTIMATOR_HPP
