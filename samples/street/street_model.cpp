// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "street_model.hpp"

namespace rsackermann_samples {

using namespace cv::rsackermann;

RollingShutterCamera libraryCamera(const street::StreetCamera& camera)
{
    RollingShutterCamera result(camera.size, cv::Matx33d(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1),
                                camera.lens);
    result.lineDelay = camera.lineDelay;
    result.scanDirection = camera.scan;
    result.referenceRow = camera.reference;
    result.setRollPitch(camera.roll, camera.pitch);
    result.heading = camera.heading;
    result.height = camera.height;
    return result;
}

AckermannMotion libraryMotion(const street::StreetCamera& camera, const street::StreetScene& scene)
{
    MetricMotion metric;
    metric.yawRate = scene.yawRate;
    metric.speed = scene.speed;
    metric.leftDistance = scene.left;
    metric.rightDistance = scene.right;
    metric.wallDirection = scene.wallDirection;
    return AckermannMotion::fromMetric(libraryCamera(camera), metric);
}

} // namespace rsackermann_samples
