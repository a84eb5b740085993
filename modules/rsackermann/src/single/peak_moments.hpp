// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_PEAK_MOMENTS_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_PEAK_MOMENTS_HPP

#include "refinement.hpp"

namespace cv { namespace rsackermann {

/** Mean and covariance of a peak of the posterior, integrated along the principal axes of its normal approximation
(doc/theory.md, "Posterior").
@param problem with which the fit was refined.
@param fit minimum of the cost and the covariance there; they become those of the peak. */
void integratePeak(const RefinementProblem& problem, Fit& fit);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_PEAK_MOMENTS_HPP
