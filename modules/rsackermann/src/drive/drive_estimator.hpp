// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_ESTIMATOR_HPP
#define OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_ESTIMATOR_HPP

#include "flow_fit.hpp"

namespace cv {
namespace rsackermann {

//! What consecutive frames say together.
class DriveEstimator
{
public:
    explicit DriveEstimator(const RollingShutterCamera& camera_) : camera(camera_), state(camera_), time(0), hasFrame(false), isFirst(true) {}

    /** Estimates the motion of a frame from the frames before and the points that are tracked from the last one.
    @param gray the image in 8 bit grey, smaller by scale.
    @param seconds time of its reference row.
    @return whether there is something to go by: not for a first frame, and not if the frame doesn't follow from the one before. */
    bool estimate(const Mat& gray, int scale, double seconds, const MotionPrior& prior, AckermannMotion& motion);

    //! The next frame belongs to another sequence.
    void reset();

private:
    RollingShutterCamera camera;
    PointTracker tracker;
    DriveState state;
    double time;
    bool hasFrame, isFirst;
    std::vector<PointPair> pairs;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_ESTIMATOR_HPP
