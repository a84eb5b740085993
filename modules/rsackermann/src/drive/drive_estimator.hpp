// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_ESTIMATOR_HPP
#define OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_ESTIMATOR_HPP

#include "drive_fit.hpp"

namespace cv {
namespace rsackermann {

//! What consecutive frames say together (doc/theory.md, "Drive").
class DriveEstimator
{
public:
    DriveEstimator(const RollingShutterCamera& camera, const AckermannEstimator::Params& params);

    //! The same drive, with another gravity or other parameters.
    void set(const RollingShutterCamera& camera, const AckermannEstimator::Params& params);

    /** Goes on to the next frame and estimates its motion, if points could be tracked from a frame before.
    @param gray the image in 8 bit grey, smaller by scale; empty: points aren't tracked.
    @param segments of the image, N x 4, CV_64F.
    @param seconds time of its reference row; a frame that was taken before the last one is as good.
    @param labels receives a #SegmentLabel for each segment.
    @return false if there is nothing to go by: for a first frame, and for one that doesn't follow from the one before. */
    bool estimate(const Mat& gray, int scale, const Mat& segments, double seconds, const MotionPrior& prior, AckermannMotion& motion,
                  Mat& labels);

    //! What is known and what the frames before say of the yaw rate, for an estimate from the image alone.
    MotionPrior priorOfFrame(const MotionPrior& prior) const;

    //! What an image alone has said.
    void learn(const AckermannMotion& motion);

    //! The next frame belongs to another sequence.
    void reset();

private:
    RollingShutterCamera camera;
    AckermannEstimator::Params params;
    PointTracker tracker;
    DriveState state;  // of the last frame
    double time;       // of the last frame
    bool hasFrame;
    bool isVague;      // whether no frame has told the motion yet
    std::vector<PointPair> pairs;

    void report(const DriveFit& fit, const std::vector<Candidate>& verticals, const MotionPrior& prior, AckermannMotion& motion, Mat& labels) const;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_ESTIMATOR_HPP
