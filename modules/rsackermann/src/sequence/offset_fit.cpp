// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/lens.hpp"
#include "../scene/inverse_depth_offset.hpp"
#include "../scene/planes.hpp"
#include "frame_terms.hpp"
#include "residual_noise.hpp"
#include "scene_fit.hpp"
#include <Eigen/SparseCholesky>

namespace cv { namespace rsackermann {

static const double WIDEST = 2; // x and y in the upright frame up to which there are cells

namespace {

// What a point says of the scene at a place of the upright frame.
struct Deviation
{
    Point2d place;
    double along;  // residual in pixels, on the way on which its depth moves it
    double across; // and across
    double slope;  // pixels along for each unit of the offset
};

bool isInFront(const Vec3d& ray)
{
    return ray[2] > IN_FRONT;
}

Point2d toPlace(const Vec3d& ray)
{
    return Point2d(ray[0] / ray[2], ray[1] / ray[2]);
}

// The part of the upright frame that the camera sees.
Rect2d seenArea(const RollingShutterCamera& camera, const Matx33d& upright)
{
    const int steps = 16;
    const Point2d last(camera.imageSize.width - 1, camera.imageSize.height - 1);
    std::vector<Point2d> border;
    for (int i = 0; i <= steps; i++)
    {
        const Point2d at = last * (double(i) / steps);
        const Point2d sides[] = {Point2d(at.x, 0), Point2d(at.x, last.y), Point2d(0, at.y), Point2d(last.x, at.y)};
        border.insert(border.end(), sides, sides + 4);
    }
    Point2d low(WIDEST, WIDEST), high = -low;
    for (const Vec3d& ray : bearingsOf(camera, upright, border))
    {
        if (!isInFront(ray))
            continue;
        const Point2d p = toPlace(ray);
        low = Point2d(std::max(std::min(low.x, p.x), -WIDEST), std::max(std::min(low.y, p.y), -WIDEST));
        high = Point2d(std::min(std::max(high.x, p.x), WIDEST), std::min(std::max(high.y, p.y), WIDEST));
    }
    if (!(low.x < high.x && low.y < high.y))
        return Rect2d(); // nothing is ahead
    // More on each side: maps are made in squares, which may stand out.
    const Point2d added = 0.1 * (high - low);
    return Rect2d(low - added, high + added);
}

// As many cells as there are points that err independently.
Size controlCount(size_t points, const Rect2d& area)
{
    const int most = 32;
    const double cells = double(points) / DEPENDENCE, across = std::sqrt(cells * area.width / area.height);
    const int added = SplineWeights::ALONG - 1;
    return Size(added + std::min(std::max(cvRound(across), 1), most),
                added + std::min(std::max(cvRound(cells / across), 1), most));
}

std::vector<Deviation> deviationsOf(const RollingShutterCamera& camera, const std::vector<TrackedBearing>& all,
                                    const double* values, const AckermannMotion& motion)
{
    const FlowResidual residual(camera);
    const Scene scene(motion);
    const Matx33d turn = motion.uprightRotation(camera) * (tiltOf(values) * camera.uprightRotation).t();
    const std::vector<TrackedBearing> bearings = withoutOwnCar(camera, all, values);
    std::vector<Deviation> deviations;
    for (size_t i = 0; i < bearings.size(); i++)
    {
        FlowResidual::View view = residual.predict(bearings[i], values);
        const Vec3d ray = turn * (view.ray + view.inverseDepth * view.place);
        if (!isInFront(ray))
            continue;
        // The planes of the motion, which is upright, aren't quite those of the fit.
        view.inverseDepth = scene.inverseDepth(ray);
        Point2d change;
        const Point2d planes = residual.residualOf(bearings[i], values, view, &change);
        change *= ray[2];
        const double slope = norm(change);
        if (!(slope > 0)) // nor of a point that would be behind
            continue;
        deviations.push_back({toPlace(ray), change.dot(planes) / slope, change.cross(planes) / slope, slope});
    }
    return deviations;
}

// Derivatives of the points' residuals, along their ways, by the control values.
Eigen::SparseMatrix<double> slopesByControls(const std::vector<Deviation>& deviations, const Rect2d& area,
                                             const Size& controls)
{
    const int along = SplineWeights::ALONG;
    std::vector<Eigen::Triplet<double>> entries;
    for (size_t i = 0; i < deviations.size(); i++)
    {
        const SplineWeights w(area, controls, deviations[i].place);
        for (int k = 0; k < along * along; k++)
            entries.push_back(
                Eigen::Triplet<double>(int(i), (w.y.first + k / along) * controls.width + w.x.first + k % along,
                                       deviations[i].slope * w.y.weights[k / along] * w.x.weights[k % along]));
    }
    Eigen::SparseMatrix<double> slopes(int(deviations.size()), controls.area());
    slopes.setFromTriplets(entries.begin(), entries.end());
    return slopes;
}

// The control values, of the standard deviation sigma, that explain the deviations best.
Eigen::VectorXd solveControls(const std::vector<Deviation>& deviations, const Eigen::SparseMatrix<double>& slopes,
                              double sigma)
{
    const double variance = POINT_SIGMA * POINT_SIGMA;
    const int points = int(deviations.size());
    Eigen::VectorXd along(points), weights(points), values = Eigen::VectorXd::Zero(slopes.cols());
    for (int i = 0; i < points; i++)
        along[i] = deviations[i].along;
    Eigen::SparseMatrix<double> prior(slopes.cols(), slopes.cols());
    prior.setIdentity();
    prior *= 1 / (sigma * sigma);
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> solver;
    for (int k = 0; k < STEPS; k++)
    {
        const Eigen::VectorXd left = along + slopes * values;
        for (int i = 0; i < points; i++)
        {
            const double across = deviations[i].across;
            weights[i] = CauchyLoss(1).slope((left[i] * left[i] + across * across) / variance) / variance;
        }
        const Eigen::SparseMatrix<double> ofPoints = slopes.transpose() * weights.asDiagonal() * slopes,
                                          information = ofPoints + prior;
        if (k == 0)
            solver.analyzePattern(information);
        solver.factorize(information);
        values = -solver.solve(slopes.transpose() * weights.cwiseProduct(along));
    }
    return values;
}

} // namespace

void fitOffset(const RollingShutterCamera& camera, const std::vector<TrackedBearing>& bearings, const double* values,
               AckermannMotion& motion)
{
    const double sigma = DEVIATION_SIGMA * std::abs(values[SEQUENCE_SPEED]) * camera.secondsPerUnitTime();
    const std::vector<Deviation> deviations = deviationsOf(camera, bearings, values, motion);
    const Rect2d area = seenArea(camera, motion.uprightRotation(camera));
    if (deviations.size() < LEAST_POINTS || !(sigma > FLT_EPSILON) || area.empty())
        return;
    const Size controls = controlCount(deviations.size(), area);
    Eigen::VectorXd offset = solveControls(deviations, slopesByControls(deviations, area, controls), sigma);
    if (!offset.allFinite())
        return;
    motion.offsetArea = area;
    motion.inverseDepthOffset = Mat(controls, CV_64F, offset.data()).clone();
}

}} // namespace cv::rsackermann
