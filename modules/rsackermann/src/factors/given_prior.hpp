// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_GIVEN_PRIOR_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_GIVEN_PRIOR_HPP

#include "../features/upright_segment.hpp"
#include "jet.hpp"

namespace cv { namespace rsackermann {

const double USUAL_LOG_RATIO = 0.8; //!< standard deviation of the logarithm of the ratio of the walls

/** Knowledge of the motion from elsewhere, in the units of the estimation, as residuals in units of their standard
deviations (doc/theory.md, "Estimation"). A sigma of 0: not known.
*/
struct PriorTerms
{
    double alpha, alphaSigma;
    double scaledSpeed, scaledSpeedSigma; // of sqrt(B^2 + D^2), with the sign of the direction
    double street, streetSigma;           // azimuth of the street
    double heading, headingSigma;         // the walls are along the vehicle's forward direction, more or less
    double reversePenalty;                // cost of driving backward

    PriorTerms()
        : alpha(0), alphaSigma(0), scaledSpeed(0), scaledSpeedSigma(0), street(0), streetSigma(0), heading(0),
          headingSigma(0), reversePenalty(0)
    {
    }
    PriorTerms(const MotionPrior& prior, const RollingShutterCamera& camera, const AckermannEstimator::Params& params);

    enum { MAX_RESIDUALS = 6 };
    //! @return number of residuals.
    int evaluate(const Model& model, const MotionHypothesis& hypothesis, Jet residuals[MAX_RESIDUALS]) const;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_GIVEN_PRIOR_HPP
