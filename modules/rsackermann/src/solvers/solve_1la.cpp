// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"

namespace cv { namespace rsackermann {

// doc/theory.md, "Solvers": 2 alpha = (phi_v - phi_u) / (t_u - t_v). The paper's quadratic is its linearisation.
int solve1LA(const VerticalSegment& segment, const SolverOptions& options, MinimalSolution solutions[1])
{
    if (!isUsable(segment))
        return 0;
    const HorizontalBearing &u = segment.u, &v = segment.v;
    const double along = u.x * v.x + u.z * v.z;
    if (!(along > 0))
        return 0;
    const double turn = std::atan((v.x * u.z - v.z * u.x) / along); // phi_v - phi_u
    MinimalSolution& s = solutions[0];
    s.alpha = turn / (2 * (segment.timeU - segment.timeV));
    s.wallSlope = s.wallOffset = s.wallRatio = 0;
    return isWithinLimits(s, options) ? 1 : 0;
}

}} // namespace cv::rsackermann
