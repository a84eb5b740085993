// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/axis_rotations.hpp"
#include "../scene.hpp"
#include "calibration_frame.hpp"
#include "drive_terms.hpp"
#include <Eigen/Cholesky>

namespace cv { namespace rsackermann {

static const double STEP = 1e-5; // of numerical derivatives, radians or relative
// Of the robust loss of slants, in sigmas. It is narrower than that of single frames: a line that leans does so in many
// frames, and those of a street don't cancel.
static const double LEANING_SCALE = 1;
enum { HEADING_COLUMN = FRAME_VALUES, DELAY_COLUMN, PASSING_COLUMN };

static Point2d rotated(const Matx33d& R, const Point2d& p)
{
    const Vec3d b = R * Vec3d(p.x, p.y, 1);
    return Point2d(b[0] / b[2], b[1] / b[2]);
}

// A sight from a camera of other tilt and line delay.
static Sight changed(const Sight& s, const Matx33d& R, double laterBefore)
{
    Sight result = s;
    result.other = rotated(R, s.other);
    result.now = rotated(R, s.now);
    result.timeOther += laterBefore;
    return result;
}

// By how much the row time between frames is larger in another unit.
static double later(double interval, double givenUnit, double unit)
{
    return interval / givenUnit - interval / unit;
}

FrameProblem::FrameProblem(const RollingShutterCamera& camera, const MountVector& mount, double pointScale,
                           const ResidualSigmas& sigmas_)
    : heading(camera.heading + mount[MOUNT_HEADING]),
      unit(camera.secondsPerUnitTime() * std::exp(mount[MOUNT_PASSING])), givenUnit(camera.secondsPerUnitTime()),
      focal(camera.cameraMatrix(0, 0)), reach(PointTracker::reach(camera.imageSize, COARSE_PIXELS)),
      turning(std::exp(mount[MOUNT_DELAY] - mount[MOUNT_PASSING])), residual(heading, unit, focal),
      turned(heading + STEP, unit, focal), slower(heading, unit * (1 + STEP), focal), pointLoss(pointScale),
      sigmas(sigmas_)
{
}

static Matx33d tilt(double roll, double pitch)
{
    return rollRotation(roll) * pitchRotation(pitch);
}

static Matx33d tilt(const FrameVector& value)
{
    return tilt(value[DRIVE_ROLL], value[DRIVE_PITCH]);
}

// The motion during the image, in which each effect has the line delay of its own.
static Model imageMotion(const FrameVector& value, double unit, double turning,
                         Matx<double, PARAMETERS, DRIVE_VALUES>* jacobian)
{
    Model m = toModel(DriveVector(value.data()), unit, jacobian);
    m[P_ALPHA] *= turning;
    if (jacobian)
        (*jacobian)(P_ALPHA, DRIVE_YAW_RATE) *= turning;
    return m;
}

PreparedModel FrameProblem::modelOf(const CalibrationFrame& frame,
                                    Matx<double, PARAMETERS, DRIVE_VALUES>* jacobian) const
{
    return PreparedModel(imageMotion(frame.value, unit, turning, jacobian), heading);
}

// Whether the surroundings of a point with which it is tracked show both a wall and the road.
bool FrameProblem::isAtFoot(const FlowResidual::View& view, const double* values) const
{
    return std::abs(view.inverseDepth - view.behind) <
           std::abs(values[DRIVE_SPEED]) * unit * values[DRIVE_ROAD] * reach / focal;
}

// Pixels by which a point is elsewhere in the other image if it is nearer than its plane by a usual deviation.
Point2d FrameProblem::byDepth(const Sight& sight, const double* values, const FlowResidual::View& view) const
{
    Point2d byInverseDepth;
    residual.miss(sight, values, view, &byInverseDepth);
    return values[DRIVE_SPEED] * unit * DEVIATION_SIGMA * view.ray[2] * byInverseDepth;
}

// By how much a vertical leans otherwise if it is nearer than its wall by a usual deviation, in usual sigmas.
double FrameProblem::slantByDepth(const UprightSegment& c, const CalibrationFrame& frame, const PreparedModel& model,
                                  const Matx<double, PARAMETERS, DRIVE_VALUES>& byValues) const
{
    const double grazing = 0.05; // of a wall as seen from the camera; there is hardly a vertical
    int plane;
    Vec<double, PARAMETERS> byParameters;
    slantInSigmas(c, model, focal, byParameters.val, plane);
    if (plane != Scene::LEFT_WALL && plane != Scene::RIGHT_WALL)
        return 0;
    const DriveVector by = byValues.t() * byParameters;
    // The inverse depth of a wall is its inverse distance times this.
    const double direction = frame.value[DRIVE_DIRECTION],
                 across = std::abs(std::sin(direction) - std::cos(direction) * 0.5 * (c.u[0] + c.v[0]));
    // The other wall has no part in it. A right wall alone has the place of the left one in the model.
    return (by[DRIVE_LEFT] + by[DRIVE_RIGHT]) * DEVIATION_SIGMA / std::max(across, grazing);
}

void FrameProblem::weigh(CalibrationFrame& frame) const
{
    const Matx33d R = tilt(frame.value);
    const double shift = later(frame.interval, givenUnit, unit);
    const double pointSigma = POINT_SIGMA * sigmas.points;
    frame.pointWeights.clear();
    for (size_t i = 0; i < frame.sights.size(); i++)
    {
        const Sight now = changed(frame.sights[i], R, shift);
        const FlowResidual::View view = residual.look(now, frame.value.data());
        if (isAtFoot(view, frame.value.data()))
        {
            frame.pointWeights.push_back(Matx22d::zeros());
            continue;
        }
        // The inverse square root of the covariance pointSigma^2 I + d d^T
        const Point2d d = sigmas.depths * byDepth(now, frame.value.data(), view);
        const double inverse = 1 / pointSigma, squared = d.dot(d),
                     less = squared > 0 ? (inverse - 1 / std::hypot(pointSigma, norm(d))) / squared : 0;
        frame.pointWeights.push_back(Matx22d(inverse - less * d.x * d.x, -less * d.x * d.y, //
                                             -less * d.x * d.y, inverse - less * d.y * d.y));
    }
    Matx<double, PARAMETERS, DRIVE_VALUES> byValues;
    const PreparedModel model = modelOf(frame, &byValues);
    frame.slantWeights.clear();
    for (size_t i = 0; i < frame.verticals.size(); i++)
    {
        const double uncertain = sigmas.depths * slantByDepth(frame.verticals[i], frame, model, byValues);
        frame.slantWeights.push_back(1 / std::hypot(sigmas.slants, uncertain));
    }
}

double FrameProblem::cost(const CalibrationFrame& frame) const
{
    const Matx33d R = tilt(frame.value);
    const double shift = later(frame.interval, givenUnit, unit);
    double points = 0, slants = 0, known = 0;
    for (size_t i = 0; i < frame.sights.size(); i++)
    {
        const Point2d r =
            frame.pointWeights[i] * residual.evaluate(changed(frame.sights[i], R, shift), frame.value.data(), 0);
        points += cauchyLoss(r.dot(r), pointLoss);
    }
    const PreparedModel model = modelOf(frame);
    for (size_t i = 0; i < frame.verticals.size(); i++)
    {
        const double r = frame.slantWeights[i] * slantInSigmas(frame.verticals[i], model, focal, 0);
        slants += cauchyLoss(r * r, LEANING_SCALE);
    }
    for (int i = 0; i < SCENE_VALUES; i++)
    {
        const double r = (frame.value[i] - frame.expected[i]) / frame.sigma[i];
        known += r * r;
    }
    known += frame.value.tail<2>().squaredNorm() / (TURN_SIGMA * TURN_SIGMA);
    return points / POINT_DEPENDENCE + slants / SLANT_DEPENDENCE + known;
}

void FrameProblem::addMisses(const CalibrationFrame& frame, std::vector<double>& across,
                             std::vector<DepthResidual>& along) const
{
    const Matx33d R = tilt(frame.value);
    const double shift = later(frame.interval, givenUnit, unit);
    for (size_t i = 0; i < frame.sights.size(); i++)
    {
        if (frame.pointWeights[i] == Matx22d::zeros())
            continue;
        const Sight now = changed(frame.sights[i], R, shift);
        const FlowResidual::View view = residual.look(now, frame.value.data());
        const Point2d d = byDepth(now, frame.value.data(), view), r = residual.miss(now, frame.value.data(), view);
        const double length = norm(d);
        if (!(length > 0))
            continue;
        const DepthResidual a = {std::abs(r.dot(d)) / length, length};
        across.push_back(std::abs(r.cross(d)) / length);
        along.push_back(a);
    }
}

void FrameProblem::addSlants(const CalibrationFrame& frame, std::vector<DepthResidual>& slants) const
{
    Matx<double, PARAMETERS, DRIVE_VALUES> byValues;
    const PreparedModel model = modelOf(frame, &byValues);
    for (size_t i = 0; i < frame.verticals.size(); i++)
    {
        const DepthResidual slant = {std::abs(slantInSigmas(frame.verticals[i], model, focal, 0)),
                                     slantByDepth(frame.verticals[i], frame, model, byValues)};
        slants.push_back(slant);
    }
}

void FrameProblem::addPoints(const CalibrationFrame& frame, Information& information, Gradient& gradient) const
{
    const double* u = frame.value.data();
    const double roll = u[DRIVE_ROLL], pitch = u[DRIVE_PITCH];
    const Matx33d R = tilt(roll, pitch), rolled = tilt(roll + STEP, pitch), pitched = tilt(roll, pitch + STEP);
    const double shift = later(frame.interval, givenUnit, unit),
                 slowerShift = later(frame.interval, givenUnit, unit * (1 + STEP));
    for (size_t i = 0; i < frame.sights.size(); i++)
    {
        const Sight &s = frame.sights[i], now = changed(s, R, shift);
        double byValues[2][FLOW_VALUES];
        const Point2d r = residual.evaluate(now, u, byValues);
        if (FlowResidual::isBehind(r))
            continue;
        const Point2d byRoll = residual.evaluate(changed(s, rolled, shift), u, 0) - r,
                      byPitch = residual.evaluate(changed(s, pitched, shift), u, 0) - r;
        const Point2d byHeading = turned.evaluate(now, u, 0) - r,
                      byPassing = slower.evaluate(changed(s, R, slowerShift), u, 0) - r;
        Eigen::Matrix<double, COLUMNS, 2> J;
        for (int k = 0; k < FRAME_VALUES; k++)
            J.row(k) << byValues[0][k], byValues[1][k];
        J.row(DRIVE_ROLL) << byRoll.x / STEP, byRoll.y / STEP;
        J.row(DRIVE_PITCH) << byPitch.x / STEP, byPitch.y / STEP;
        J.row(HEADING_COLUMN) << byHeading.x / STEP, byHeading.y / STEP;
        J.row(DELAY_COLUMN).setZero();
        J.row(PASSING_COLUMN) << byPassing.x / STEP, byPassing.y / STEP;
        const Eigen::Map<const Eigen::Matrix2d> factor(frame.pointWeights[i].val);
        const Eigen::Vector2d weighed = factor * Eigen::Vector2d(r.x, r.y);
        J = (J * factor).eval();
        const double weight = cauchyWeight(weighed.squaredNorm(), pointLoss) / POINT_DEPENDENCE;
        information.selfadjointView<Eigen::Lower>().rankUpdate(J, weight);
        gradient += weight * (J * weighed);
    }
}

void FrameProblem::addVerticals(const CalibrationFrame& frame, Information& information, Gradient& gradient) const
{
    Matx<double, PARAMETERS, DRIVE_VALUES> byValues;
    const Model motion = imageMotion(frame.value, unit, turning, &byValues);
    const PreparedModel model(motion, heading), turnedModel(motion, heading + STEP);
    const PreparedModel slowerModel(imageMotion(frame.value, unit * (1 + STEP), turning / (1 + STEP), 0), heading);
    for (size_t i = 0; i < frame.verticals.size(); i++)
    {
        const UprightSegment& c = frame.verticals[i];
        Vec<double, PARAMETERS> byParameters;
        const double r = slantInSigmas(c, model, focal, byParameters.val);
        const DriveVector by = byValues.t() * byParameters;
        Gradient J = Gradient::Zero();
        for (int k = 0; k < DRIVE_VALUES; k++)
            J[k] = by[k];
        J[HEADING_COLUMN] = (slantInSigmas(c, turnedModel, focal, 0) - r) / STEP;
        J[DELAY_COLUMN] = byParameters[P_ALPHA] * motion[P_ALPHA];
        J[PASSING_COLUMN] = (slantInSigmas(c, slowerModel, focal, 0) - r) / STEP;
        const double squared = frame.slantWeights[i] * frame.slantWeights[i],
                     weight = cauchyWeight(r * r * squared, LEANING_SCALE) * squared / SLANT_DEPENDENCE;
        information.selfadjointView<Eigen::Lower>().rankUpdate(J, weight);
        gradient += weight * r * J;
    }
}

FrameEquations FrameProblem::equations(const CalibrationFrame& frame) const
{
    Information all = Information::Zero();
    Gradient gradient = Gradient::Zero();
    addPoints(frame, all, gradient);
    addVerticals(frame, all, gradient);
    for (int i = 0; i < SCENE_VALUES; i++)
    {
        const double weight = 1 / (frame.sigma[i] * frame.sigma[i]);
        all(i, i) += weight;
        gradient[i] += weight * (frame.value[i] - frame.expected[i]);
    }
    for (int i = FLOW_PITCH_BEFORE; i <= FLOW_ROLL_BEFORE; i++)
    {
        all(i, i) += 1 / (TURN_SIGMA * TURN_SIGMA);
        gradient[i] += frame.value[i] / (TURN_SIGMA * TURN_SIGMA);
    }
    const Information full = all.selfadjointView<Eigen::Lower>();
    const Eigen::LLT<Eigen::Matrix<double, SCENE_VALUES, SCENE_VALUES>> scene(
        full.topLeftCorner<SCENE_VALUES, SCENE_VALUES>());
    const int others = FrameEquations::VALUES;
    FrameEquations e;
    e.sceneByOthers = scene.solve(full.topRightCorner<SCENE_VALUES, others>());
    e.scene = scene.solve(gradient.head<SCENE_VALUES>());
    e.information =
        full.bottomRightCorner<others, others>() - full.bottomLeftCorner<others, SCENE_VALUES>() * e.sceneByOthers;
    e.gradient = gradient.tail<others>() - full.bottomLeftCorner<others, SCENE_VALUES>() * e.scene;
    return e;
}

}} // namespace cv::rsackermann
