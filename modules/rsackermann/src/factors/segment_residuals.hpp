// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_SEGMENT_RESIDUALS_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_SEGMENT_RESIDUALS_HPP

#include "../features/upright_segment.hpp"
#include "../scene/planes.hpp"
#include "direction_terms.hpp"
#include "vertical_terms.hpp"

namespace cv { namespace rsackermann {

/** The difference of the compensated columns of the two ends of a candidate, p1(u) - p1(v), for a focal length of 1
(doc/theory.md, "Estimation").

@param wall receives the wall on which the candidate is seen: a Scene::Plane.
@param jacobian receives, unless it is null, the derivatives by the parameters.
*/
inline double verticalResidual(const UprightSegment& c, const PreparedModel& model, int& wall, double* jacobian)
{
    const RotatedEnd<double> u(c.u[0], c.u[1], c.timeU, model), v(c.v[0], c.v[1], c.timeV, model);
    const VerticalTerms<double> residual(u, v, model);
    wall = residual.scale > 0 ? Scene::LEFT_WALL : model.lambda > 0 ? Scene::RIGHT_WALL : Scene::INFINITE;
    if (jacobian)
        residual.derivatives(u, v, model, true, jacobian);
    return residual.value;
}

inline double verticalResidual(const UprightSegment& candidate, const Model& model, const Heading& heading, int& wall,
                               double* jacobian)
{
    return verticalResidual(candidate, PreparedModel(model, heading), wall, jacobian);
}

//! The ends of a segment as the global-shutter camera sees them.
inline void compensateEnds(const UprightSegment& c, const PreparedModel& model, Point2d& u, Point2d& v)
{
    const CompensatedEnd<double> a(RotatedEnd<double>(c.u[0], c.u[1], c.timeU, model), model);
    const CompensatedEnd<double> b(RotatedEnd<double>(c.v[0], c.v[1], c.timeV, model), model);
    u = Point2d(a.x, a.y);
    v = Point2d(b.x, b.y);
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_SEGMENT_RESIDUALS_HPP
