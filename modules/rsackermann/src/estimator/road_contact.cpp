// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../scene.hpp"
#include "residuals/direction_residual.hpp"
#include "road_contact.hpp"
#include "residuals/vertical_residual.hpp"

namespace cv {
namespace rsackermann {

double roadRatioFromContacts(const RefinementProblem& problem, const Model& model, double threshold)
{
    const double size = std::hypot(model[P_B], model[P_D]);
    if (!(size > 0))
        return 0;
    const PreparedModel prepared(model, problem.heading);
    std::vector<double> ratios;
    for (size_t i = 0; i < problem.verticals.size(); i++)
    {
        int wall;
        const UprightSegment& c = problem.verticals[i];
        const double r = problem.focal * verticalResidual(c, prepared, wall, 0);
        if (!(std::abs(r) < threshold) || (wall != Scene::LEFT_WALL && wall != Scene::RIGHT_WALL))
            continue;
        Point2d u, v;
        compensateEnds(c, prepared, u, v);
        const Point2d& low = u.y > v.y ? u : v;
        const double scale = wall == Scene::LEFT_WALL ? 1 : -model[P_LAMBDA];
        const double w = model.direction * scale * (model[P_D] - model[P_B] * low.x);
        const double belowHorizon = 0.02; // nearer to the horizon the ratio of small numbers says little
        if (low.y > belowHorizon && w > 0)
            ratios.push_back(w / (size * low.y));
    }
    std::sort(ratios.begin(), ratios.end());
    const double agreement = 1.06;
    const size_t enough = std::max<size_t>(3, ratios.size() / 10);
    for (size_t first = 0; first + enough <= ratios.size(); first++)
    {
        const size_t end = std::upper_bound(ratios.begin() + first, ratios.end(), ratios[first] * agreement) - ratios.begin();
        if (end - first >= enough)
            return ratios[first + (end - first) / 2];
    }
    return 0;
}

}} // namespace cv::rsackermann
