// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_ESTIMATOR_UNCERTAINTY_HPP
#define OPENCV_RSACKERMANN_SRC_ESTIMATOR_UNCERTAINTY_HPP

#include "fit.hpp"

namespace cv { namespace rsackermann {

//! Logarithm of the volume of the ellipsoid of a fit's covariance. It is the same whichever of the walls is called the
//! left one.
double logVolume(const Fit& fit);

/** Follows the valley of a 4-LA fit, in which yaw rate and walls take each other's place (doc/theory.md, "Estimation").
@param fit becomes the best minimum that is found, with the mean square deviation from it over the valley as its
covariance.
*/
void exploreValley(const RefinementProblem& problem, Fit& fit);

/** Adds to the covariance of the best fit that another hypothesis may explain the image nearly as well.
@param fits of all hypotheses; those of 4-LA have been explored.
*/
void addOtherHypotheses(const std::vector<Fit>& fits, Fit& best);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_ESTIMATOR_UNCERTAINTY_HPP
