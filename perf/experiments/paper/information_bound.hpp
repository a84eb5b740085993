// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_INFORMATION_BOUND_HPP
#define RSACKERMANN_PERF_INFORMATION_BOUND_HPP

#include "opencv2/rsackermann.hpp"

namespace paper {

struct InformationBound
{
    double yawRate, speed; //!< standard deviations, radians and metres per second
};

/** Cramer-Rao bound of a motion between two walls from vertical lines, with gravity and the wall's distance known.

Each line gives one equation, that its compensated ends have the same column; its variance follows from that of the
ends. The columns of the lines themselves are unknown.
@param lines N x 4 matrix CV_64F without noise.
@param noise standard deviation of the coordinates of their ends, pixels. */
InformationBound informationBound(const cv::rsackermann::RollingShutterCamera& camera, const cv::Mat& lines,
                                  const cv::rsackermann::AckermannMotion& motion, double wallDistance, double noise);

} // namespace paper

#endif // RSACKERMANN_PERF_INFORMATION_BOUND_HPP
