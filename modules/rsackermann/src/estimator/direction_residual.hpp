// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_ESTIMATOR_DIRECTION_RESIDUAL_HPP
#define OPENCV_RSACKERMANN_SRC_ESTIMATOR_DIRECTION_RESIDUAL_HPP

#include "candidate.hpp"
#include "jet.hpp"

namespace cv {
namespace rsackermann {

/** How far a segment that isn't vertical is from pointing along the street, or across it, whichever is nearer.

Both ends are compensated on the plane on which they are seen; the distance between the line through them and the vanishing
point on the horizon, (D, 0, B) along and (-B, 0, D) across the street, is expressed as the lateral distance between the ends
for a focal length of 1 (doc/theory.md, "Estimation").

@param roadRatio distance of the left (or only) wall over the height of the camera: G = sqrt(B^2 + D^2) * roadRatio.
@param translates whether B and D say where the street goes; otherwise P_STREET does.
*/
Jet directionResidual(const Candidate& segment, const Model& model, double heading, double roadRatio, bool translates);

//! directionResidual() without the derivatives.
double directionResidualValue(const Candidate& segment, const Model& model, double heading, double roadRatio, bool translates);

//! The ends of a segment as the global-shutter camera sees them.
struct CompensatedSegment
{
    Point2d u, v;

    CompensatedSegment(const Candidate& segment, const Model& model, double heading, double roadRatio);

    //! directionResidual() for a street along the given azimuth.
    double residual(double street) const;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_ESTIMATOR_DIRECTION_RESIDUAL_HPP
