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
                                  norm(pairs[i].now - pairs[i].other) < POINT_SIGMA};
        if (std::abs(s.timeNow - s.timeOther) > FLT_EPSILON)
            bearings.push_back(s);
    }
}

void FrameFeatures::reset()
{
    tracker.reset();
    fineTracker.reset();
}

void FrameFeatures::setPoints(const RollingShutterCamera& camera, const std::vector<PointPair>& tracked, double passed)
{
    reset();
    bearings.clear();
    addBearings(camera, tracked, passed, bearings);
}

void FrameFeatures::track(const RollingShutterCamera& camera, const GrayFrame& frame, double passed,
                          const FramePrediction& predict, const GrayFrame& next)
{
    bearings.clear();
    fineBearings.clear();
    if (frame.gray.empty())
        return;
    const double ahead = next.seconds - frame.seconds;
    const bool hasNext = !next.gray.empty() && ahead != 0 && std::abs(ahead) < LONGEST_INTERVAL;
    follow(camera, tracker, frame, passed, predict, hasNext ? &next : 0, bearings);
    // A recorded drive has the time for it. In small images it would be the same points.
    if (hasNext && frame.gray.total() > COARSE_PIXELS)
        follow(camera, fineTracker, frame, passed, predict, &next, fineBearings);
    else
        fineTracker.reset();
}

static bool isBefore(const TrackedBearing& b)
{
    return b.pitch == FLOW_PITCH_BEFORE;
}

void FrameFeatures::leaveOutFrameBefore()
{
    for (std::vector<TrackedBearing>* all : {&bearings, &fineBearings})
        all->erase(std::remove_if(all->begin(), all->end(), isBefore), all->end());
}

bool FrameFeatures::isFirstOfScene() const
{
    return SAME_SCENE * tracker.pointCount() > LEAST_POINTS &&
           size_t(std::count_if(bearings.begin(), bearings.end(), isBefore)) < LEAST_POINTS;
}

PointPredictions FramePrediction::at(double seconds, bool isSameScene) const
{
    PointPredictions result;
    const auto add = [&](const Function& f) {
        if (f)
            result.all.insert(result.all.begin(), [f, seconds](const Point2d& now) { return f(now, seconds); });
    };
    add(usual);
    if (isSameScene && known)
    {
        add(known);
        result.enough = SAME_SCENE;
    }
    return result;
}

// Between frames of different scenes some points find something that looks like them.
void FrameFeatures::follow(const RollingShutterCamera& camera, PointTracker& points, const GrayFrame& frame,
                           double passed, const FramePrediction& predict, const GrayFrame* next,
                           std::vector<TrackedBearing>& found)
{
    points.track(frame.gray, frame.scale, pairs, predict.at(passed, true));
    const bool isSameScene = pairs.size() >= SAME_SCENE * points.pointCount();
    if (isSameScene)
        addBearings(camera, pairs, passed, found);
    if (!next)
        return;
    points.trackNext(next->gray, pairs, predict.at(frame.seconds - next->seconds, isSameScene));
    if (pairs.size() >= SAME_SCENE * points.pointCount())
        addBearings(camera, pairs, frame.seconds - next->seconds, found);
}

}} // namespace cv::rsackermann
