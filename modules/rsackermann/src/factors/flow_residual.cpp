// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/lens.hpp"
#include "flow_residual.hpp"

namespace cv { namespace rsackermann {

static Point2d turned(const Matx33d& R, const Point2d& p)
{
    const Vec3d ray = R * Vec3d(p.x, p.y, 1);
    const double z = std::max(ray[2], IN_FRONT);
    return Point2d(ray[0] / z, ray[1] / z);
}

FlowResidual::Values::Values(const double* values)
    : u(values), cosine(std::cos(u[SEQUENCE_DIRECTION])), sine(std::sin(u[SEQUENCE_DIRECTION])), tilt(tiltOf(u))
{
}

FlowResidual::View FlowResidual::predict(const TrackedBearing& s, const Values& u) const
{
    const double alpha = u[SEQUENCE_YAW_RATE] * unit / 2, length = u[SEQUENCE_SPEED] * unit;
    const double cosine = u.cosine, sine = u.sine;
    const RowMotion now(alpha, heading, s.timeNow);
    View v;
    v.other = turned(u.tilt, s.other);
    v.now = turned(u.tilt, s.now);
    v.ray[1] = v.now.y;
    now.turn(v.now.x, 1, v.ray[0], v.ray[2]);
    v.place = Vec3d(now.tau * now.s2, 0, now.tau * now.c2);

    // The inverse depth of the nearest plane, over the speed. A camera that would have passed a wall is kept before it.
    const double across = sine * v.ray[2] - cosine * v.ray[0],
                 passed = length * (sine * v.place[2] - cosine * v.place[0]);
    const double planes[3] = {u[SEQUENCE_LEFT] * across / std::max(IN_FRONT, 1 - u[SEQUENCE_LEFT] * passed),
                              -u[SEQUENCE_RIGHT] * across / std::max(IN_FRONT, 1 + u[SEQUENCE_RIGHT] * passed),
                              u[SEQUENCE_ROAD] * v.ray[1]};
    v.plane = int(std::max_element(planes, planes + 3) - planes);
    v.inverseDepth = length * std::max(0., planes[v.plane]);
    v.behind = length * (v.plane == 2 ? std::max(0., std::max(planes[0], planes[1])) : planes[2]);
    return v;
}

Point2d FlowResidual::residualOf(const TrackedBearing& s, const Values& u, const View& v, Point2d* byInverseDepth) const
{
    const RowMotion other(u[SEQUENCE_YAW_RATE] * unit / 2, heading, s.timeOther);
    const double wayX = v.place[0] - other.tau * other.s2, wayZ = v.place[2] - other.tau * other.c2;
    const double x = v.ray[0] + v.inverseDepth * wayX, z = v.ray[2] + v.inverseDepth * wayZ;
    // By how much the other row has turned further from this one.
    const double further = halfSquare(s) * u[FLOW_YAW_CHANGE];
    const double c = other.c - further * other.s, sn = other.s + further * other.c;
    const double turnedX = c * x - sn * z, turnedZ = sn * x + c * z, behind = 1e3; // pixels
    if (byInverseDepth)
        *byInverseDepth = Point2d();
    if (!(turnedZ > IN_FRONT))
        return Point2d(behind, behind);
    const double px = turnedX / turnedZ, py = v.ray[1] / turnedZ;
    if (byInverseDepth)
    {
        const double zBy = (sn * wayX + c * wayZ) / turnedZ, xBy = (c * wayX - sn * wayZ) / turnedZ - px * zBy,
                     yBy = -py * zBy;
        *byInverseDepth = focal * Point2d(xBy + (xBy * py + px * yBy) * u[s.pitch] - yBy * u[s.roll],
                                          yBy + 2 * py * yBy * u[s.pitch] + xBy * u[s.roll]);
    }
    return focal * Point2d(px + px * py * u[s.pitch] - py * u[s.roll] - v.other.x,
                           py + (1 + py * py) * u[s.pitch] + px * u[s.roll] - v.other.y);
}

// Half of the difference of the squares of the two times, in seconds: what a change of the yaw rate counts by.
double FlowResidual::halfSquare(const TrackedBearing& s) const
{
    return 0.5 * (s.timeOther * s.timeOther - s.timeNow * s.timeNow) * unit * unit;
}

Point2d FlowResidual::evaluate(const TrackedBearing& s, const Values& u, double* jacobian) const
{
    const View view = predict(s, u);
    const Point2d residual = residualOf(s, u, view);
    if (jacobian)
    {
        const double length = u[SEQUENCE_SPEED] * unit;
        const double cosine = u.cosine, sine = u.sine;
        double *jx = jacobian, *jy = jacobian + FLOW_VALUES;
        std::fill(jx, jx + 2 * FLOW_VALUES, 0.);
        const double mx = (view.now.x + view.other.x) / 2, my = (view.now.y + view.other.y) / 2,
                     f = focal * (s.timeNow - s.timeOther);
        const double xByW = f * (heading.s - mx * heading.c), yByW = -f * my * heading.c;
        double wBy[SEQUENCE_VALUES] = {0}, w, wByX = 0, wByY = 0;
        if (view.plane == 2)
        {
            wBy[SEQUENCE_SPEED] = unit * u[SEQUENCE_ROAD] * my;
            wBy[SEQUENCE_ROAD] = length * my;
            wByY = length * u[SEQUENCE_ROAD];
            w = wByY * my;
        }
        else
        {
            const int wall = view.plane == 0 ? SEQUENCE_LEFT : SEQUENCE_RIGHT, side = view.plane == 0 ? 1 : -1;
            const double slope = side * (sine - cosine * mx);
            wBy[SEQUENCE_SPEED] = unit * u[wall] * slope;
            wBy[wall] = length * slope;
            wByX = -side * length * u[wall] * cosine;
            w = length * u[wall] * slope;
            wBy[SEQUENCE_DIRECTION] = side * length * u[wall] * (cosine + sine * mx);
        }
        for (int i = 0; i < SEQUENCE_VALUES; i++)
        {
            jx[i] = xByW * wBy[i];
            jy[i] = yByW * wBy[i];
        }
        // A tilt moves a point where it moves otherwise, and turns the way that it moves.
        const double ofYaw = f * unit * u[SEQUENCE_YAW_RATE], dx = ofYaw * (1 + mx * mx) + xByW * w,
                     dy = ofYaw * mx * my + yByW * w;
        const auto setTilt = [&](int which, double x, double y, double turnedX, double turnedY) {
            const double change = wByX * x + wByY * y;
            jx[which] = ofYaw * 2 * mx * x + xByW * change - f * heading.c * w * x - turnedX;
            jy[which] = ofYaw * (my * x + mx * y) + yByW * change - f * heading.c * w * y - turnedY;
        };
        setTilt(SEQUENCE_PITCH, mx * my, 1 + my * my, my * dx + mx * dy, 2 * my * dy);
        setTilt(SEQUENCE_ROLL, -my, mx, -dy, dx);
        jx[SEQUENCE_YAW_RATE] = f * unit * (1 + mx * mx);
        jy[SEQUENCE_YAW_RATE] = f * unit * mx * my;
        jx[FLOW_YAW_CHANGE] = -focal * halfSquare(s) * (1 + mx * mx);
        jy[FLOW_YAW_CHANGE] = -focal * halfSquare(s) * mx * my;
        jx[s.pitch] = focal * mx * my;
        jy[s.pitch] = focal * (1 + my * my);
        jx[s.roll] = -focal * my;
        jy[s.roll] = focal * mx;
    }
    return residual;
}

}} // namespace cv::rsackermann
