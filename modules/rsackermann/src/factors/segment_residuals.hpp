// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_SEGMENT_RESIDUALS_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_SEGMENT_RESIDUALS_HPP

#include "../features/upright_segment.hpp"
#include "prepared_model.hpp"

namespace cv { namespace rsackermann {

/** The difference of the compensated columns of the two ends of a candidate, p1(u) - p1(v), for a focal length of 1
(doc/theory.md, "Estimation").

@param wall receives the wall on which the candidate is seen: a Scene::Plane.
@param jacobian receives, unless it is null, the derivatives by the parameters.
*/
double verticalResidual(const UprightSegment& candidate, const PreparedModel& model, int& wall, double* jacobian);

inline double verticalResidual(const UprightSegment& candidate, const Model& model, const Heading& heading, int& wall,
                               double* jacobian)
{
    return verticalResidual(candidate, PreparedModel(model, heading), wall, jacobian);
}

//! The ends of a segment as the global-shutter camera sees them.
void compensateEnds(const UprightSegment& segment, const PreparedModel& model, Point2d& u, Point2d& v);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_SEGMENT_RESIDUALS_HPP
