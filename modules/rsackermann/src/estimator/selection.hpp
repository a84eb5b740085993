// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_ESTIMATOR_SELECTION_HPP
#define OPENCV_RSACKERMANN_SRC_ESTIMATOR_SELECTION_HPP

#include "fit.hpp"

namespace cv { namespace rsackermann {

/** Fits all motion hypotheses that Params::model and the heading allow and returns the one with the best Bayesian
information criterion (doc/theory.md, "Estimation"). A camera at rest is among them.
@param problem its sigma is a first guess and becomes the one that was found.
*/
Fit selectMotion(RefinementProblem& problem, const AckermannEstimator::Params& params);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_ESTIMATOR_SELECTION_HPP
