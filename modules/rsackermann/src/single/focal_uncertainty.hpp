// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_FOCAL_UNCERTAINTY_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_FOCAL_UNCERTAINTY_HPP

#include "posterior.hpp"

namespace cv { namespace rsackermann {

/** Adds what isn't known of the focal length to the covariance and to the displacement that is expected to be left
(doc/theory.md, "Focal length and line delay").
@param problem of which the posterior is the result.
@param segments N x 4, CV_64F.
*/
void addFocalUncertainty(const RefinementProblem& problem, const RollingShutterCamera& camera,
                         const AckermannEstimator::Params& params, const MotionPrior& prior, const Mat& segments,
                         Posterior& found);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_FOCAL_UNCERTAINTY_HPP
