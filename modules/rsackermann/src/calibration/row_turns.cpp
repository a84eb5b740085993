// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "row_turns.hpp"

namespace cv { namespace rsackermann {

RowTurns::RowTurns(const GyroSamples& samples_, const GyroAlignment& alignment_, bool isGyro_,
                   const RollingShutterCamera& camera, double unit, const std::vector<TrackedBearing>& bearings,
                   double seconds, double interval_)
    : samples(0), alignment(alignment_), toUpright(camera.uprightRotation), givenUnit(camera.secondsPerUnitTime()),
      startUnit(unit), interval(interval_), middle(0), isGyro(isGyro_)
{
    for (const TrackedBearing& point : bearings)
        middle += point.timeNow / double(bearings.size());
    now.seconds = seconds + alignment.delay + unit * middle;
    // Line delays that are tried may be many times as long.
    const RowSpan rows(camera);
    const double readOut = rows.to - rows.from;
    for (double reach = 16 * readOut; reach >= readOut && !samples; reach /= 2)
    {
        covered = Vec2d(now.seconds - interval - reach, now.seconds + reach);
        if (samples_.covers(covered[0], covered[1]))
            samples = &samples_;
    }
    if (!samples)
        return;
    delayBy(0);
}

Vec3d RowTurns::turned(const Instant& begin, const Instant& end) const
{
    return toUpright * alignment.toCamera(end.angle - begin.angle, end.seconds - begin.seconds);
}

void RowTurns::delayBy(double seconds)
{
    alignment.delay += seconds;
    now = at(now.seconds + seconds);
    before = at(now.seconds - interval);
    ofFrame = turned(before, now);
}

// That of the yaw rate, which turns rows in the fit.
Vec3d RowTurns::steadyTurn(double after) const
{
    return Vec3d(0, ofFrame[1] * after / interval, 0);
}

Vec3d RowTurns::unsteadyTurn(double after) const
{
    return turned(now, at(now.seconds + after)) - steadyTurn(after);
}

// A bearing as the middle row of its frame has it.
Point2d RowTurns::atMiddle(const Point2d& p, const Instant& middleOfFrame, double after) const
{
    const Vec3d turn = (turned(middleOfFrame, at(middleOfFrame.seconds + after)) - steadyTurn(after)).mul(share),
                bearing(p.x, p.y, 1), seen = bearing + turn.cross(bearing);
    return Point2d(seen[0] / seen[2], seen[1] / seen[2]);
}

TrackedBearing RowTurns::removedFrom(const TrackedBearing& point, double unit) const
{
    if (!samples)
        return point;
    const double seconds = isGyro ? unit : startUnit, rowOfOther = point.timeOther + interval / givenUnit;
    TrackedBearing result = point;
    result.now = atMiddle(point.now, now, seconds * (point.timeNow - middle));
    result.other = atMiddle(point.other, before, seconds * (rowOfOther - middle));
    return result;
}

UprightSegment RowTurns::removedFrom(const UprightSegment& vertical, double unit) const
{
    if (!samples)
        return vertical;
    const double seconds = isGyro ? unit : startUnit;
    const auto seen = [&](const Vec3d& end, double time) {
        const Point2d p = atMiddle(Point2d(end[0], end[1]), now, seconds * (time - middle));
        return Vec3d(p.x, p.y, 1);
    };
    UprightSegment result = vertical;
    result.u = seen(vertical.u, vertical.timeU);
    result.v = seen(vertical.v, vertical.timeV);
    return result;
}

}} // namespace cv::rsackermann
