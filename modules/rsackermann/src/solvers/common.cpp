// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"

namespace cv { namespace rsackermann {

VerticalSegment VerticalSegment::fromAzimuths(double azimuthU, double timeU, double azimuthV, double timeV)
{
    VerticalSegment s;
    s.u = HorizontalBearing(std::sin(azimuthU), std::cos(azimuthU));
    s.v = HorizontalBearing(std::sin(azimuthV), std::cos(azimuthV));
    s.timeU = timeU;
    s.timeV = timeV;
    return s;
}

bool solveWalls(const Constraint left[2], const Constraint* right, MinimalSolution& solution)
{
    const double degenerate = 1e-10;
    const Constraint n = left[0].cross(left[1]); // parallel to (1, D, B)
    if (!(n.e * n.e > degenerate * degenerate * left[0].length2() * left[1].length2()))
        return false;
    const double B = n.b / n.e, D = n.d / n.e;
    solution.wallSlope = B;
    solution.wallOffset = D;
    solution.wallRatio = 0;
    if (!(B * B + D * D > degenerate * degenerate))
        return false; // vertical lines that stay where they are show nothing of walls
    return !right || solveRatio(*right, solution);
}

bool solveRatio(const Constraint& right, MinimalSolution& solution)
{
    const double degenerate = 1e-10, slope = right.d * solution.wallOffset + right.b * solution.wallSlope;
    if (!(std::abs(slope) > degenerate * std::abs(right.e)))
        return false;
    solution.wallRatio = right.e / slope;
    return solution.wallRatio > 0;
}

bool solveWallsFromThree(const Constraint c[3], const Constraint* right, MinimalSolution& solution)
{
    const double length2[3] = {c[0].length2(), c[1].length2(), c[2].length2()};
    int best = 0;
    double bestSine2 = -1;
    for (int i = 0; i < 3; i++)
    {
        const int j = (i + 1) % 3;
        const double sine2 = c[i].cross(c[j]).length2() / (length2[i] * length2[j] + DBL_MIN);
        if (sine2 > bestSine2)
        {
            bestSine2 = sine2;
            best = i;
        }
    }
    const Constraint left[] = {c[best], c[(best + 1) % 3]};
    return solveWalls(left, right, solution);
}

// The side of the walls' vanishing point on which a bearing is seen, as the sign of its scaled inverse depth; 0 behind
// the camera.
static int wallSide(const RotatedBearing& bearing, double B, double D)
{
    const double z = bearing.M + bearing.gamma * B;
    if (!(z > 0))
        return 0;
    return D * z - B * (bearing.N + bearing.gamma * D) > 0 ? 1 : -1;
}

bool areOnWalls(const MinimalSolution& s, const RotatedSegment* segments, int left, bool twoWalls)
{
    int side = 0;
    for (int i = 0; i < left + (twoWalls ? 1 : 0); i++)
    {
        const double scale = i < left ? 1 : -s.wallRatio;
        const double B = scale * s.wallSlope, D = scale * s.wallOffset;
        const int u = wallSide(segments[i].u, B, D), v = wallSide(segments[i].v, B, D);
        if (u == 0 || u != v || (side != 0 && u != side))
            return false;
        side = u;
    }
    return true;
}

}} // namespace cv::rsackermann
