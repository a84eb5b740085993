// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"

namespace cv { namespace rsackermann {

// doc/theory.md, "Solvers": for a given alpha the constraints are linear in (B, D), then in lambda.
int solveKnownYawRate(const VerticalSegment* segments, bool twoWalls, double alpha, const SolverOptions& options,
                      MinimalSolution solutions[1])
{
    if (cvIsNaN(alpha) || cvIsInf(alpha))
        return 0;
    return solutionsAt<2>(&alpha, 1, segments, twoWalls, options, solveWalls, solutions);
}

}} // namespace cv::rsackermann
