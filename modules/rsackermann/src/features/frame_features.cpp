// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/lens.hpp"
#include "frame_features.hpp"

namespace cv { namespace rsackermann {

void addBearings(const RollingShutterCamera& camera, const std::vector<PointPair>& pairs, double seconds,
                 std::vector<TrackedBearing>& bearings)
{
    const double unit = camera.secondsPerUnitTime();
    if (!(unit > 0))
        return;
    std::vector<Point2d> pixels;
    for (size_t i = 0; i < pairs.size(); i++)
    {
        pixels.push_back(pairs[i].other);
        pixels.push_back(pairs[i].now);
    }
    const std::vector<Vec3d> rays = bearingsOf(camera, camera.uprightRotation, pixels);
    // How the axes are turned; a lens hardly does it.
    const Matx22d turn = camera.uprightRotation.get_minor<2, 2>(0, 0);
    for (size_t i = 0; i < pairs.size(); i++)
    {
        const Vec3d &a = rays[2 * i], &b = rays[2 * i + 1];
        if (!(a[2] > IN_FRONT && b[2] > IN_FRONT))
            continue;
        const TrackedBearing s = {Point2d(a[0] / a[2], a[1] / a[2]),
                                  Point2d(b[0] / b[2], b[1] / b[2]),
                                  camera.rowTime(pixels[2 * i]) - seconds / unit,
                                  camera.rowTime(pixels[2 * i + 1]),
                                  seconds > 0 ? FLOW_PITCH_BEFORE : FLOW_PITCH_AFTER,
                                  seconds > 0 ? FLOW_ROLL_BEFORE : FLOW_ROLL_AFTER,
                                  norm(pairs[i].now - pairs[i].other) < POINT_SIGMA,
                                  turn * pairs[i].weak};
        if (std::abs(s.timeNow - s.timeOther) > FLT_EPSILON)
            bearings.push_back(s);
    }
}

void FrameFeatures::reset()
{
    tracker.reset();
    fineTracker.reset();
    keptSeconds = std::numeric_limits<double>::quiet_NaN();
}

void FrameFeatures::setPoints(const RollingShutterCamera& camera, const std::vector<PointPair>& tracked, double passed)
{
    reset();
    bearings.clear();
    addBearings(camera, tracked, passed, bearings);
}

FrameFeatures::Link FrameFeatures::track(const RollingShutterCamera& camera, const GrayFrame& frame, double passed,
                                         const FramePrediction& predict, const GrayFrame& next)
{
    bearings.clear();
    fineBearings.clear();
    if (frame.gray.empty())
    {
        reset(); // images before it aren't those before the next one
        return FOLLOWS;
    }
    const double ahead = next.seconds - frame.seconds;
    const bool hasNext = !next.gray.empty() && ahead != 0 && std::abs(ahead) < LONGEST_INTERVAL,
               isFine = hasNext && frame.gray.total() > COARSE_PIXELS; // in small images it would be the same points
    tracker.set(frame.gray, frame.scale);
    bool isSameScene = find(camera, tracker, PointTracker::NEIGHBOUR, passed, predict.known, predict, bearings);
    const Link link = bridge(camera, frame, passed, predict);
    if (isFine) // a recorded drive has the time for it
        fineTracker.set(frame.gray, frame.scale);
    else
        fineTracker.reset();
    if (isFine && link != BRIDGED) // the turns of the fit are those to one frame
        find(camera, fineTracker, PointTracker::NEIGHBOUR, passed, predict.known, predict, fineBearings);
    if (!hasNext)
        return link;
    const FramePrediction::Function known =
        link == BRIDGED ? predict.knownKept : (isSameScene ? predict.known : FramePrediction::Function());
    tracker.setNext(next.gray);
    find(camera, tracker, PointTracker::NEIGHBOUR, -ahead, known, predict, bearings);
    if (isFine)
    {
        fineTracker.setNext(next.gray);
        find(camera, fineTracker, PointTracker::NEIGHBOUR, -ahead, known, predict, fineBearings);
    }
    return link;
}

static bool isBefore(const TrackedBearing& b)
{
    return b.pitch == FLOW_PITCH_BEFORE;
}

void FrameFeatures::putBack(const RollingShutterCamera& camera, double passed, double seconds)
{
    for (std::vector<TrackedBearing>* all : {&bearings, &fineBearings})
        for (TrackedBearing& b : *all)
            if (isBefore(b) == (passed > 0))
                b.timeOther -= seconds / camera.secondsPerUnitTime();
}

void FrameFeatures::leaveOut(double seconds)
{
    const auto isOfThat = [=](const TrackedBearing& b) { return isBefore(b) == (seconds > 0); };
    for (std::vector<TrackedBearing>* all : {&bearings, &fineBearings})
        all->erase(std::remove_if(all->begin(), all->end(), isOfThat), all->end());
}

bool FrameFeatures::isFirstOfScene() const
{
    return SAME_SCENE * tracker.pointCount() > LEAST_POINTS &&
           size_t(std::count_if(bearings.begin(), bearings.end(), isBefore)) < LEAST_POINTS;
}

PointPredictions FramePrediction::at(double seconds, const Function& ofScene) const
{
    PointPredictions result;
    const auto add = [&](const Function& f) {
        if (f)
            result.all.insert(result.all.begin(), [f, seconds](const Point2d& now) { return f(now, seconds); });
    };
    add(usual);
    if (ofScene)
    {
        add(ofScene);
        result.enough = SAME_SCENE;
    }
    return result;
}

// Adds the points, and returns whether they are those of the same scene: between frames of different scenes some find
// something that looks like them.
bool FrameFeatures::find(const RollingShutterCamera& camera, PointTracker& points, PointTracker::Other other,
                         double seconds, const FramePrediction::Function& known, const FramePrediction& predict,
                         std::vector<TrackedBearing>& found)
{
    points.track(other, pairs, predict.at(seconds, known));
    bool isSameScene = pairs.size() >= SAME_SCENE * points.pointCount();
    if (!isSameScene || !known)
        isSameScene |= findMore(camera, points, other, seconds, predict);
    if (isSameScene)
        addBearings(camera, pairs, seconds, found);
    return isSameScene;
}

FramePrediction::Shown FrameFeatures::show(const RollingShutterCamera& camera, double seconds,
                                           const FramePrediction& predict) const
{
    std::vector<TrackedBearing> found;
    addBearings(camera, pairs, seconds, found);
    return predict.shown && found.size() >= LEAST_POINTS ? predict.shown(found) : FramePrediction::Shown();
}

// Few points may show where the others are. Returns whether as many agree as the least of a scene that is found at
// once.
bool FrameFeatures::findMore(const RollingShutterCamera& camera, PointTracker& points, PointTracker::Other other,
                             double seconds, const FramePrediction& predict)
{
    FramePrediction::Shown shown = show(camera, seconds, predict);
    if (!shown.function)
        return false;
    std::vector<PointPair> before;
    double agreeing = 0;
    for (; shown.function && shown.agreeing > agreeing; shown = show(camera, seconds, predict))
    {
        agreeing = shown.agreeing;
        before.swap(pairs);
        PointPredictions prediction;
        prediction.all = {[&](const Point2d& now) { return shown.function(now, seconds); }};
        points.track(other, pairs, prediction);
    }
    pairs.swap(before);
    return agreeing >= SAME_SCENE * SAME_SCENE * points.pointCount();
}

// The frame before may be damaged: what isn't found in it may be in the one before that.
FrameFeatures::Link FrameFeatures::bridge(const RollingShutterCamera& camera, const GrayFrame& frame, double passed,
                                          const FramePrediction& predict)
{
    const double sinceKept = frame.seconds - keptSeconds;
    const bool isLost = bearings.size() < LEAST_POINTS,
               isKept = sinceKept != 0 && std::abs(sinceKept) < LONGEST_INTERVAL;
    Link link = isLost ? STILL_LOST : FOLLOWS;
    std::vector<TrackedBearing> found;
    if (isLost && isKept && find(camera, tracker, PointTracker::KEPT, sinceKept, predict.knownKept, predict, found) &&
        found.size() >= LEAST_POINTS)
    {
        bearings.swap(found);
        link = BRIDGED;
    }
    if (!isKept || link != STILL_LOST)
    {
        tracker.forgetKept();
        keptSeconds = std::numeric_limits<double>::quiet_NaN();
    }
    if (isLost && !isKept && tracker.keepBefore())
    {
        keptSeconds = frame.seconds - passed;
        link = LOST;
    }
    return link;
}

}} // namespace cv::rsackermann
