// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../scene/planes.hpp"
#include "../factors/segment_residuals.hpp"
#include "refinement.hpp"

namespace cv { namespace rsackermann {

RoadLimit findRoadLimit(const RefinementProblem& problem, const Model& model, double threshold)
{
    RoadLimit limit;
    const double size = std::hypot(model[P_B], model[P_D]);
    const PreparedModel prepared(model, problem.heading);
    const bool isRightOnly = hasRightWallOnly(model, problem.heading);
    for (const UprightSegment& c : problem.verticals)
    {
        int wall;
        const double residual = problem.focal * verticalResidual(c, prepared, wall, 0) / threshold;
        if (wall != Scene::LEFT_WALL && wall != Scene::RIGHT_WALL)
            continue;
        Point2d u, v;
        compensateEnds(c, prepared, u, v);
        const Point2d& low = u.y > v.y ? u : v;
        // Of a motion along one wall that is the left one, wherever it is.
        const bool isLeft = wall == Scene::LEFT_WALL;
        const double w = model.direction * (isLeft ? 1 : -1) * (model[P_D] - model[P_B] * low.x);
        if (low.y > 0 && w > 0)
            limit.add(isRightOnly || !isLeft, w / (size * low.y), 1 / (1 + residual * residual));
    }
    return limit;
}

}} // namespace cv::rsackermann
