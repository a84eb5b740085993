// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "values.hpp"

#include <cmath>

// Segments and limits for the minimal solvers: no more solutions than there is room for, and those finite and within
// the limits.

using namespace cv::rsackermann;
using fuzz::require;

namespace {

void check(int count, int room, const MinimalSolution* solutions, bool twoWalls, const SolverOptions& options)
{
    require(count >= 0 && count <= room, "there are more solutions than room for them");
    for (int i = 0; i < count; i++)
    {
        const MinimalSolution& s = solutions[i];
        require(fuzz::isFinite(s.alpha) && fuzz::isFinite(s.wallSlope) && fuzz::isFinite(s.wallOffset) &&
                    fuzz::isFinite(s.wallRatio),
                "a solution isn't finite");
        require(std::abs(s.alpha) <= options.maxAlpha &&
                    std::hypot(s.wallSlope, s.wallOffset) <= options.maxScaledSpeed * (1 + 1e-12),
                "a solution is beyond the limits");
        require(twoWalls ? s.wallRatio > 0 : s.wallRatio == 0, "the ratio of the walls isn't that of their number");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    fuzz::Values values(data, size);
    SolverOptions options;
    options.heading = values.around(0, -3.2, 3.2);
    options.maxAlpha = values.around(options.maxAlpha, 0, 1);
    options.maxScaledSpeed = values.around(options.maxScaledSpeed, 0, 100);
    options.depthModel = values.integer(DEPTH_GLOBAL_SHUTTER, DEPTH_ROLLING_SHUTTER);
    const bool twoWalls = values.flag();
    const double alpha = values.number(-0.1, 0.1), speed = values.number(0, 1), direction = values.number(-3.2, 3.2);
    VerticalSegment segments[4];
    for (VerticalSegment& s : segments)
    {
        const double azimuth = values.number(-1, 1), slant = values.number(-0.1, 0.1);
        s = VerticalSegment::fromAzimuths(azimuth, values.number(-0.5, 0.5), azimuth + slant, values.number(-0.5, 0.5));
        const double length = values.around(1, 0, 10);
        s.u = HorizontalBearing(s.u.x * length, s.u.z * length);
    }
    MinimalSolution solutions[8];
    check(solve1LA(segments[0], options, solutions), 1, solutions, false, options);
    check(solve3LA(segments, twoWalls, options, solutions), 1, solutions, twoWalls, options);
    check(solve4LA(segments, twoWalls, options, solutions), 3, solutions, twoWalls, options);
    check(solve4LAExact(segments, twoWalls, options, solutions), 8, solutions, twoWalls, options);
    check(solveKnownYawRate(segments, twoWalls, alpha, options, solutions), 1, solutions, twoWalls, options);
    check(solveKnownSpeed(segments, twoWalls, speed, options, solutions), 8, solutions, twoWalls, options);
    check(solveKnownWallDirection(segments, twoWalls, direction, options, solutions), 6, solutions, twoWalls, options);
    return 0;
}
