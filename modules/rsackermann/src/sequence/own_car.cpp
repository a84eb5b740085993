// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "frame_terms.hpp"

namespace cv { namespace rsackermann {

std::vector<TrackedBearing> withoutOwnCar(const RollingShutterCamera& camera,
                                          const std::vector<TrackedBearing>& bearings, const double* values)
{
    const FlowResidual residual(camera);
    const FlowResidual::Values at(values);
    std::vector<TrackedBearing> kept;
    for (size_t i = 0; i < bearings.size(); i++)
    {
        const Point2d r = residual.evaluate(bearings[i], at, 0) / POINT_SIGMA;
        if (!isOfOwnCar(bearings[i], r.dot(r)))
            kept.push_back(bearings[i]);
    }
    return kept;
}

std::vector<TrackedBearing> aboveOwnCar(const std::vector<TrackedBearing>& bearings, double focal, double& cost)
{
    std::vector<TrackedBearing> lowest;
    for (const TrackedBearing& s : bearings)
        if (s.now.y > 0)
            lowest.push_back(s);
    std::sort(lowest.begin(), lowest.end(),
              [](const TrackedBearing& a, const TrackedBearing& b) { return a.now.y > b.now.y; });
    int ahead = 0, most = 0; // by how many those that stand still are more than those that don't
    double edge = std::numeric_limits<double>::infinity();
    for (const TrackedBearing& s : lowest)
    {
        ahead += s.isStill ? 1 : -1;
        if (ahead > most)
        {
            most = ahead;
            edge = s.now.y;
        }
    }
    // One more unknown than without it (Bayesian information criterion).
    cost = std::log(double(bearings.size()));
    if (most < int(LEAST_POINTS))
        return bearings;
    const CauchyLoss loss(1, 1 / DEPENDENCE);
    std::vector<TrackedBearing> above;
    for (const TrackedBearing& s : bearings)
    {
        const Point2d moved = focal / POINT_SIGMA * (s.now - s.other);
        if (s.isStill && s.now.y >= edge)
            cost += loss.cost(moved.dot(moved));
        else
            above.push_back(s);
    }
    return above;
}

}} // namespace cv::rsackermann
