// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_TEST_DIRECTION_RESIDUAL_HPP
#define OPENCV_RSACKERMANN_TEST_DIRECTION_RESIDUAL_HPP

#include "../src/factors/direction_terms.hpp"
#include "../src/features/upright_segment.hpp"

namespace opencv_test {

/** How far a segment that isn't vertical is from pointing along the street, or across it, whichever is nearer.

Both ends are compensated on the plane on which they are seen; the distance between the line through them and the
vanishing point on the horizon, (D, 0, B) along and (-B, 0, D) across the street, is expressed as the lateral distance
between the ends for a focal length of 1 (doc/theory.md, "Estimation").

@param jacobian receives, unless it is null, the derivatives by the parameters.
*/
inline double directionResidual(const UprightSegment& c, const PreparedModel& model, double* jacobian)
{
    const RotatedEnd<double> u(c.u[0], c.u[1], c.timeU, model), v(c.v[0], c.v[1], c.timeV, model);
    const CompensatedEnd<double> a(u, model), b(v, model);
    const DirectionTerms<double> residual(Chord<double>(a.x, a.y, b.x, b.y), model.streetX, model.streetZ);
    if (jacobian)
        residual.derivatives(u, v, a, b, model, true, jacobian);
    return residual.value;
}

} // namespace opencv_test

#endif // OPENCV_RSACKERMANN_TEST_DIRECTION_RESIDUAL_HPP
