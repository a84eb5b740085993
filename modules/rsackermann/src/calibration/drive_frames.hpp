// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CALIBRATION_DRIVE_FRAMES_HPP
#define OPENCV_RSACKERMANN_SRC_CALIBRATION_DRIVE_FRAMES_HPP

#include "../sequence/clock_noise.hpp"
#include "../sequence/sequence_filter.hpp"
#include "calibration_frame.hpp"

namespace cv { namespace rsackermann {

//! The frames of a drive that show how the car moves: each is fitted as it comes, and what a fit of all needs is kept.
class DriveFrames
{
public:
    /** @param given the camera; without a line delay it gets one to start from, by the first interval.
    @param gates_ of segments and of the fit of a frame.
    @param maxFrames_ that are kept, whatever the length of the drive. */
    DriveFrames(const RollingShutterCamera& given, const AckermannEstimator::Params& gates_, int maxFrames_);

    /** Adds the next frame, whose points are tracked in the one before.
    @param ofInstant speed and yaw rate, if they are given.
    @return whether it is used. */
    bool add(const GrayFrame& frame, const Mat& segments, const MotionPrior& ofInstant);

    //! The same with points that were tracked elsewhere; those beside the image don't count.
    bool add(const Mat& points, const Mat& segments, double seconds, const MotionPrior& ofInstant);

    const RollingShutterCamera& camera() const { return camera_; } //!< with a line delay
    const std::vector<CalibrationFrame>& kept() const { return frames; }
    double intervalSigma() const { return clock.sigma(); } //!< relative

    int contrary = 0;     //!< frames in which the car goes the other way than is given, or usual
    int contradicted = 0; //!< whose given values the points contradict

private:
    template <class SetPoints>
    bool addAt(double seconds, const Mat& segments, const MotionPrior& ofInstant, const SetPoints& setPoints);
    bool moved(SequenceFilter& of, const MotionPrior& prior, SequenceFit& fit) const;
    bool goesTheOtherWay(const SequenceFit& fit, const MotionPrior& prior) const;
    CalibrationFrame frameOf(const SequenceFit& fit, double before, const MotionPrior& prior) const;
    void keep(const CalibrationFrame& frame);

    RollingShutterCamera camera_;
    AckermannEstimator::Params gates;
    int maxFrames;
    FrameFeatures features;
    std::vector<CalibrationFrame> frames;
    std::vector<int> numbers; // of each frame's run
    int number = 0, drive = 0, stride = 1;
    MotionPrior givenBefore; // of the frame before

    SequenceFilter filter, unaided;                            // unaided: without a given speed or yaw rate
    ClockNoise clock{std::numeric_limits<double>::infinity()}; // of the whole drive
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CALIBRATION_DRIVE_FRAMES_HPP
