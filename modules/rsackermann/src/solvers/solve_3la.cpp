// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"

namespace cv { namespace rsackermann {

// doc/theory.md, "Solvers": with alpha = 0 the constraints are linear in (B, D), then in lambda.
int solve3LA(const VerticalSegment* segments, bool twoWalls, const SolverOptions& options, MinimalSolution solutions[1])
{
    const Heading heading(options.heading);
    RotatedSegment rotated[3];
    Constraint constraints[3];
    for (int i = 0; i < (twoWalls ? 3 : 2); i++)
    {
        const VerticalSegment& segment = segments[i];
        if (!isUsable(segment))
            return 0;
        rotated[i] = RotatedSegment(segment, RowMotion(heading, segment.timeU), RowMotion(heading, segment.timeV));
        constraints[i] = rotated[i].constraint();
    }
    MinimalSolution& s = solutions[0];
    s.alpha = 0;
    if (!solveWalls(constraints, twoWalls ? constraints + 2 : 0, s))
        return 0;
    return isWithinLimits(s, options) && areOnWalls(s, rotated, 2, twoWalls) ? 1 : 0;
}

}} // namespace cv::rsackermann
