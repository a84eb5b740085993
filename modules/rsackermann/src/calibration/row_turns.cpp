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
      startUnit(unit), interval(interval_), middle(0), middleOfNow(0), isGyro(isGyro_)
{
    for (const TrackedBearing& point : bearings)
        middle += point.timeNow / double(bearings.size());
    middleOfNow = seconds + alignment.delay + unit * middle;
    // Line delays that are tried may be longer.
    const RowSpan rows(camera);
    const double readOut = rows.to - rows.from;
    if (!samples_.covers(middleOfNow - interval - readOut, middleOfNow + readOut))
        return;
    samples = &samples_;
    ofFrame = turned(middleOfNow - interval, middleOfNow);
}

Vec3d RowTurns::turned(double begin, double end) const
{
    Vec3d angle;
    samples->turn(begin, end, angle);
    return toUpright * alignment.toCamera(angle, end - begin);
}

void RowTurns::delayBy(double seconds)
{
    alignment.delay += seconds;
    middleOfNow += seconds;
    ofFrame = turned(middleOfNow - interval, middleOfNow);
}

// That of the yaw rate, which turns rows in the fit.
Vec3d RowTurns::steadyTurn(double after) const
{
    return Vec3d(0, ofFrame[1] * after / interval, 0);
}

Vec3d RowTurns::unsteadyTurn(double after) const
{
    return turned(middleOfNow, middleOfNow + after) - steadyTurn(after);
}

// A bearing as the middle row of its frame has it.
Point2d RowTurns::atMiddle(const Point2d& p, double middleOfFrame, double after) const
{
    const Vec3d turn = (turned(middleOfFrame, middleOfFrame + after) - steadyTurn(after)).mul(share),
                bearing(p.x, p.y, 1), seen = bearing + turn.cross(bearing);
    return Point2d(seen[0] / seen[2], seen[1] / seen[2]);
}

TrackedBearing RowTurns::removedFrom(const TrackedBearing& point, double unit) const
{
    if (!samples)
        return point;
    const double seconds = isGyro ? unit : startUnit, rowOfOther = point.timeOther + interval / givenUnit;
    TrackedBearing result = point;
    result.now = atMiddle(point.now, middleOfNow, seconds * (point.timeNow - middle));
    result.other = atMiddle(point.other, middleOfNow - interval, seconds * (rowOfOther - middle));
    return result;
}

UprightSegment RowTurns::removedFrom(const UprightSegment& vertical, double unit) const
{
    if (!samples)
        return vertical;
    const double seconds = isGyro ? unit : startUnit;
    const auto seen = [&](const Vec3d& end, double time) {
        const Point2d p = atMiddle(Point2d(end[0], end[1]), middleOfNow, seconds * (time - middle));
        return Vec3d(p.x, p.y, 1);
    };
    UprightSegment result = vertical;
    result.u = seen(vertical.u, vertical.timeU);
    result.v = seen(vertical.v, vertical.timeV);
    return result;
}

}} // namespace cv::rsackermann
