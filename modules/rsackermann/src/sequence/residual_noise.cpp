// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "residual_noise.hpp"

namespace cv { namespace rsackermann {

Matx22d PointNoise::weight(const Point2d& d) const
{
    // Of the covariance sigma^2 I + deviation deviation^T
    const double sigma = POINT_SIGMA * points, inverse = 1 / sigma;
    const Point2d deviation = depths * d;
    const double squared = deviation.dot(deviation),
                 less = squared > 0 ? (inverse - 1 / std::hypot(sigma, norm(deviation))) / squared : 0;
    return inverse * Matx22d::eye() - less * Matx22d(deviation.x * deviation.x, deviation.x * deviation.y,
                                                     deviation.x * deviation.y, deviation.y * deviation.y);
}

void PointResiduals::add(const Point2d& residual, const Point2d& d)
{
    const double length = norm(d);
    if (!(length > 0))
        return;
    across.push_back(std::abs(residual.cross(d)) / length);
    along.push_back({std::abs(residual.dot(d)) / length, length});
}

PointNoise PointResiduals::noise(double least) const
{
    PointNoise result = {1, 1};
    if (across.empty())
        return result;
    std::vector<double> values = across;
    const double sigma = sigmaOfMedian(medianOf(values.begin(), values.end())) / POINT_SIGMA;
    result.points = std::min(std::max(sigma, least), 1.);
    result.depths = solveScale(
        along, [&](double depths, double by) { return std::hypot(POINT_SIGMA * result.points, depths * by); });
    return result;
}

Point2d pixelsOfDeviation(const FlowResidual& residual, const TrackedBearing& point, const double* values, double unit,
                          const FlowResidual::View& view)
{
    Point2d byInverseDepth;
    residual.residualOf(point, values, view, &byInverseDepth);
    return values[SEQUENCE_SPEED] * unit * DEVIATION_SIGMA * view.ray[2] * byInverseDepth;
}

std::vector<Matx22d> weightsOf(const std::vector<Point2d>& residuals, const std::vector<Point2d>& d)
{
    PointResiduals seen;
    for (size_t i = 0; i < residuals.size(); i++)
        if (!FlowResidual::isBehind(residuals[i]))
            seen.add(residuals[i], d[i]);
    const PointNoise noise = seen.noise(LEAST_NOISE);
    std::vector<Matx22d> weights;
    for (const Point2d& deviation : d)
        weights.push_back(noise.weight(deviation));
    return weights;
}

}} // namespace cv::rsackermann
