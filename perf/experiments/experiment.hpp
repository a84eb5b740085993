// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_EXPERIMENT_HPP
#define RSACKERMANN_PERF_EXPERIMENT_HPP

#include "street_model.hpp"

namespace experiments {

//! The estimator's knowledge besides the image, and its errors.
struct Knowledge
{
    double rollNoise, pitchNoise; //!< standard deviations in radians of the errors of roll and pitch
    double focalError;            //!< of the focal length: 0.1 for 10 % too long
    double focalNoise;            //!< standard deviation of further errors of it, of a size that the estimator is given
    double speedSigma;            //!< metres per second, of the error of a known speed; 0: it isn't known
    double yawRateSigma;          //!< radians per second, of the error of a known yaw rate; 0: it isn't known
    double wallDirectionSigma;    //!< radians, of the error of a known wall direction; 0: it isn't known
    bool exactPriors;             //!< known values have no error, whatever their standard deviation
    bool camera;                  //!< false: nothing of it, neither focal length and lens nor mount and read-out

    Knowledge()
        : rollNoise(0), pitchNoise(0), focalError(0), focalNoise(0), speedSigma(0), yawRateSigma(0),
          wallDirectionSigma(0), exactPriors(false), camera(true)
    {
    }
};

//! Which segments the estimator gets.
struct SegmentChoice
{
    bool verticalsOnly; //!< those that may be images of vertical lines
    //! Found in the global-shutter image, their ends moved by the true motion: without errors of detection in a bent
    //! image
    bool exact;

    SegmentChoice() : verticalsOnly(false), exact(false) {}
};

//! One rolling-shutter image with known truth.
struct Case
{
    std::string name;
    street::StreetCamera camera;
    street::StreetScene scene;
    cv::Mat photo; //!< global-shutter image to be distorted; empty: the street is rendered

    Case(const std::string& caseName, const street::StreetCamera& c, const street::StreetScene& s)
        : name(caseName), camera(c), scene(s)
    {
    }
};

struct Result
{
    int status, model, candidates, inliers;
    double raw, left;        //!< mean displacement in pixels before and after
    double seenLeft;         //!< mean displacement after the correction next to edges
    double expectedResidual; //!< what the estimator expects to be left
    double probabilityWorse;
    double yawRateError; //!< degrees per second
    double yawRateSigma; //!< its standard deviation as the estimator sees it; NaN if there is none
    double speedError;   //!< km/h; NaN if the speed isn't known
    double speedSigma;   //!< its standard deviation as the estimator sees it; NaN if there is none
    double deltaError;   //!< pixels; NaN if there are no walls
    //! Displacement in pixels that the estimator's covariance predicts; NaN if it wasn't asked for
    double floor;
};

//! The settings of an experiment.
struct Experiment
{
    cv::rsackermann::AckermannEstimator::Params params;
    Knowledge knowledge;
    SegmentChoice segments;
    int floorSamples; //!< motions drawn from the covariance to predict the displacement; 0: it isn't predicted

    Experiment() : floorSamples(0) {}
};

//! The rolling-shutter image of a case.
cv::Mat makeImage(const Case& c);

/** Estimates the motion from an image and compares the map with the true one.
@param seed of the errors in what the estimator is given. */
Result evaluate(const Case& c, const cv::Mat& image, const Experiment& experiment, unsigned seed);

//! What the estimator is given of the errors of roll and pitch, in radians; 0: there are none.
void setGravitySigma(double sigma, cv::rsackermann::AckermannEstimator::Params& params);

//! Quantile of the numbers among the values, NaN if there is none.
double quantile(std::vector<double> values, double fraction);
double mean(const std::vector<double>& values);

} // namespace experiments

#endif // RSACKERMANN_PERF_EXPERIMENT_HPP
