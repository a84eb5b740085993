// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../scene/planes.hpp"
#include "calibration_frame.hpp"
#include "../sequence/frame_terms.hpp"

namespace cv { namespace rsackermann {

static const double STEP = std::sqrt(DBL_EPSILON); // of forward differences, radians or relative
// Of the line delay where it chooses an instant of a curve of turns, which is smooth: an hour has 13 digits of it.
static const double INSTANT_STEP = std::cbrt(DBL_EPSILON);
// Of the robust loss of slants, in sigmas. It is narrower than that of single frames: a line that leans does so in many
// frames, and those of a street don't cancel.
static const double LEANING_SCALE = 1;
enum { HEADING_COLUMN = FRAME_VALUES, LEVER_COLUMN, DELAY_COLUMN, PASSING_COLUMN, COLUMNS };

static Vec3d mapped(const Matx33d& H, const Vec3d& p)
{
    const Vec3d b = H * p;
    return b * (1 / b[2]);
}

static Point2d mapped(const Matx33d& H, const Point2d& p)
{
    const Vec3d b = mapped(H, Vec3d(p.x, p.y, 1));
    return Point2d(b[0], b[1]);
}

void CalibrationFrame::seeThroughOtherFocal(const Matx33d& upright, double longer)
{
    const double shorter = 1 / longer; // times, too, are over the focal length
    const Matx33d zoom = upright * Matx33d::diag(Vec3d(shorter, shorter, 1)) * upright.t();
    for (TrackedBearing& point : bearings)
    {
        point.other = mapped(zoom, point.other);
        point.now = mapped(zoom, point.now);
        point.timeOther *= shorter;
        point.timeNow *= shorter;
    }
    for (UprightSegment& vertical : verticals)
    {
        vertical.u = mapped(zoom, vertical.u);
        vertical.v = mapped(zoom, vertical.v);
        vertical.timeU *= shorter;
        vertical.timeV *= shorter;
    }
}

// A point from a camera of another line delay.
static TrackedBearing shifted(const TrackedBearing& s, double shiftBefore)
{
    TrackedBearing result = s;
    result.timeOther += shiftBefore;
    return result;
}

// By how much the row time between frames is larger in another unit.
static double timeShift(double interval, double givenUnit, double unit)
{
    return interval / givenUnit - interval / unit;
}

FrameProblem::FrameProblem(const RollingShutterCamera& camera, const MountVector& mount, double pointScale,
                           const ResidualSigmas& sigmas_)
    : heading(camera.heading + mount[MOUNT_HEADING]), lever(mount[MOUNT_LEVER]),
      unit(camera.secondsPerUnitTime() * std::exp(mount[MOUNT_PASSING])), givenUnit(camera.secondsPerUnitTime()),
      focal(camera.cameraMatrix(0, 0)), reach(PointTracker::reach(camera.imageSize, COARSE_PIXELS)),
      turningUnit(camera.secondsPerUnitTime() * std::exp(mount[MOUNT_DELAY])), turning(turningUnit / unit),
      pointLoss(pointScale), sigmas(sigmas_)
{
}

// The motion during the image, in which each effect has the line delay of its own.
static Model imageMotion(const FrameVector& value, double unit, double turning,
                         Matx<double, PARAMETERS, SEQUENCE_VALUES>* jacobian)
{
    Model m = toModel(SequenceVector(value.data()), unit, jacobian);
    m[P_ALPHA] *= turning;
    if (jacobian)
        (*jacobian)(P_ALPHA, SEQUENCE_YAW_RATE) *= turning;
    return m;
}

// A point of a frame from a camera of another line delay, whose rows a gyro has turned back.
TrackedBearing FrameProblem::seen(const TrackedBearing& point, const CalibrationFrame& frame) const
{
    return shifted(frame.rowTurns.removedFrom(point, turningUnit), timeShift(frame.interval, givenUnit, unit));
}

PreparedModel FrameProblem::modelOf(const CalibrationFrame& frame,
                                    Matx<double, PARAMETERS, SEQUENCE_VALUES>* jacobian) const
{
    return PreparedModel(imageMotion(frame.value, unit, turning, jacobian), headingOf(frame));
}

// Whether the surroundings of a point with which it is tracked show both a wall and the road.
bool FrameProblem::isAtFoot(const FlowResidual::View& view, const double* values) const
{
    return std::abs(view.inverseDepth - view.behind) <
           std::abs(values[SEQUENCE_SPEED]) * unit * values[SEQUENCE_ROAD] * reach / focal;
}

// By how much a vertical leans otherwise if it is nearer than its wall by a usual deviation, in usual sigmas.
double FrameProblem::slantByDepth(const UprightSegment& c, const CalibrationFrame& frame, const PreparedModel& model,
                                  const Matx<double, PARAMETERS, SEQUENCE_VALUES>& byValues) const
{
    const double grazing = 0.05; // of a wall as seen from the camera; there is hardly a vertical
    int plane;
    Vec<double, PARAMETERS> byParameters;
    slantInSigmas(c, model, focal, byParameters.val, plane);
    if (plane != Scene::LEFT_WALL && plane != Scene::RIGHT_WALL)
        return 0;
    const SequenceVector by = byValues.t() * byParameters;
    // The inverse depth of a wall is its inverse distance times this.
    const double direction = frame.value[SEQUENCE_DIRECTION],
                 across = std::abs(std::sin(direction) - std::cos(direction) * 0.5 * (c.u[0] + c.v[0]));
    // The other wall has no part in it. A right wall alone has the place of the left one in the model.
    return (by[SEQUENCE_LEFT] + by[SEQUENCE_RIGHT]) * DEVIATION_SIGMA / std::max(across, grazing);
}

void FrameProblem::weigh(CalibrationFrame& frame) const
{
    const Vec<double, FLOW_VALUES> values = flowValues(frame.value);
    const PointNoise noise = {sigmas.points, sigmas.depths};
    frame.pointWeights.clear();
    const FlowResidual residual = residualOf(frame);
    const FlowResidual::Values at(values.val);
    for (size_t i = 0; i < frame.bearings.size(); i++)
    {
        const TrackedBearing now = seen(frame.bearings[i], frame);
        const FlowResidual::View view = residual.predict(now, at);
        if (isAtFoot(view, values.val))
        {
            frame.pointWeights.push_back(Matx22d::zeros());
            continue;
        }
        frame.pointWeights.push_back(noise.weight(now.weak, pixelsOfDeviation(residual, now, at, unit, view)));
    }
    Matx<double, PARAMETERS, SEQUENCE_VALUES> byValues;
    const PreparedModel model = modelOf(frame, &byValues);
    frame.slantWeights.clear();
    for (size_t i = 0; i < frame.verticals.size(); i++)
    {
        const UprightSegment vertical = frame.rowTurns.removedFrom(frame.verticals[i], turningUnit);
        const double uncertain = sigmas.depths * slantByDepth(vertical, frame, model, byValues);
        frame.slantWeights.push_back(1 / std::hypot(sigmas.slants, uncertain));
    }
}

void FrameProblem::addPointResiduals(const CalibrationFrame& frame, PointResiduals& residuals) const
{
    const Vec<double, FLOW_VALUES> values = flowValues(frame.value);
    const FlowResidual residual = residualOf(frame);
    const FlowResidual::Values at(values.val);
    for (size_t i = 0; i < frame.bearings.size(); i++)
    {
        if (frame.pointWeights[i] == Matx22d::zeros())
            continue;
        const TrackedBearing now = seen(frame.bearings[i], frame);
        const FlowResidual::View view = residual.predict(now, at);
        residuals.add(residual.residualOf(now, at, view), now.weak, pixelsOfDeviation(residual, now, at, unit, view));
    }
}

void FrameProblem::addSlantResiduals(const CalibrationFrame& frame, std::vector<UncertainResidual>& slants) const
{
    Matx<double, PARAMETERS, SEQUENCE_VALUES> byValues;
    const PreparedModel model = modelOf(frame, &byValues);
    for (size_t i = 0; i < frame.verticals.size(); i++)
    {
        const UprightSegment vertical = frame.rowTurns.removedFrom(frame.verticals[i], turningUnit);
        slants.push_back(
            {std::abs(slantInSigmas(vertical, model, focal, 0)), slantByDepth(vertical, frame, model, byValues)});
    }
}

void FrameProblem::addPoints(const CalibrationFrame& frame, const FrameVector& value, FrameEquations& equations) const
{
    const Vec<double, FLOW_VALUES> values = flowValues(value);
    Vec<double, FLOW_VALUES> rolled = values, pitched = values;
    rolled[SEQUENCE_ROLL] += STEP;
    pitched[SEQUENCE_PITCH] += STEP;
    const double direction = headingOf(frame), curvature = frame.curvature();
    const FlowResidual residual = residualOf(frame), perturbedHeading(direction + STEP, unit, focal),
                       perturbedDelay(direction, unit * (1 + STEP), focal);
    const FlowResidual::Values u(values.val), rolledBy(rolled.val), pitchedBy(pitched.val);
    const double shift = timeShift(frame.interval, givenUnit, unit),
                 perturbedShift = timeShift(frame.interval, givenUnit, unit * (1 + STEP));
    const auto evaluatePoint = [&](const TrackedBearing& s, Eigen::Matrix<double, COLUMNS, 2>& J) {
        const TrackedBearing back = frame.rowTurns.removedFrom(s, turningUnit), now = shifted(back, shift);
        Eigen::Matrix<double, FLOW_VALUES, 2> byValues;
        const Point2d r = residual.evaluate(now, u, byValues.data());
        const auto slope = [&](const Point2d& there, double step = STEP) {
            return Eigen::RowVector2d((there.x - r.x) / step, (there.y - r.y) / step);
        };
        Eigen::RowVector2d byTurning = Eigen::RowVector2d::Zero();
        if (frame.rowTurns.showDelay())
            byTurning =
                slope(residual.evaluate(shifted(frame.rowTurns.removedFrom(s, turningUnit * (1 + INSTANT_STEP)), shift),
                                        u, 0),
                      INSTANT_STEP);
        const Eigen::RowVector2d byHeading = slope(perturbedHeading.evaluate(now, u, 0));
        J << byValues.topRows<FRAME_VALUES>(), byHeading, curvature * byHeading, byTurning,
            slope(perturbedDelay.evaluate(shifted(back, perturbedShift), u, 0));
        J.row(SEQUENCE_ROLL) = slope(residual.evaluate(now, rolledBy, 0));
        J.row(SEQUENCE_PITCH) = slope(residual.evaluate(now, pitchedBy, 0));
        return r;
    };
    rsackermann::addPoints<COLUMNS>(frame.bearings, frame.pointWeights, pointLoss, DEPENDENCE, evaluatePoint,
                                    equations);
}

void FrameProblem::addVerticals(const CalibrationFrame& frame, const FrameVector& value,
                                FrameEquations& equations) const
{
    Matx<double, PARAMETERS, SEQUENCE_VALUES> byValues;
    const Model motion = imageMotion(value, unit, turning, &byValues);
    const double direction = headingOf(frame);
    const PreparedModel model(motion, direction), perturbedHeadingModel(motion, direction + STEP),
        perturbedDelayModel(imageMotion(value, unit * (1 + STEP), turning / (1 + STEP), 0), direction);
    const auto evaluateVertical = [&](const UprightSegment& seen, Eigen::Matrix<double, COLUMNS, 1>& J) {
        const UprightSegment c = frame.rowTurns.removedFrom(seen, turningUnit);
        Vec<double, PARAMETERS> byParameters;
        const double r = slantInSigmas(c, model, focal, byParameters.val);
        const SequenceVector by = byValues.t() * byParameters;
        J.setZero();
        J.head<SEQUENCE_VALUES>() = Eigen::Map<const Eigen::Matrix<double, SEQUENCE_VALUES, 1>>(by.val);
        J[HEADING_COLUMN] = (slantInSigmas(c, perturbedHeadingModel, focal, 0) - r) / STEP;
        J[LEVER_COLUMN] = frame.curvature() * J[HEADING_COLUMN];
        J[DELAY_COLUMN] = byParameters[P_ALPHA] * motion[P_ALPHA];
        if (frame.rowTurns.showDelay())
        {
            const UprightSegment perturbed = frame.rowTurns.removedFrom(seen, turningUnit * (1 + INSTANT_STEP));
            J[DELAY_COLUMN] += (slantInSigmas(perturbed, model, focal, 0) - r) / INSTANT_STEP;
        }
        J[PASSING_COLUMN] = (slantInSigmas(c, perturbedDelayModel, focal, 0) - r) / STEP;
        return r;
    };
    rsackermann::addVerticals<COLUMNS>(frame.verticals, frame.slantWeights, LEANING_SCALE, evaluateVertical, equations);
}

FrameEquations FrameProblem::evaluate(const CalibrationFrame& frame, const FrameVector& value) const
{
    FrameEquations equations;
    addPoints(frame, value, equations);
    addVerticals(frame, value, equations);
    for (int i = 0; i < SCENE_VALUES; i++)
        equations.addPrior(i, value[i] - frame.expected[i], frame.sigma[i]);
    for (int i = FLOW_PITCH_BEFORE; i <= FLOW_ROLL_BEFORE; i++)
        equations.addPrior(i, value[i], TURN_SIGMA);
    return equations;
}

}} // namespace cv::rsackermann
