// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_REFINEMENT_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_REFINEMENT_HPP

#include "../motion/compensation.hpp"
#include "../features/upright_segment.hpp"
#include "../motion/model.hpp"
#include "../factors/segment_arrays.hpp"
#include "../factors/driving_prior.hpp"

namespace cv { namespace rsackermann {

const double NEGLIGIBLE = 1e-4; //!< probability of a motion that doesn't count

//! The data of the refinement.
struct RefinementProblem
{
    std::vector<UprightSegment> verticals; // from left to right
    std::vector<UprightSegment> others;    // may point along the street or across it
    SegmentArrays verticalArrays, otherArrays;
    MotionLimits limits;
    Matx33d uprightRotation = Matx33d::eye(); // of the camera
    double distortionSigma = 0;               // of its lens; 0: exact
    Heading heading = 0;
    double focal = 1;                   // pixels
    double sigma = 1;                   // pixels, of the residual of a vertical
    double lean = 0;                    // radians, by which verticals of the scene lean, whatever their length
    double directionSigma = 1;          // pixels, of the residual of another segment
    double lossScale = 1;               // of the robust loss, in sigmas
    bool noiseIsKnown = false;          // whether sigma, lean and lossScale are those that were measured
    double verticalWeight = 1;          // of the evidence of a vertical: below 1 if they err together
    double otherWeight = 1;             // the same for another segment
    double roadRatio = 1;               // distance of the left (or only) wall over the height of the camera
    double gravitySigma = 0;            // radians, of the vehicle's roll; 0: gravity is exact
    double vehiclePitchSigma = 0;       // radians, of its pitch
    double streetDeviation = 0;         // radians from the heading, standard deviation; 0: unknown
    const DrivingPrior* prior = 0;      // 0: none
    double leftmost = 0, rightmost = 0; // upright bearings of the middle of the image's borders

    explicit RefinementProblem(const MotionLimits& l) : limits(l) {}

    //! Standard deviation of the roll about the optical axis, to which the vehicle's pitch adds if the camera looks to
    //! a side.
    double rollSigma() const { return std::hypot(heading.c * gravitySigma, heading.s * vehiclePitchSigma); }

    GivenValues given() const { return prior ? prior->given() : GivenValues(); }

    //! Fills the arrays, after the segments have changed.
    void arrange();
    //! Weighs the arrays, after the focal length or a sigma has changed.
    void weigh();

    //! Upright bearings of the ends of all segments.
    std::vector<Point2d> ends() const;
};

//! Whether a model is within the limits, and has verticals on each of two walls that would be seen.
bool isAllowed(const RefinementProblem& problem, const MotionHypothesis& hypothesis, const Model& model);

//! Which residuals count.
enum Evidence { VERTICALS_ONLY, ALL_SEGMENTS };

/** Levenberg-Marquardt with the exact model on all candidates (doc/theory.md, "Estimation").
@param hypothesis which unknowns are free.
@param model start and result.
@param covariance receives, unless it is null, the covariance of all parameters; 0 for those that aren't free.
@param farthest cost above which it ends early if the steps that are left don't promise less.
@return cost of the result; DBL_MAX if it isn't finite.
*/
double refine(const RefinementProblem& problem, const MotionHypothesis& hypothesis, Evidence evidence,
              int maxIterations, Model& model, Matx<double, PARAMETERS, PARAMETERS>* covariance = 0,
              double farthest = DBL_MAX);

//! Cost of a model with all segments, in single precision.
double costOf(const RefinementProblem& problem, const MotionHypothesis& hypothesis, const Model& model);

//! The best model of a hypothesis.
struct Fit
{
    MotionHypothesis hypothesis;
    Model model;
    double cost; // robust, in units of sigma^2
    Matx<double, PARAMETERS, PARAMETERS> covariance;

    explicit Fit(const MotionHypothesis& h) : hypothesis(h), cost(DBL_MAX) {}

    //! Refines the model with all segments. @param farthest cost above which it may end early.
    void refine(const RefinementProblem& problem, double farthest = DBL_MAX);
};

//! Logarithm of the square root of the determinant of the covariance of the unknowns that are free.
double logVolume(const Fit& fit);

//! Whether a model belongs to the peak of a fit: normal distributions about both would have one. What isn't free
//! doesn't count.
bool isAt(const Fit& fit, const Model& model);

/** The same image as if another lens had taken it (doc/theory.md, "Posterior").

A ray at the tangent r from the optical axis of the assumed lens is at r (1 + distortion r^2): to first order the lens
has the radial coefficient -distortion.
@param problem receives the bearings of the other lens; weigh() is left to the caller.
@param logJacobian receives the logarithm of the product, over the verticals, of d(slant through the other lens) /
d(slant).
@return false if there is no such lens: rays would cross, or be behind the camera.
*/
bool seeThroughOtherLens(double distortion, RefinementProblem& problem, double& logJacobian);

/** Searches the direction of the street with which most of the other segments agree, and turns the walls of the model
there.
@return whether that is another model: false if there are too few segments, or if it was there already.
*/
bool startFromStreetDirection(const RefinementProblem& problem, const MotionHypothesis& hypothesis, Model& model);

/** Mean square of the angle, in radians, between the walls of a fit and all streets that are possible if as many of the
other segments as agree with a street may do so by chance (doc/theory.md, "Posterior"). */
double varianceOfOtherStreets(const RefinementProblem& problem, const Fit& fit);

/** How far away walls may be for their segments to end on the road or above it (doc/theory.md, "Estimation").

At the lower end of a segment that stands on the road, wall and road are equally near: w = G y. Others give larger
ratios.
@param threshold pixels, residual of a segment that counts half as one of a wall.
*/
RoadLimit findRoadLimit(const RefinementProblem& problem, const Model& model, double threshold);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_REFINEMENT_HPP
