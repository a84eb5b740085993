// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../scene.hpp"
#include "residuals/direction_residual.hpp"
#include "road_contact.hpp"
#include "residuals/vertical_residual.hpp"

namespace cv { namespace rsackermann {

static const double BELOW_HORIZON = 0.02; // tangent; nearer to the horizon the ratio of small numbers says little
static const double SAME_RATIO = 1.06;    // of the largest to the smallest of the contacts that agree
static const size_t LEAST_CONTACTS = 3;
static const size_t CONTACTS_OF_ONE = 10; // one in so many has to agree

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
        if (low.y > BELOW_HORIZON && w > 0)
            ratios.push_back(w / (size * low.y));
    }
    std::sort(ratios.begin(), ratios.end());
    const size_t enough = std::max<size_t>(LEAST_CONTACTS, ratios.size() / CONTACTS_OF_ONE);
    for (size_t first = 0; first + enough <= ratios.size(); first++)
    {
        const size_t end =
            std::upper_bound(ratios.begin() + first, ratios.end(), ratios[first] * SAME_RATIO) - ratios.begin();
        if (end - first >= enough)
            return ratios[first + (end - first) / 2];
    }
    return 0;
}

}} // namespace cv::rsackermann
