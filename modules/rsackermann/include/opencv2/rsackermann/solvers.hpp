// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SOLVERS_HPP
#define OPENCV_RSACKERMANN_SOLVERS_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace cv { namespace rsackermann {

//! @addtogroup rsackermann
//! @{

/** @brief Horizontal part of an upright bearing, of any positive length.

The compensated column of a point doesn't depend on its height, so that this and the row time are all that the solvers
need.
 */
struct CV_EXPORTS HorizontalBearing
{
    HorizontalBearing() : x(0), z(1) {}
    //! The bearing along (x_, 0, z_).
    HorizontalBearing(double x_, double z_) : x(x_), z(z_) {}
    double x; //!< to the right
    double z; //!< forward
};

//! The two ends u and v of the image of a vertical line, as the minimal solvers take them.
struct CV_EXPORTS VerticalSegment
{
    HorizontalBearing u; //!< bearing of u
    double timeU;        //!< row time of u
    HorizontalBearing v; //!< bearing of v
    double timeV;        //!< row time of v

    //! A segment from azimuths in radians and row times.
    static VerticalSegment fromAzimuths(double azimuthU, double timeU, double azimuthV, double timeV);
};

//! One solution of a minimal solver; see AckermannMotion for the meaning of the values.
struct CV_EXPORTS MinimalSolution
{
    double alpha;      //!< half of the yaw per unit of row time
    double wallSlope;  //!< slope B of the left (or only) wall
    double wallOffset; //!< offset D of the left (or only) wall
    double wallRatio;  //!< ratio lambda of the wall distances left / right; 0: one wall
};

//! The point at which solve4LA() takes the depth of a wall; both cost the same.
enum DepthModel {
    DEPTH_GLOBAL_SHUTTER = 0, //!< the point of the global-shutter image, which is closer to the truth (default)
    DEPTH_ROLLING_SHUTTER = 1 //!< the point of the raw image, as in @cite purkait2018minimal
};

//! Input of a minimal solver besides segments, and limits of its solutions.
struct CV_EXPORTS SolverOptions
{
    SolverOptions() : heading(0), maxAlpha(0.25), maxScaledSpeed(4), depthModel(DEPTH_GLOBAL_SHUTTER) {}
    double heading;        //!< RollingShutterCamera::heading, radians
    double maxAlpha;       //!< solutions with a larger |alpha| are dropped
    double maxScaledSpeed; //!< solutions with a larger scaled speed sqrt(B^2 + D^2) are dropped
    int depthModel;        //!< one of #DepthModel
};

/** @brief Pure rotation from one vertical segment (1-LA), in closed form and exact.
@param segment image of a vertical line.
@param options limits; the heading does not matter.
@param solutions receives at most one solution; only alpha is not 0.
@return number of solutions; 0 if both ends have the same row time or azimuths that differ by more than a right angle.
@sa @cite purkait2018minimal section 3.1
 */
CV_EXPORTS int solve1LA(const VerticalSegment& segment, const SolverOptions& options, MinimalSolution solutions[1]);

/** @brief Pure translation along two walls (3-LA), exact.
@param segments two images of vertical lines on the left (or only) wall and, if twoWalls, a third one on the right wall.
@param twoWalls whether there is a third segment; otherwise lambda is 0.
@param options heading and limits.
@param solutions receives at most one solution; alpha is 0.
@return number of solutions; 0 for degenerate segments or lambda <= 0.
@sa @cite purkait2018minimal section 3.2
 */
CV_EXPORTS int solve3LA(const VerticalSegment* segments, bool twoWalls, const SolverOptions& options,
                        MinimalSolution solutions[1]);

/** @brief Yaw rate and translation along two walls (4-LA) to first order in alpha: the roots of a cubic.
@param segments three images of vertical lines on the left (or only) wall and, if twoWalls, a fourth one on the right
wall.
@param twoWalls whether there is a fourth segment; otherwise lambda is 0.
@param options heading and limits.
@param solutions receives at most three solutions.
@return number of solutions; 0 for degenerate segments.
@sa @cite purkait2018minimal section 3.3
 */
CV_EXPORTS int solve4LA(const VerticalSegment* segments, bool twoWalls, const SolverOptions& options,
                        MinimalSolution solutions[3]);

/** @brief Yaw rate and translation along two walls (4-LA) with the exact motion and the depth at the global-shutter
point.

The roots inside the limits of a polynomial of degree 6 or less in alpha, polished on the exact trigonometric equation.
@param segments three images of vertical lines on the left (or only) wall and, if twoWalls, a fourth one on the right
wall.
@param twoWalls whether there is a fourth segment; otherwise lambda is 0.
@param options heading and limits.
@param solutions receives at most six solutions; room for eight is kept.
@return number of solutions; 0 for degenerate segments.
@sa @cite purkait2018minimal section 3.4
 */
CV_EXPORTS int solve4LAExact(const VerticalSegment* segments, bool twoWalls, const SolverOptions& options,
                             MinimalSolution solutions[8]);

/** @brief Translation along two walls for a known yaw rate, exact.
@param segments two images of vertical lines on the left (or only) wall and, if twoWalls, a third one on the right wall.
@param twoWalls whether there is a third segment; otherwise lambda is 0.
@param alpha half of the yaw per unit of row time.
@param options heading and limits.
@param solutions receives at most one solution.
@return number of solutions; 0 for degenerate segments.
 */
CV_EXPORTS int solveKnownYawRate(const VerticalSegment* segments, bool twoWalls, double alpha,
                                 const SolverOptions& options, MinimalSolution solutions[1]);

/** @brief Yaw rate and walls for a known speed, exact: the paper's other gauge.
@param segments two images of vertical lines on the left (or only) wall and, if twoWalls, a third one on the right wall.
@param twoWalls whether there is a third segment; otherwise lambda is 0.
@param scaledSpeed known sqrt(B^2 + D^2): speed times RollingShutterCamera::secondsPerUnitTime over the distance of the
left (or only) wall.
@param options heading and limits.
@param solutions receives at most eight solutions.
@return number of solutions; 0 for degenerate segments.
 */
CV_EXPORTS int solveKnownSpeed(const VerticalSegment* segments, bool twoWalls, double scaledSpeed,
                               const SolverOptions& options, MinimalSolution solutions[8]);

/** @brief Yaw rate and speed for a known vanishing point of the walls, exact.
@param segments two images of vertical lines on the left (or only) wall and, if twoWalls, a third one on the right wall.
@param twoWalls whether there is a third segment; otherwise lambda is 0.
@param azimuth of the walls in the upright frame, radians; either of their two directions.
@param options heading and limits.
@param solutions receives at most six solutions.
@return number of solutions; 0 for degenerate segments.
 */
CV_EXPORTS int solveKnownWallDirection(const VerticalSegment* segments, bool twoWalls, double azimuth,
                                       const SolverOptions& options, MinimalSolution solutions[6]);

//! @}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SOLVERS_HPP
