// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "residual_noise.hpp"
#include "../factors/robust_losses.hpp"
#include "../motion/contradiction.hpp"

namespace cv { namespace rsackermann {

static Matx22d square(const Point2d& p)
{
    return Matx22d(p.x * p.x, p.x * p.y, p.x * p.y, p.y * p.y);
}

// Of the tracker across an edge, of which it is that part that the residuals show.
static double trackingSigma(double points)
{
    return std::min(POINT_SIGMA * points, TRACKING_SIGMA);
}

Matx22d PointNoise::weight(const Point2d& weak, const Point2d& d) const
{
    const double variance = POINT_SIGMA * points * POINT_SIGMA * points;
    const Point2d along = trackingSigma(points) * weak, deviation = depths * d;
    const Matx22d covariance = variance * Matx22d::eye() + square(along) + square(deviation);
    // By the theorem of Cayley and Hamilton, with a determinant that long vectors don't cancel
    const double trace = cv::trace(covariance), across = along.cross(deviation),
                 root = std::sqrt(variance * (trace - variance) + across * across);
    return ((trace + root) * Matx22d::eye() - covariance) * (1 / (root * std::sqrt(trace + 2 * root)));
}

void PointResiduals::add(const Point2d& residual, const Point2d& weak, const Point2d& d)
{
    const double length = norm(d);
    if (!(length > 0))
        return;
    across.push_back({std::abs(residual.cross(d)) / length, weak.cross(d) / length});
    along.push_back({std::abs(residual.dot(d)) / length, length});
    weakAlong.push_back(weak.dot(d) / length);
}

PointNoise PointResiduals::noise(double least) const
{
    PointNoise result = {1, 1};
    if (across.empty())
        return result;
    const auto sigmaOf = [](double points, double weak) {
        return std::hypot(POINT_SIGMA * points, trackingSigma(points) * weak);
    };
    result.points = std::max(least, solveScale(across, sigmaOf));
    std::vector<UncertainResidual> inSigmas;
    for (size_t i = 0; i < along.size(); i++)
    {
        const double sigma = sigmaOf(result.points, weakAlong[i]);
        inSigmas.push_back({along[i].value / sigma, along[i].by / sigma});
    }
    result.depths = solveScale(inSigmas, [](double depths, double by) { return std::hypot(1, depths * by); });
    return result;
}

Point2d pixelsOfDeviation(const FlowResidual& residual, const TrackedBearing& point, const FlowResidual::Values& values,
                          double unit, const FlowResidual::View& view)
{
    Point2d byInverseDepth;
    residual.residualOf(point, values, view, &byInverseDepth);
    return values[SEQUENCE_SPEED] * unit * DEVIATION_SIGMA * view.ray[2] * byInverseDepth;
}

PointNoise noiseOf(const std::vector<Point2d>& weak, const std::vector<Point2d>& residuals,
                   const std::vector<Point2d>& d)
{
    PointResiduals seen;
    for (size_t i = 0; i < residuals.size(); i++)
        if (!FlowResidual::isBehind(residuals[i]))
            seen.add(residuals[i], weak[i], d[i]);
    return seen.noise(LEAST_NOISE);
}

std::vector<Matx22d> weightsOf(const PointNoise& noise, const std::vector<Point2d>& weak, const std::vector<Point2d>& d)
{
    std::vector<Matx22d> weights;
    for (size_t i = 0; i < d.size(); i++)
        weights.push_back(noise.weight(weak[i], d[i]));
    return weights;
}

void Neighbours::add(const Point2d& place, const Vec2d& residual, const Point2d& d)
{
    const double length = norm(d);
    if (!(length > 0) || !(norm(residual) < CONTRADICTION))
        return;
    places.push_back(place);
    along.push_back(residual.dot(Vec2d(d.x, d.y)) / length);
    across.push_back(residual.dot(Vec2d(-d.y, d.x)) / length);
}

double Neighbours::dependence() const
{
    double squares = 0, products = 0;
    for (size_t i = 0; i < places.size(); i++)
    {
        squares += along[i] * along[i];
        for (size_t j = 0; j < i; j++)
        {
            const Point2d away = places[i] - places[j];
            if (away.dot(away) < reach * reach)
                products += along[i] * along[j] - across[i] * across[j];
        }
    }
    return DEPENDENCE * std::max(1., (squares + 2 * products) / std::max<double>(double(places.size()), 1));
}

}} // namespace cv::rsackermann
