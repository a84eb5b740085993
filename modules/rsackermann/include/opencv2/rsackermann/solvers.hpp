// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SOLVERS_HPP
#define OPENCV_RSACKERMANN_SOLVERS_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace cv {
namespace rsackermann {

//! @addtogroup rsackermann
//! @{

/** @brief The two ends u and v of the image of a vertical line, as the minimal solvers take them.

The compensated point's column does not depend on the height of the point, so that the horizontal part of the upright
bearings and the row times suffice.
 */
struct CV_EXPORTS VerticalSegment
{
    Point2d u;    //!< horizontal part (x, z) of the upright bearing of u, of any positive length
    double timeU; //!< row time of u
    Point2d v;    //!< horizontal part (x, z) of the upright bearing of v
    double timeV; //!< row time of v

    //! A segment from azimuths in radians and row times.
    static VerticalSegment fromAzimuths(double azimuthU, double timeU, double azimuthV, double timeV);
};

//! One solution of a minimal solver; see AckermannMotion for the meaning of the values.
struct CV_EXPORTS MinimalSolution
{
    double alpha;  //!< half of the yaw per unit of row time
    double B;      //!< slope of the left (or only) wall
    double D;      //!< offset of the left (or only) wall
    double lambda; //!< ratio of the wall distances left / right; 0: one wall
};

//! What a minimal solver is told and what it may return.
struct CV_EXPORTS SolverOptions
{
    SolverOptions() : heading(0), maxAlpha(0.25), maxSpeed(4), rollingShutterDepth(true) {}
    double heading;  //!< RollingShutterCamera::heading, radians
    double maxAlpha; //!< solutions with a larger |alpha| are dropped
    double maxSpeed; //!< solutions with a larger sqrt(B^2 + D^2) are dropped
    bool rollingShutterDepth; //!< solve4LA: take the wall's depth at the rolling-shutter point, as the paper does (default), or at the global-shutter point, which costs the same and is closer to the truth
};

/** @brief Pure rotation from one vertical segment (1-LA), in closed form and exact.
@param segment image of a vertical line.
@param options limits; the heading does not matter.
@param solutions receives at most one solution; only alpha is not 0.
@return number of solutions; 0 where both ends have the same row time or azimuths that differ by more than a right angle.
@sa @cite purkait2018minimal section 3.1
 */
CV_EXPORTS int solve1LA(const VerticalSegment& segment, const SolverOptions& options, MinimalSolution solutions[1]);

/** @brief Pure translation along two walls (3-LA), exact.
@param segments two images of vertical lines on the left (or only) wall and, where twoWalls, a third one on the right wall.
@param twoWalls whether there is a third segment; otherwise lambda is 0.
@param options heading and limits.
@param solutions receives at most one solution; alpha is 0.
@return number of solutions; 0 for degenerate segments or lambda <= 0.
@sa @cite purkait2018minimal section 3.2
 */
CV_EXPORTS int solve3LA(const VerticalSegment* segments, bool twoWalls, const SolverOptions& options, MinimalSolution solutions[1]);

/** @brief Yaw rate and translation along two walls (4-LA) to first order in alpha: the roots of a cubic.
@param segments three images of vertical lines on the left (or only) wall and, where twoWalls, a fourth one on the right wall.
@param twoWalls whether there is a fourth segment; otherwise lambda is 0.
@param options heading and limits.
@param solutions receives at most three solutions.
@return number of solutions; 0 for degenerate segments.
@sa @cite purkait2018minimal section 3.3
 */
CV_EXPORTS int solve4LA(const VerticalSegment* segments, bool twoWalls, const SolverOptions& options, MinimalSolution solutions[3]);

/** @brief Yaw rate and translation along two walls (4-LA) with the exact motion and the depth at the global-shutter point.

The roots inside the limits of a polynomial of degree 8 or less in alpha, polished on the exact trigonometric equation.
@param segments three images of vertical lines on the left (or only) wall and, where twoWalls, a fourth one on the right wall.
@param twoWalls whether there is a fourth segment; otherwise lambda is 0.
@param options heading and limits.
@param solutions receives at most eight solutions.
@return number of solutions; 0 for degenerate segments.
@sa @cite purkait2018minimal section 3.4
 */
CV_EXPORTS int solve4LAExact(const VerticalSegment* segments, bool twoWalls, const SolverOptions& options, MinimalSolution solutions[8]);

/** @brief Translation along two walls for a known yaw rate, exact.
@param segments two images of vertical lines on the left (or only) wall and, where twoWalls, a third one on the right wall.
@param twoWalls whether there is a third segment; otherwise lambda is 0.
@param alpha half of the yaw per unit of row time.
@param options heading and limits.
@param solutions receives at most one solution.
@return number of solutions; 0 for degenerate segments.
 */
CV_EXPORTS int solveKnownYawRate(const VerticalSegment* segments, bool twoWalls, double alpha, const SolverOptions& options,
                                 MinimalSolution solutions[1]);

/** @brief Yaw rate and walls for a known speed, exact: the paper's other gauge.
@param segments two images of vertical lines on the left (or only) wall and, where twoWalls, a third one on the right wall.
@param twoWalls whether there is a third segment; otherwise lambda is 0.
@param size known sqrt(B^2 + D^2): speed times RollingShutterCamera::secondsPerUnitTime over the distance of the left (or only) wall.
@param options heading and limits.
@param solutions receives at most eight solutions.
@return number of solutions; 0 for degenerate segments.
 */
CV_EXPORTS int solveKnownSpeed(const VerticalSegment* segments, bool twoWalls, double size, const SolverOptions& options,
                               MinimalSolution solutions[8]);

/** @brief Yaw rate and speed for a known line at infinity of the walls, exact.
@param segments two images of vertical lines on the left (or only) wall and, where twoWalls, a third one on the right wall.
@param twoWalls whether there is a third segment; otherwise lambda is 0.
@param azimuth of the walls in the upright frame, radians; either of their two directions.
@param options heading and limits.
@param solutions receives at most six solutions.
@return number of solutions; 0 for degenerate segments.
 */
CV_EXPORTS int solveKnownWallDirection(const VerticalSegment* segments, bool twoWalls, double azimuth, const SolverOptions& options,
                                       MinimalSolution solutions[6]);

//! @}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SOLVERS_HPP
