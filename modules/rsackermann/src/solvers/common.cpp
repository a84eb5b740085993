// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"

namespace cv {
namespace rsackermann {

VerticalSegment VerticalSegment::fromAzimuths(double azimuthU, double timeU, double azimuthV, double timeV)
{
    VerticalSegment s;
    s.u = Point2d(std::sin(azimuthU), std::cos(azimuthU));
    s.v = Point2d(std::sin(azimuthV), std::cos(azimuthV));
    s.timeU = timeU;
    s.timeV = timeV;
    return s;
}

bool solveWalls(const Constraint& first, const Constraint& second, const Constraint* right, MinimalSolution& solution)
{
    const double degenerate = 1e-10;
    const Constraint n = first.cross(second); // parallel to (1, D, B)
    if (!(std::abs(n.e) > degenerate * first.length() * second.length()))
        return false;
    solution.D = n.d / n.e;
    solution.B = n.b / n.e;
    solution.lambda = 0;
    if (!(std::hypot(solution.B, solution.D) > degenerate))
        return false; // vertical lines that stay where they are tell nothing about walls
    if (right)
    {
        const double slope = right->d * solution.D + right->b * solution.B;
        if (!(std::abs(slope) > degenerate * std::abs(right->e)))
            return false;
        solution.lambda = right->e / slope;
        return solution.lambda > 0;
    }
    return true;
}

bool solveWallsFromThree(const Constraint c[3], const Constraint* right, MinimalSolution& solution)
{
    int best = 0;
    double bestLength = -1;
    for (int i = 0; i < 3; i++)
    {
        const Constraint &a = c[i], &b = c[(i + 1) % 3];
        const double length = a.cross(b).length() / (a.length() * b.length() + DBL_MIN);
        if (length > bestLength)
        {
            bestLength = length;
            best = i;
        }
    }
    return solveWalls(c[best], c[(best + 1) % 3], right, solution);
}

// The side of the line at infinity on which a bearing is seen, as the sign of its scaled inverse depth; 0 behind the camera.
static int wallSide(const Point2d& bearing, double time, double heading, double alpha, double B, double D)
{
    const TurnedBearing turned(bearing, RowMotion(alpha, heading, time));
    const double z = turned.M + turned.G * B;
    if (!(z > 0))
        return 0;
    return D * z - B * (turned.N + turned.G * D) > 0 ? 1 : -1;
}

bool isPlausible(const MinimalSolution& s, const VerticalSegment* segments, int left, bool twoWalls, const SolverOptions& options)
{
    if (!(std::abs(s.alpha) <= options.maxAlpha) || !(std::hypot(s.B, s.D) <= options.maxSpeed))
        return false;
    int side = 0;
    for (int i = 0; i < left + (twoWalls ? 1 : 0); i++)
    {
        const double scale = i < left ? 1 : -s.lambda;
        const VerticalSegment& segment = segments[i];
        const int u = wallSide(segment.u, segment.timeU, options.heading, s.alpha, scale * s.B, scale * s.D);
        const int v = wallSide(segment.v, segment.timeV, options.heading, s.alpha, scale * s.B, scale * s.D);
        if (u == 0 || u != v || (side != 0 && u != side))
            return false;
        side = u;
    }
    return true;
}

}} // namespace cv::rsackermann
