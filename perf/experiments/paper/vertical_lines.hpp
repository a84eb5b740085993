// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_VERTICAL_LINES_HPP
#define RSACKERMANN_PERF_VERTICAL_LINES_HPP

#include "opencv2/rsackermann.hpp"

namespace paper {

//! The two ends of a segment as the minimal solvers take them.
cv::rsackermann::VerticalSegment verticalSegment(const cv::rsackermann::RollingShutterCamera& camera,
                                                 const cv::Vec4d& ends);

/** Difference of the compensated columns of the ends of a vertical's image in units of the focal length; 0 for exact
lines.

The wall is the one on whose side of the vanishing point the segment is. See doc/theory.md, "Compensation". */
double columnDifference(const cv::rsackermann::VerticalSegment& segment, const cv::rsackermann::MinimalSolution& motion,
                        double heading);

//! Largest |alpha| and sqrt(B^2 + D^2) of motions within the limits in radians and metres per second.
cv::rsackermann::SolverOptions solverLimits(const cv::rsackermann::RollingShutterCamera& camera, double maxYawRate,
                                            double maxSpeed, double wallDistance);

} // namespace paper

#endif // RSACKERMANN_PERF_VERTICAL_LINES_HPP
