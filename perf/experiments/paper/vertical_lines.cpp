// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "vertical_lines.hpp"

#include <cmath>

namespace paper {

using namespace cv::rsackermann;

namespace {

HorizontalBearing horizontalBearing(const RollingShutterCamera& camera, const cv::Point2d& pixel)
{
    const cv::Matx33d& K = camera.cameraMatrix;
    const cv::Vec3d ray((pixel.x - K(0, 2)) / K(0, 0), (pixel.y - K(1, 2)) / K(1, 1), 1);
    const cv::Vec3d upright = camera.uprightRotation * ray;
    return HorizontalBearing(upright[0], upright[2]);
}

// On a wall of the scaled inverse depth D - B x.
double compensatedColumn(const HorizontalBearing& bearing, double time, double alpha, double B, double D,
                         double heading)
{
    const double yaw = 2 * alpha * time, c = std::cos(yaw), s = std::sin(yaw);
    const double N = c * bearing.x + s * bearing.z, M = c * bearing.z - s * bearing.x;
    const double chord = alpha != 0 ? std::sin(alpha * time) / alpha : time;
    const double gamma = chord * (M * std::sin(yaw / 2 + heading) - N * std::cos(yaw / 2 + heading));
    return (N + gamma * D) / (M + gamma * B);
}

} // namespace

VerticalSegment verticalSegment(const RollingShutterCamera& camera, const cv::Vec4d& ends)
{
    const cv::Point2d u(ends[0], ends[1]), v(ends[2], ends[3]);
    VerticalSegment segment;
    segment.u = horizontalBearing(camera, u);
    segment.v = horizontalBearing(camera, v);
    segment.timeU = camera.rowTime(u);
    segment.timeV = camera.rowTime(v);
    return segment;
}

double columnDifference(const VerticalSegment& segment, const MinimalSolution& motion, double heading)
{
    const double middle = (segment.u.x / segment.u.z + segment.v.x / segment.v.z) / 2;
    const bool right = motion.wallRatio > 0 && motion.wallSlope != 0 && middle > motion.wallOffset / motion.wallSlope;
    const double scale = right ? -motion.wallRatio : 1;
    const double B = scale * motion.wallSlope, D = scale * motion.wallOffset;
    return compensatedColumn(segment.u, segment.timeU, motion.alpha, B, D, heading) -
           compensatedColumn(segment.v, segment.timeV, motion.alpha, B, D, heading);
}

SolverOptions solverLimits(const RollingShutterCamera& camera, double maxYawRate, double maxSpeed, double wallDistance)
{
    SolverOptions options;
    options.heading = camera.heading;
    options.maxAlpha = maxYawRate * camera.secondsPerUnitTime() / 2;
    options.maxScaledSpeed = maxSpeed * camera.secondsPerUnitTime() / wallDistance;
    return options;
}

} // namespace paper
