// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "common.hpp"

namespace cv { namespace rsackermann {

// doc/theory.md, "Solvers": with alpha = 0.
int solve3LA(const VerticalSegment* segments, bool twoWalls, const SolverOptions& options, MinimalSolution solutions[1])
{
    return solveKnownYawRate(segments, twoWalls, 0, options, solutions);
}

}} // namespace cv::rsackermann
