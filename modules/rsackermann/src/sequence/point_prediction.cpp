// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/lens.hpp"
#include "../factors/flow_residual.hpp"
#include "point_prediction.hpp"

namespace cv { namespace rsackermann {

namespace {

class Predictor
{
public:
    Predictor(const RollingShutterCamera& camera_, const SequenceState& state)
        : camera(camera_), lens(camera_), flow(camera_)
    {
        std::copy(state.value.val, state.value.val + SEQUENCE_VALUES, values);
        camera.uprightRotation = tiltOf(values) * camera.uprightRotation;
        values[SEQUENCE_ROLL] = values[SEQUENCE_PITCH] = 0;
    }

    Point2d operator()(const Point2d& raw, double seconds) const
    {
        Point2d ray, result;
        if (!unproject(lens, raw, ray))
            return raw;
        const Vec3d now = camera.uprightRotation * Vec3d(ray.x, ray.y, 1);
        if (!(now[2] > IN_FRONT))
            return raw;
        const double time = camera.rowTime(raw);
        const Point2d bearing(now[0] / now[2], now[1] / now[2]);
        const TrackedBearing point = {bearing, bearing,           time - seconds / camera.secondsPerUnitTime(),
                                      time,    FLOW_PITCH_BEFORE, FLOW_ROLL_BEFORE,
                                      false,   Point2d()};
        const Point2d moved = flow.evaluate(point, values, 0); // the residual of one that stays
        if (FlowResidual::isBehind(moved))
            return raw;
        const Point2d other = bearing + moved * (1 / camera.cameraMatrix(0, 0));
        const Vec3d there = camera.uprightRotation.t() * Vec3d(other.x, other.y, 1);
        return there[2] > IN_FRONT && lens.project(there[0] / there[2], there[1] / there[2], result.x, result.y)
                   ? result
                   : raw;
    }

private:
    RollingShutterCamera camera;
    Lens<double> lens;
    FlowResidual flow;
    double values[FLOW_VALUES] = {};
};

} // namespace

FramePrediction predictPoints(const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
                              const SequenceFilter& filter, const SequenceFilter* kept)
{
    FramePrediction result;
    if (!(camera.secondsPerUnitTime() > 0))
        return result;
    const SequenceState usual(camera, params);
    result.usual = Predictor(camera, usual);
    result.shown = [=](const std::vector<TrackedBearing>& bearings) {
        const SequenceFit fit = fitFrame(camera, bearings, std::vector<UprightSegment>(), usual, true, FitNuisances());
        FramePrediction::Shown shown;
        shown.agreeing = fit.agreeing * bearings.size();
        if (fit.moves && fit.agreeing > 0.5)
            shown.function = Predictor(camera, fit.state);
        return shown;
    };
    if (!filter.isUninitialised)
        result.known = Predictor(camera, filter.state);
    if (kept && !kept->isUninitialised)
        result.knownKept = Predictor(camera, kept->state);
    return result;
}

}} // namespace cv::rsackermann
