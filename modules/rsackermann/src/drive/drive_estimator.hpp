// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_ESTIMATOR_HPP
#define OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_ESTIMATOR_HPP

#include "drive_fit.hpp"

namespace cv { namespace rsackermann {

//! A frame in 8 bit grey, smaller by scale; empty: it isn't used.
struct GrayFrame
{
    Mat gray;
    int scale;
    double seconds; // time of its reference row

    GrayFrame() : scale(1), seconds(0) {}
    GrayFrame(const Mat& gray_, int scale_, double seconds_) : gray(gray_), scale(scale_), seconds(seconds_) {}
};

//! The estimate from consecutive frames (doc/theory.md, "Drive").
class DriveEstimator
{
public:
    DriveEstimator(const RollingShutterCamera& camera, const AckermannEstimator::Params& params);

    //! The same drive, with another gravity or other parameters.
    void set(const RollingShutterCamera& camera, const AckermannEstimator::Params& params);

    /** Goes on to the next frame and estimates its motion, if points could be tracked from a frame before.
    @param frame the image; a frame that was taken before the last one is as good.
    @param next the image after it, if that is known.
    @param segments of the image, N x 4, CV_64F.
    @param labels receives a #SegmentLabel for each segment.
    @return false if there is nothing to go by: for a frame that has nothing to do with the one before and the one
    after. */
    bool estimate(const GrayFrame& frame, const GrayFrame& next, const Mat& segments, const MotionPrior& prior,
                  AckermannMotion& motion, Mat& labels);

    /** The motion that the frames of the last second let expect of the present one, if it shows nothing itself.
    @param motion the estimate from the image alone; changed only if one is expected and helps. */
    void expectMotion(const MotionPrior& prior, AckermannMotion& motion, Mat& labels) const;

    //! The prior of an estimate from the image alone: the told one and the yaw rate of the frames before.
    MotionPrior priorOfFrame(const MotionPrior& prior) const;

    //! Takes over the estimate from an image alone.
    void learn(const AckermannMotion& motion);

    //! The next frame belongs to another sequence.
    void reset();

private:
    RollingShutterCamera camera;
    AckermannEstimator::Params params;
    PointTracker tracker, fineTracker;
    DriveState state; // of the last frame
    double time;      // of the last frame
    bool hasFrame;
    bool isVague;  // whether no frame has told the motion yet
    DriveFit last; // whose points told the motion
    double seen;   // time of that; not finite if there is none
    std::vector<PointPair> pairs;
    std::vector<Sight> sights, fineSights; // those of the fit, and of the relief if there is time for more

    void follow(PointTracker& points, const GrayFrame& frame, double passed, const GrayFrame* next,
                std::vector<Sight>& found);
    void forget();
    void look(const GrayFrame& frame, const GrayFrame& next, double passed);
    Model predictDisplacement(const DriveFit& fit, AckermannMotion& motion) const;
    void report(const DriveFit& fit, const std::vector<UprightSegment>& verticals, const MotionPrior& prior,
                AckermannMotion& motion, Mat& labels) const;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_ESTIMATOR_HPP
