// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../scene/planes.hpp"
#include "../factors/segment_residuals.hpp"
#include "refinement.hpp"

namespace cv { namespace rsackermann {

static const size_t LEAST_CONTACTS = 3;

// The smallest ratio on which several agree; 0: there is none.
static double smallestAgreed(std::vector<double>& ratios)
{
    std::sort(ratios.begin(), ratios.end());
    for (size_t first = 0; first + LEAST_CONTACTS <= ratios.size(); first++)
    {
        const size_t end =
            std::upper_bound(ratios.begin() + first, ratios.end(), ratios[first] * (1 + HEIGHT_SIGMA)) - ratios.begin();
        if (end - first >= LEAST_CONTACTS)
            return ratios[first + (end - first) / 2];
    }
    return 0;
}

RoadContact findRoadContact(const RefinementProblem& problem, const Model& model, double threshold)
{
    RoadContact contact;
    const double size = std::hypot(model[P_B], model[P_D]);
    const PreparedModel prepared(model, problem.heading);
    std::vector<double> ratios[2]; // of the left and the right wall, each in its own distance
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
        const bool isLeft = wall == Scene::LEFT_WALL;
        const double w = model.direction * (isLeft ? 1 : -1) * (model[P_D] - model[P_B] * low.x);
        if (low.y > 0 && w > 0)
            ratios[isLeft ? 0 : 1].push_back(w / (size * low.y));
    }
    const bool isRight = hasRightWallOnly(model, problem.heading);
    contact.left = isRight ? 0 : smallestAgreed(ratios[0]);
    contact.right = smallestAgreed(ratios[isRight ? 0 : 1]);
    return contact;
}

}} // namespace cv::rsackermann
