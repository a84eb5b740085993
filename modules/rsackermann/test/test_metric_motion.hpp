// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_TEST_RSACKERMANN_METRIC_MOTION_HPP
#define OPENCV_TEST_RSACKERMANN_METRIC_MOTION_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace opencv_test {

//! AckermannMotion::fromMetric in one line.
inline cv::rsackermann::AckermannMotion motionFromMetric(const cv::rsackermann::RollingShutterCamera& camera,
                                                         double yawRate, double speed, double left, double right,
                                                         double wallDirection)
{
    cv::rsackermann::MetricMotion metric;
    metric.yawRate = yawRate;
    metric.speed = speed;
    metric.leftDistance = left;
    metric.rightDistance = right;
    metric.wallDirection = wallDirection;
    return cv::rsackermann::AckermannMotion::fromMetric(camera, metric);
}

} // namespace opencv_test

#endif // OPENCV_TEST_RSACKERMANN_METRIC_MOTION_HPP
