// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_DRIVING_PRIOR_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_DRIVING_PRIOR_HPP

#include "../features/upright_segment.hpp"
#include "../motion/compensation.hpp"
#include "../motion/contradiction.hpp"
#include "../motion/sequence_values.hpp"
#include "jet.hpp"
#include "road_limit.hpp"

namespace cv { namespace rsackermann {

const double EXACT_GRAVITY = 1e-4; //!< radians: a gravity that is given as exact is as good as that

//! Standard deviations in radians of the vehicle's roll and pitch against the camera's upright rotation.
struct TiltSigmas
{
    double roll, pitch;

    //! Those of the vehicle and those of the camera's mount together, unless gravity is exact.
    TiltSigmas(const RollingShutterCamera& camera, const AckermannEstimator::Params& params);
};

//! The values of a MotionPrior in the units of the estimation; a sigma of 0: not given.
struct GivenValues
{
    double alpha = 0, alphaSigma = 0;
    double speed = 0, speedSigma = 0;   // by the row time alone, in metres
    double street = 0, streetSigma = 0; // azimuth of the street

    GivenValues() {}
    GivenValues(const MotionPrior& prior, const RollingShutterCamera& camera);
};

/** How cars drive and how far away walls are, and what is given of it, as a distribution (doc/theory.md, "Prior").

It takes the place of a choice among motion models: what the segments don't determine stays where it is expected.
*/
class DrivingPrior
{
public:
    DrivingPrior(const MotionPrior& prior, const RollingShutterCamera& camera,
                 const AckermannEstimator::Params& params);

    enum { MAX_RESIDUALS = 7, MAX_YAW_RESIDUALS = 2 };
    //! Residuals in units of their standard deviations. @return their number.
    int evaluate(const Model& model, const MotionHypothesis& hypothesis, Jet residuals[MAX_RESIDUALS]) const;

    //! Those of the yaw rate alone, of a motion that turns or doesn't. @return their number.
    int evaluateYaw(double alpha, bool turns, Jet residuals[MAX_YAW_RESIDUALS]) const;

    //! Logarithm of the prior density of alpha; a given yaw rate is in the residuals, but for its normalisation.
    double logYawDensity(double alpha) const;

    //! Logarithm of the volume that the priors leave to the unknowns of a hypothesis besides alpha.
    double logVolume(const MotionHypothesis& hypothesis) const;

    //! Logarithm of the odds on a camera at rest, or on a shutter that shows none of its motion, against one that
    //! moves.
    double logRest() const;

    /** The motion that is expected before the image is seen; one wall is that which a camera sees that looks aside.
    @param direction 1 or -1.
    @param covariance of the yaw rate, the street and the walls. */
    Model expectedMotion(const MotionHypothesis& hypothesis, int direction,
                         Matx<double, PARAMETERS, PARAMETERS>& covariance) const;

    //! -2 times the logarithm of the probability of driving in a direction; 0 in none. @param direction 1, -1 or 0.
    double directionPenalty(int direction, const MotionHypothesis& hypothesis) const;

    //! Slope G of the road's scaled inverse depth for a motion, and its variance.
    void road(const Model& model, const RoadLimit& limit, double& G, double& variance) const;

    //! The same of any forward motion, whatever the walls show: logarithm and its standard deviation.
    void anyRoad(double& logG, double& sigma) const;

    const GivenValues& given() const { return given_; }
    const Heading& heading() const { return heading_; }
    double alphaScale() const
    {
        return yawRateIsGiven() ? given_.alphaSigma * yawScale / std::hypot(given_.alphaSigma, yawScale) : yawScale;
    }
    //! Before the image is seen.
    double expectedAlpha() const { return yawShare * given_.alpha; }
    bool yawRateIsGiven() const { return given_.alphaSigma > 0; }
    bool speedIsGiven() const { return given_.speedSigma > 0; }
    //! The part of the variance of usual yaw rates that what is given takes away; 1 if a speed is given.
    double givenShare() const { return speedIsGiven() ? 1 : yawShare; }
    //! Scaled speed sqrt(B^2 + D^2) that is to be expected.
    double expectedScaledSpeed() const { return std::exp(logSpeed); }
    //! The direction of a given speed: 1 or -1; 0: it isn't known.
    int givenDirection() const
    {
        return speedIsGiven() && std::abs(given_.speed) > CONTRADICTION * given_.speedSigma
                   ? (given_.speed < 0 ? -1 : 1)
                   : 0;
    }
    //! Whether walls that stand on the road are to say how far away they are.
    bool roadIsSought() const { return roadIsSought_; }
    //! Whether the distance of the left (or only) wall is given.
    bool wallIsGiven() const { return wallIsGiven_; }
    //! Distance of the left (or only) wall over the height of the camera.
    double roadRatio() const { return ratio; }

private:
    //! The logarithm of a scaled speed, that of a speed over that of a wall's distance: its variance, the part of it
    //! that is the speed's, and the speed's variance if the scaled speed is known.
    struct ScaledSpeedLog
    {
        double variance, speedShare, speedVariance;
    };

    ScaledSpeedLog scaledSpeedLog(int walls) const;
    //! Mean and variance of the logarithm of G for a road that is below the ends of segments.
    void limitRoad(const RoadLimit& limit, const Model& model, double& logG, double& variance) const;
    double usualYawDensity(double alpha) const;
    double logSumOfYaw() const;
    Jet speedResidual(const Model& model, const MotionHypothesis& hypothesis) const;

    GivenValues given_;
    double yawScale;                // of alpha
    double yawShare;                // of givenShare()
    double logYawSum;               // of the density of usual yaw rates times that of the given one, unless 0
    double logSpeed, logSpeedSigma; // of the scaled speed, without the uncertainty of the wall
    double logWallSigma;            // of the logarithm of a wall's distance; 0: exact
    double logRatioSigma;           // of both walls' distances
    Heading heading_;
    double headingSigma; // the walls are along the vehicle's forward direction, more or less
    double height, ratio, logHeightSigma;
    double speedWallCorrelation; // of the logarithms: drivers slow down where walls are near
    double usualWallSigma;       // of the logarithm of a wall's distance if none is given
    double standing;             // probability
    double reverse;              // probability of driving backward
    bool wallIsGiven_, roadIsSought_, roadRatioIsGiven;
    bool roadIsSeen;
};

/** Mean and standard deviations of the same distribution for the state of a sequence, before anything is seen. */
void stationaryState(const RollingShutterCamera& camera, const AckermannEstimator::Params& params, SequenceVector& mean,
                     SequenceVector& sigma);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_DRIVING_PRIOR_HPP
