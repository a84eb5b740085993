// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_RESIDUAL_KERNELS_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_RESIDUAL_KERNELS_HPP

#include "prepared_model.hpp"
#include "robust_losses.hpp"
#include "segment_arrays.hpp"
#include "slant_noise.hpp"

// Sums over the residuals of all segments, in vectors of the widest kind that the processor has.

namespace cv { namespace rsackermann {

//! The unknowns of a refinement.
struct FreeParameters
{
    int count = 0;
    int index[PARAMETERS];

    void add(Parameter p) { index[count++] = p; }
    bool has(Parameter p) const { return std::find(index, index + count, int(p)) != index + count; }
    bool hasTilt() const { return has(P_ROLL) || has(P_PITCH); }
};

//! Robust cost and weighted normal equations of residuals in units of their standard deviations.
struct ResidualSums
{
    double cost = 0;
    double gradient[PARAMETERS] = {};            // in the order of FreeParameters
    double hessian[PARAMETERS][PARAMETERS] = {}; // lower triangle
};

//! Adds the residuals of candidates for verticals (segment_residuals.hpp).
void addVerticals(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss,
                  const FreeParameters& unknowns, ResidualSums& sums);

//! The same in single precision, which is 1e-4 pixels: for costs, and on the way to a minimum.
void addVerticalsInSinglePrecision(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss,
                                   const FreeParameters& unknowns, ResidualSums& sums);

//! Adds the residuals of the other segments (segment_residuals.hpp), in single precision.
void addDirections(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss,
                   const FreeParameters& unknowns, ResidualSums& sums);

/** MSAC score of candidates for verticals: the sum of min(r^2, threshold^2) of the residuals r in pixels.
@param best the sum may stop with any value above it.
@param inliers receives the number of residuals below the threshold.
*/
double scoreVerticals(const SegmentArrays& segments, const PreparedModel& model, double focal, double threshold,
                      double best, int& inliers);

/** The ends of segments as the global-shutter camera sees them.
@param points receives the four arrays of x and y of the ends u and v, each of the padded size.
*/
void compensateSegments(const SegmentArrays& segments, const PreparedModel& model, float* points);

/** Robust cost of a street in the direction (streetX, streetZ): the sum of r^2 / (1 + r^2) of the residuals of
compensated segments (segment_residuals.hpp) times scale.
@param points of compensateSegments().
@param padded size of their arrays.
*/
double streetCost(const float* points, int padded, double streetX, double streetZ, double scale);

//! What one step of expectation and maximisation needs.
struct SlantSums
{
    double verticals;    //!< expected number
    double squares;      //!< expected squares of the lean's part of their slants, weighed
    double otherSquares; //!< of the slants of the others
};

//! @param error of the detector, in radians * length
SlantSums sumSlants(const Slants& slants, const SlantNoise& noise, double error);

//! Logarithm of the likelihood of the slants.
double slantLikelihood(const Slants& slants, const SlantNoise& noise, double error);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_RESIDUAL_KERNELS_HPP
