// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"

namespace cv {
namespace rsackermann {

// doc/theory.md, "Solvers": with alpha = 0 the constraints are linear in (B, D), then in lambda.
int solve3LA(const VerticalSegment* segments, bool twoWalls, const SolverOptions& options, MinimalSolution solutions[1])
{
    Constraint constraints[3];
    for (int i = 0; i < (twoWalls ? 3 : 2); i++)
    {
        const VerticalSegment& s = segments[i];
        if (!isUsable(s))
            return 0;
        constraints[i] = exactConstraint(TurnedBearing(s.u, RowMotion(0, options.heading, s.timeU)),
                                         TurnedBearing(s.v, RowMotion(0, options.heading, s.timeV)));
    }
    MinimalSolution& s = solutions[0];
    s.alpha = 0;
    if (!solveWalls(constraints[0], constraints[1], twoWalls ? constraints + 2 : 0, s))
        return 0;
    return isPlausible(s, segments, 2, twoWalls, options) ? 1 : 0;
}

}} // namespace cv::rsackermann
