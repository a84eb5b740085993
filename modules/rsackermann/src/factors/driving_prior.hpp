// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_DRIVING_PRIOR_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_DRIVING_PRIOR_HPP

#include "../features/upright_segment.hpp"
#include "jet.hpp"

namespace cv { namespace rsackermann {

//! What segments that stand on the road say about its distance.
struct RoadContact
{
    double ratio;    //!< distance of the left (or only) wall over the height of the camera, at most; 0: not known
    double logSigma; //!< standard deviation of its logarithm

    RoadContact() : ratio(0), logSigma(0) {}
};

/** How cars drive and how far away walls are, as a distribution (doc/theory.md, "Posterior").

It takes the place of a choice among motion models: what the segments don't tell stays where it usually is.
*/
class UsualDrive
{
public:
    UsualDrive(const MotionPrior& prior, const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
               const MotionLimits& limits);

    enum { MAX_RESIDUALS = 3 };
    //! Residuals in units of their standard deviations. @return their number.
    int evaluate(const Model& model, const MotionHypothesis& hypothesis, Jet residuals[MAX_RESIDUALS]) const;

    //! Logarithm of the prior density of alpha; a told yaw rate is in the cost of the refinement, but for its
    //! normalisation.
    double logYawDensity(double alpha) const;

    //! Logarithm of the volume that the priors leave to the unknowns of a hypothesis besides alpha.
    double logVolume(const MotionHypothesis& hypothesis) const;

    //! Logarithm of the odds on a camera at rest, or on a shutter that shows none of its motion, against one that
    //! moves.
    double logRest() const;

    //! Slope G of the road's scaled inverse depth for a motion, and its variance.
    void road(const Model& model, const RoadContact& contact, double& G, double& variance) const;

    double alphaScale() const { return toldAlphaSigma > 0 ? toldAlphaSigma : yawScale; }
    bool motionIsTold() const { return toldAlphaSigma > 0 || toldSpeedSigma > 0; }
    bool yawRateIsTold() const { return toldAlphaSigma > 0; }
    double toldAlpha() const { return toldAlphaSigma > 0 ? alpha : 0; }
    //! Scaled speed sqrt(B^2 + D^2) that is to be expected, for 1 forward and -1 reverse.
    double usualScaledSpeed(int direction) const;
    //! Whether the speed is told, in which direction: 1 or -1; 0: it isn't told.
    int toldDirection() const { return toldSpeedSigma > 0 ? (toldSpeed < 0 ? -1 : 1) : 0; }
    //! Distance of the left (or only) wall over the height of the camera.
    double roadRatio() const { return ratio; }

private:
    double yawScale;                  // of alpha
    double alpha, toldAlphaSigma;     // 0: not told
    double toldSpeed, toldSpeedSigma; // scaled by the row time alone, in metres; 0: not told
    double logSpeed, logSpeedSigma;   // of the scaled speed, without the uncertainty of the wall
    double logWallSigma;              // of the logarithm of a wall's distance; 0: told
    double heading, headingSigma;
    double height, ratio, logHeightSigma;
    double standing;     // probability
    double reverseRatio; // of the usual speed in reverse to that forward
    bool roadRatioIsTold;
    bool speedIsKnown; // with the wall's distance: the refinement has it as a measurement
    bool roadIsSeen;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_DRIVING_PRIOR_HPP
