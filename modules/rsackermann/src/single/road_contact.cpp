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

namespace {

// The lower end of a vertical as that of a segment of a wall.
struct WallEnd
{
    bool isRight;
    double ratio;    // distance of a wall that stands on the road there, over the height of the camera
    double residual; // pixels
};

// Those below the horizon, with the model's walls.
std::vector<WallEnd> wallEnds(const RefinementProblem& problem, const Model& model)
{
    std::vector<WallEnd> ends;
    const double size = std::hypot(model[P_B], model[P_D]);
    const PreparedModel prepared(model, problem.heading);
    const bool isRightOnly = hasRightWallOnly(model, problem.heading);
    for (size_t i = 0; i < problem.verticals.size(); i++)
    {
        int wall;
        const UprightSegment& c = problem.verticals[i];
        const double residual = problem.focal * verticalResidual(c, prepared, wall, 0);
        if (wall != Scene::LEFT_WALL && wall != Scene::RIGHT_WALL)
            continue;
        Point2d u, v;
        compensateEnds(c, prepared, u, v);
        const Point2d& low = u.y > v.y ? u : v;
        // Of a motion along one wall that is the left one, wherever it is.
        const bool isLeft = wall == Scene::LEFT_WALL;
        const double w = model.direction * (isLeft ? 1 : -1) * (model[P_D] - model[P_B] * low.x);
        const WallEnd end = {isRightOnly || !isLeft, w / (size * low.y), residual};
        if (low.y > 0 && w > 0)
            ends.push_back(end);
    }
    return ends;
}

} // namespace

RoadLimit findRoadLimit(const RefinementProblem& problem, const Model& model, double threshold)
{
    RoadLimit limit;
    for (const WallEnd& end : wallEnds(problem, model))
        limit.add(end.isRight, end.ratio, 1 / (1 + end.residual * end.residual / (threshold * threshold)));
    return limit;
}

double findRoadRatio(const RefinementProblem& problem, const Model& model, double threshold)
{
    std::vector<double> ratios[2];
    for (const WallEnd& end : wallEnds(problem, model))
        if (std::abs(end.residual) < threshold)
            ratios[end.isRight].push_back(end.ratio);
    const double right = smallestAgreed(ratios[1]);
    if (hasRightWallOnly(model, problem.heading))
        return right;
    const double left = smallestAgreed(ratios[0]), byRight = model[P_LAMBDA] * right;
    return left > 0 && byRight > 0 ? std::sqrt(left * byRight) : left + byRight;
}

}} // namespace cv::rsackermann
