// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_MOTION_LIMITS_HPP
#define OPENCV_RSACKERMANN_SRC_MOTION_LIMITS_HPP

#include "opencv2/rsackermann/estimator.hpp"
#include "model.hpp"

namespace cv { namespace rsackermann {

/** Limits of the motion in the units of the estimation.

Metric limits count if they can be expressed; the largest slant of a candidate always does.
*/
struct MotionLimits
{
    double maxAlpha;
    double maxScaledSpeed;      // of sqrt(B^2 + D^2)
    double maxRightScaledSpeed; // of lambda sqrt(B^2 + D^2), which the right wall has in the place of it
    bool areMetric;             // whether yaw rate and speed set the limits

    MotionLimits(const RollingShutterCamera& camera, const AckermannEstimator::Params& params);

    bool allow(const Model& model) const;

    //! Largest |dx/dt| of the image of a vertical line at the column x (doc/theory.md, "Estimation").
    double maxSlant(double x, double heading) const;
};

//! The same parameters with limits of yaw rate and speed that what is given doesn't exceed.
AckermannEstimator::Params withLimitsOf(const MotionPrior& given, AckermannEstimator::Params params);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_MOTION_LIMITS_HPP
