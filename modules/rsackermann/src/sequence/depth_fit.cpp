// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/lens.hpp"
#include "../scene/inverse_depth_offset.hpp"
#include "../scene/planes.hpp"
#include "../single/relative_depth.hpp"
#include "frame_terms.hpp"
#include "scene_fit.hpp"
#include <Eigen/Dense>

namespace cv { namespace rsackermann {

namespace {

// A point with the value of the depth map where it is seen.
struct DeepPoint
{
    TrackedBearing bearing;
    FlowResidual::View view;
    double value;
    double axial; // depth along the optical axis over that of the upright frame
};

std::vector<DeepPoint> deepPoints(const RollingShutterCamera& camera, const std::vector<TrackedBearing>& bearings,
                                  const double* values, const AckermannMotion& motion, const Mat& depths)
{
    const Scene scene(motion);
    const InverseDepthOffset offset(motion);
    const Matx33d turn = motion.uprightRotation(camera) * camera.uprightRotation.t();
    const Lens<double> lens(camera);
    const FlowResidual flow(camera);
    std::vector<DeepPoint> points;
    for (const TrackedBearing& b : withoutOwnCar(camera, bearings, values))
    {
        const Vec3d ray = camera.uprightRotation.t() * Vec3d(b.now.x, b.now.y, 1);
        Point2d pixel;
        if (!(ray[2] > IN_FRONT) || !lens.project(ray[0] / ray[2], ray[1] / ray[2], pixel.x, pixel.y))
            continue;
        DeepPoint p = {b, flow.predict(b, values), RelativeDepth::valueAt(depths, pixel), ray[2]};
        const Vec3d seen = turn * (p.view.ray + p.view.inverseDepth * p.view.place);
        p.view.inverseDepth = scene.inverseDepth(seen) + offset.at(seen);
        if (std::isfinite(p.value) && !FlowResidual::isBehind(flow.residualOf(b, values, p.view)))
            points.push_back(p);
    }
    return points;
}

double costOf(const FlowResidual& flow, const std::vector<DeepPoint>& points, const double* values)
{
    double cost = 0;
    for (const DeepPoint& p : points)
    {
        const Point2d r = flow.residualOf(p.bearing, values, p.view);
        cost += CauchyLoss(1).cost(r.dot(r) / (POINT_SIGMA * POINT_SIGMA));
    }
    return cost;
}

} // namespace

bool fitDepth(const RollingShutterCamera& camera, const std::vector<TrackedBearing>& bearings, const double* values,
              const AckermannMotion& motion, DepthMap& depth)
{
    const FlowResidual flow(camera);
    std::vector<DeepPoint> points = deepPoints(camera, bearings, values, motion, depth.values);
    if (points.size() < LEAST_POINTS)
        return false;
    const double without = costOf(flow, points, values);
    Eigen::Vector2d line(0, 0); // scale and shift
    for (int step = 0; step < STEPS; step++)
    {
        Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
        Eigen::Vector2d gradient(0, 0);
        for (const DeepPoint& p : points)
        {
            Point2d slope;
            const Point2d r = flow.residualOf(p.bearing, values, p.view, &slope);
            const double weight = CauchyLoss(1).slope(r.dot(r) / (POINT_SIGMA * POINT_SIGMA));
            const Eigen::Vector2d byLine(p.axial * p.value, p.axial);
            information += weight * slope.dot(slope) * byLine * byLine.transpose();
            gradient += weight * slope.dot(p.view.inverseDepth * slope - r) * byLine;
        }
        const Eigen::LDLT<Eigen::Matrix2d> solver(information);
        line = solver.solve(gradient);
        if (solver.rcond() < DBL_EPSILON || !line.allFinite())
            return false; // all values are the same
        for (DeepPoint& p : points)
            p.view.inverseDepth = p.axial * (line[0] * p.value + line[1]);
    }
    line *= values[SEQUENCE_SPEED] < 0 ? -1 : 1;
    if (!(line[0] >= FLT_MIN && line[0] <= FLT_MAX && std::abs(line[1]) <= FLT_MAX) ||
        !(costOf(flow, points, values) < without))
        return false;
    depth.scale = line[0];
    depth.shift = line[1];
    return true;
}

}} // namespace cv::rsackermann
