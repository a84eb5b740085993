// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_ESTIMATOR_REFINEMENT_HPP
#define OPENCV_RSACKERMANN_SRC_ESTIMATOR_REFINEMENT_HPP

#include "candidate.hpp"
#include "model.hpp"
#include "robust_loss.hpp"

namespace cv {
namespace rsackermann {

//! The data of the refinement; the candidates are not copied.
struct RefinementProblem
{
    const std::vector<Candidate>* candidates;
    double heading;
    double focal;       // pixels
    double sigma;       // pixels, of a residual
    double lossScale;   // of the robust loss, in sigmas
    MotionLimits limits;

    RefinementProblem(const std::vector<Candidate>& c, const MotionLimits& l) : candidates(&c), heading(0), focal(1), sigma(1), lossScale(1), limits(l) {}
};

//! Robust cost of a model: the sum of the losses of all residuals, in units of sigma^2.
double refinementCost(const RefinementProblem& problem, const Model& model);

/** Levenberg-Marquardt with the exact model on all candidates (doc/theory.md, "Estimation").
@param structure which unknowns are free.
@param model start and result.
@return cost of the result.
*/
double refine(const RefinementProblem& problem, const Structure& structure, int maxIterations, Model& model);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_ESTIMATOR_REFINEMENT_HPP
