// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_POSTERIOR_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_POSTERIOR_HPP

#include "displacement_field.hpp"
#include "refinement.hpp"

namespace cv { namespace rsackermann {

//! The motion as the segments and all other knowledge show it.
struct Posterior
{
    Model model;                  //!< the correction with the smallest expected displacement
    double G = 0;                 //!< slope of the road's scaled inverse depth
    double roadSigma = 0;         //!< of its logarithm if segments say more of it than the prior, else 0
    bool contradictsWall = false; //!< whether ends of segments are on another road than a given wall's distance says
    MotionHypothesis hypothesis = {MODEL_NONE, 0};   //!< of the model
    Matx<double, PARAMETERS, PARAMETERS> covariance; //!< mean square deviation from the model
    //! Mean displacement in pixels to be expected of the image as it is, and after the correction
    double expectedRaw = 0, expectedResidual = 0;
    double probabilityWorse = 0; //!< that the correction leaves a larger displacement than there is
};

/** Averages the correction over the motions that are possible, weighted by their probability (doc/theory.md,
"Posterior").

A camera at rest, a pure rotation and a motion between walls are explored over the yaw rate; the other unknowns are
refined at each.
@param problem with a driving prior; its noise becomes the one that was found, from which another exploration of it,
with another prior, starts.
@return false if no motion within the limits could be refined.
*/
bool explorePosterior(RefinementProblem& problem, const AckermannEstimator::Params& params,
                      const DisplacementField& field, Posterior& result);

/** Adds what isn't known of the focal length to the covariance and to the displacement that is expected to be left
(doc/theory.md, "Focal length and line delay").
@param problem of which the posterior is the result.
@param segments N x 4, CV_64F.
*/
void addFocalUncertainty(const RefinementProblem& problem, const RollingShutterCamera& camera,
                         const AckermannEstimator::Params& params, const MotionPrior& prior, const Mat& segments,
                         Posterior& found);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_POSTERIOR_HPP
