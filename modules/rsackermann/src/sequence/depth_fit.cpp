// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/lens.hpp"
#include "../motion/contradiction.hpp"
#include "../motion/metric_way.hpp"
#include "../optim/levenberg_marquardt.hpp"
#include "../optim/normal_equations.hpp"
#include "../scene/inverse_depth_offset.hpp"
#include "../scene/planes.hpp"
#include "../single/depth_alignment.hpp"
#include "../single/relative_depth.hpp"
#include "frame_terms.hpp"
#include "residual_noise.hpp"
#include "scene_fit.hpp"

namespace cv { namespace rsackermann {

namespace {

// A point with the depth map's values where it is seen.
struct DeepPoint
{
    TrackedBearing bearing;
    bool isEven;    // one half of the points is, wherever they are
    double axial;   // depth along the optical axis over that of the upright frame of the fit
    double value;   // median of the window that was tracked
    double ofPixel; // what maps take
};

std::vector<DeepPoint> deepPoints(const RollingShutterCamera& camera, const std::vector<TrackedBearing>& bearings,
                                  const double* values, const DepthMap& depth)
{
    const Lens<double> lens(camera);
    const FlowResidual flow(camera);
    const Matx33d tilt = tiltOf(values);
    const double reach = PointTracker::reach(camera.imageSize, COARSE_PIXELS);
    std::vector<DeepPoint> points;
    for (const TrackedBearing& b : withoutOwnCar(camera, bearings, values))
    {
        const Vec3d bearing(b.now.x, b.now.y, 1), ray = camera.uprightRotation.t() * bearing;
        const double ahead = (tilt * bearing)[2];
        Point2d pixel;
        if (!(ray[2] > IN_FRONT && ahead > IN_FRONT) ||
            !lens.project(ray[0] / ray[2], ray[1] / ray[2], pixel.x, pixel.y))
            continue;
        const bool isEven = (cvRound(pixel.x) + cvRound(pixel.y)) % 2 == 0;
        const DeepPoint p = {b, isEven, ray[2] / ahead, RelativeDepth::medianAround(depth, pixel, reach),
                             RelativeDepth::valueAt(depth, pixel)};
        if (std::isfinite(p.value) && !FlowResidual::isBehind(flow.evaluate(b, values, 0)))
            points.push_back(p);
    }
    return points;
}

// What is known of the scale of a depth without the points: of a relative one nothing, of one in metres the way of the
// car, and that there is no shift.
struct GivenScale
{
    double scale = 0, sigma = std::numeric_limits<double>::infinity();
    bool isMetric;

    GivenScale(const RollingShutterCamera& camera, const AckermannMotion& motion, const DepthMap& depth)
        : isMetric(depth.kind == DEPTH_METRIC)
    {
        if (!isMetric)
            return;
        scale = std::abs(wayPerUnitTime(camera, motion));
        sigma = wayPerUnitTimeSigma(camera, motion, depth);
    }
};

// Values of a standard deviation of 1, whatever their unit is: from their mean, or from 0 if no shift is unknown.
struct Standard
{
    double mean = 0, sigma = 0;

    Standard(const std::vector<DeepPoint>& points, bool isShifted)
    {
        double squares = 0;
        for (const DeepPoint& p : points)
            mean += isShifted ? p.value / double(points.size()) : 0;
        for (const DeepPoint& p : points)
            squares += (p.value - mean) * (p.value - mean) / double(points.size());
        sigma = std::sqrt(squares);
    }

    double of(double value) const { return (value - mean) / sigma; }
};

// Minus twice the logarithm of the likelihood of a residual.
double lossOf(const Point2d& residual, double sigma)
{
    return CauchyLoss(1, 1 / DEPENDENCE).cost(residual.dot(residual) / (sigma * sigma));
}

// The turns between frames, and inverse depths that are linear in the standardised values.
enum { D_YAW_RATE, D_TURNS, D_SCALE = D_TURNS + FLOW_VALUES - SEQUENCE_VALUES, D_SHIFT, UNKNOWNS };

// The points and what is known without them, as minimize() takes it.
class DepthProblem
{
public:
    typedef NormalEquations<UNKNOWNS> Equations;
    typedef Equations::Vector State;
    typedef State Step;

    DepthProblem(const RollingShutterCamera& camera, const std::vector<DeepPoint>& points_, const GivenScale& given_,
                 const SequenceFit& planes_)
        : points(points_), given(given_), standard(points, !given.isMetric),
          sign(planes_.values[SEQUENCE_SPEED] < 0 ? -1 : 1), scale(1), flow(camera), planes(planes_),
          unit(camera.secondsPerUnitTime()), weights(points.size(), Matx22d::eye() * (1 / POINT_SIGMA))
    {
    }

    // By the noise that the points show, as in the fit of a frame.
    void weigh(const State& u)
    {
        const double way = planes.values[SEQUENCE_SPEED] * unit;
        std::vector<Point2d> weak, residuals, byDeviation;
        for (const DeepPoint& p : points)
        {
            Eigen::Matrix<double, UNKNOWNS, 2> J;
            weak.push_back(p.bearing.weak);
            residuals.push_back(residual(u, p, p.value, &J));
            byDeviation.push_back(way * DEVIATION_SIGMA * Point2d(J(D_SHIFT, 0), J(D_SHIFT, 1)));
        }
        const PointNoise noise = noiseOf(weak, residuals, byDeviation);
        pointSigma = POINT_SIGMA * noise.points;
        weights = weightsOf(noise, weak, byDeviation);
    }

    // That of the planes, and everything infinitely far away unless the scale is given.
    State start() const
    {
        State u = State::Zero();
        u[D_SCALE] = sign * standard.sigma * given.scale;
        u[D_YAW_RATE] = planes.values[SEQUENCE_YAW_RATE];
        std::copy(planes.values + SEQUENCE_VALUES, planes.values + FLOW_VALUES, &u[D_TURNS]);
        return u;
    }

    void evaluate(const State& u, Equations& equations) const
    {
        equations = Equations();
        const SequenceState& before = planes.prediction;
        equations.addPrior(D_YAW_RATE, u[D_YAW_RATE] - before.value[SEQUENCE_YAW_RATE],
                           std::sqrt(before.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE)));
        for (int i = SEQUENCE_VALUES; i < FLOW_VALUES; i++)
        {
            const int k = D_TURNS + i - SEQUENCE_VALUES;
            equations.addPrior(k, u[k], i == FLOW_YAW_CHANGE ? planes.yawGrowthSigma : TURN_SIGMA);
        }
        equations.addPrior(D_SCALE, u[D_SCALE] - sign * standard.sigma * given.scale, standard.sigma * given.sigma);
        if (given.isMetric) // a rounding error, so that the equations stay regular
            equations.addPrior(D_SHIFT, u[D_SHIFT], standard.sigma * given.scale * FLT_EPSILON);
        const CauchyLoss loss(scale, 1 / DEPENDENCE);
        for (size_t i = 0; i < points.size(); i++)
        {
            Eigen::Matrix<double, UNKNOWNS, 2> J;
            const Point2d r = residual(u, points[i], points[i].value, &J);
            const Eigen::Map<const Eigen::Matrix2d> weight(weights[i].val);
            const Eigen::Vector2d weighed = weight * Eigen::Vector2d(r.x, r.y);
            if (FlowResidual::isBehind(r))
                equations.cost += loss.cost(weighed.squaredNorm());
            else
                equations.add((J * weight).eval(), weighed, loss);
        }
    }

    static State moved(const State& u, const Step& step) { return u + step; }
    static bool allows(const State&) { return true; }

    // In pixels, with a value of the depth map.
    Point2d residual(const State& u, const DeepPoint& p, double value, Eigen::Matrix<double, UNKNOWNS, 2>* J = 0) const
    {
        double values[FLOW_VALUES], byValues[2 * FLOW_VALUES];
        std::copy(planes.values, planes.values + FLOW_VALUES, values);
        values[SEQUENCE_YAW_RATE] = u[D_YAW_RATE];
        std::copy(&u[D_TURNS], &u[D_TURNS] + FLOW_VALUES - SEQUENCE_VALUES, values + SEQUENCE_VALUES);
        const FlowResidual::Values at(values);
        FlowResidual::View view = flow.predict(p.bearing, at);
        view.inverseDepth = p.axial * (u[D_SCALE] * standard.of(value) + u[D_SHIFT]);
        Point2d byInverseDepth;
        const Point2d r = flow.residualOf(p.bearing, at, view, &byInverseDepth);
        if (!J)
            return r;
        flow.evaluate(p.bearing, at, byValues);
        for (int axis = 0; axis < 2; axis++)
        {
            const double *by = byValues + axis * FLOW_VALUES, byDepth = axis == 0 ? byInverseDepth.x : byInverseDepth.y;
            (*J)(D_YAW_RATE, axis) = by[SEQUENCE_YAW_RATE];
            std::copy(by + SEQUENCE_VALUES, by + FLOW_VALUES, &(*J)(D_TURNS, axis));
            (*J)(D_SCALE, axis) = byDepth * p.axial * standard.of(value);
            (*J)(D_SHIFT, axis) = byDepth * p.axial;
        }
        return r;
    }

    bool contradictsGivenScale(const State& u) const
    {
        return std::abs(sign * u[D_SCALE] / standard.sigma - given.scale) > CONTRADICTION * given.sigma;
    }

    // Minus twice the logarithms of the points' likelihoods.
    std::vector<double> losses(const State& u) const
    {
        std::vector<double> result;
        for (const DeepPoint& p : points)
            result.push_back(lossOf(residual(u, p, p.value), pointSigma));
        return result;
    }

    const std::vector<DeepPoint>& points;
    const GivenScale given;
    const Standard standard;
    const double sign;               // of inverse depths, by which way the car drives
    double scale;                    // of the loss, in sigmas
    double pointSigma = POINT_SIGMA; // pixels, of what a depth doesn't explain

private:
    const FlowResidual flow;
    const SequenceFit& planes;
    const double unit;
    std::vector<Matx22d> weights;
};

// What planes and offset leave of points that the offset wasn't fitted to: it is made of as many numbers as a fifth of
// the points that it is fitted to. As losses(), with the same standard deviation.
std::vector<double> lossesOfPlanes(const RollingShutterCamera& camera, const std::vector<DeepPoint>& points,
                                   const double* values, AckermannMotion motion, double sigma)
{
    const FlowResidual flow(camera);
    const Scene scene(motion);
    const Matx33d turn = motion.uprightRotation(camera) * (tiltOf(values) * camera.uprightRotation).t();
    std::vector<double> losses(points.size());
    for (const bool isFitted : {false, true})
    {
        std::vector<TrackedBearing> fitted;
        for (const DeepPoint& p : points)
            if (p.isEven == isFitted)
                fitted.push_back(p.bearing);
        motion.inverseDepthOffset.release();
        fitOffset(camera, fitted, values, motion);
        const InverseDepthOffset offset(motion);
        for (size_t i = 0; i < points.size(); i++)
        {
            const DeepPoint& p = points[i];
            if (p.isEven == isFitted)
                continue;
            FlowResidual::View view = flow.predict(p.bearing, values);
            const Vec3d seen = turn * (view.ray + view.inverseDepth * view.place);
            view.inverseDepth = scene.inverseDepth(seen) + offset.at(seen);
            losses[i] = lossOf(flow.residualOf(p.bearing, values, view), sigma);
        }
    }
    return losses;
}

// By how many standard deviations losses exceed others [vuong1989].
double excessInSigmas(const std::vector<double>& losses, const std::vector<double>& others)
{
    double sum = 0, squares = 0;
    for (size_t i = 0; i < losses.size(); i++)
    {
        const double more = losses[i] - others[i];
        sum += more;
        squares += more * more;
    }
    const double variance = DEPENDENCE * std::max(squares - sum * sum / double(losses.size()), 0.);
    return sum / std::sqrt(variance + DBL_MIN);
}

} // namespace

bool fitDepth(const RollingShutterCamera& camera, const std::vector<TrackedBearing>& bearings,
              const SequenceFit& planes, const AckermannMotion& motion, DepthMap& depth, DepthFit& found)
{
    if (depth.kind == DEPTH_METRIC && !(isMetric(camera, motion) && wayPerUnitTime(camera, motion) != 0))
        return false;
    const std::vector<DeepPoint> points = deepPoints(camera, bearings, planes.values, depth);
    DepthProblem problem(camera, points, GivenScale(camera, motion, depth), planes);
    const Standard& standard = problem.standard;
    found.points = points.size();
    if (points.size() < LEAST_POINTS || !(standard.sigma > 0))
        return false;
    DepthProblem::State u = problem.start();
    DepthProblem::Equations equations;
    for (double s : POINT_SCALES)
    {
        problem.scale = s;
        minimize(problem, MinimizerOptions(STEPS, 1e-3), u, equations);
    }
    problem.weigh(u);
    minimize(problem, MinimizerOptions(STEPS, 1e-3), u, equations);
    const double scale = problem.sign * u[D_SCALE] / standard.sigma,
                 shift = problem.sign * u[D_SHIFT] - scale * standard.mean;
    if (!(scale >= FLT_MIN && scale <= FLT_MAX && std::abs(shift) <= FLT_MAX) || problem.contradictsGivenScale(u) ||
        !(excessInSigmas(problem.losses(u), lossesOfPlanes(camera, points, planes.values, motion, problem.pointSigma)) <
          LEAST_IN_COMMON))
        return false;
    ResidualShare share;
    for (const DeepPoint& p : points)
        share.add(p.bearing, norm(problem.residual(u, p, std::isfinite(p.ofPixel) ? p.ofPixel : p.value)),
                  camera.cameraMatrix(0, 0));
    found.scale = scale;
    found.shift = shift;
    found.yawRate = u[D_YAW_RATE];
    found.residual = share.value();
    const DepthProblem::Equations::Matrix covariance =
        scaledInverse<DepthProblem::Equations::Matrix>(equations.symmetric());
    const int kept[] = {D_YAW_RATE, D_SCALE, D_SHIFT};
    Matx33d ofStandard;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            ofStandard(i, k) = covariance(kept[i], kept[k]);
    const Matx33d J =
        problem.sign * Matx33d(problem.sign, 0, 0, 0, 1 / standard.sigma, 0, 0, -standard.mean / standard.sigma, 1);
    found.covariance = J * ofStandard * J.t();
    if (depth.kind == DEPTH_METRIC)
    {
        depth.scale *= problem.given.scale / scale;
        return true;
    }
    depth.scale = scale;
    depth.shift = shift;
    return true;
}

}} // namespace cv::rsackermann
