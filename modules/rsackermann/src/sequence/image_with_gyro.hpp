// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_IMAGE_WITH_GYRO_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_IMAGE_WITH_GYRO_HPP

#include "row_rates.hpp"

namespace cv { namespace rsackermann {

/** The motion that the verticals of an image show, with what a gyro has measured while it was read: the yaw rate,
beside other sources, and how rows roll and pitch.
@param single estimates the motion by verticals.
@param prior what is given; receives that and what is measured. */
AckermannMotion estimateWithGyro(const AckermannEstimator& single, const RollingShutterCamera& camera,
                                 const MeasuredTurns& turns, const Mat& segments, MotionPrior& prior, Mat& labels);

/** Where the image shows nothing a gyro still knows how the camera turns, but not how it moves. Changed only if that is
expected to help.
@param prior what is given. */
void turnByGyro(const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
                const MeasuredTurns& turns, const MotionPrior& prior, AckermannMotion& motion);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_IMAGE_WITH_GYRO_HPP
