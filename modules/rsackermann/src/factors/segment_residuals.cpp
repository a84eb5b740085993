// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../scene/planes.hpp"
#include "direction_terms.hpp"
#include "segment_residuals.hpp"
#include "vertical_terms.hpp"

namespace cv { namespace rsackermann {

double verticalResidual(const UprightSegment& c, const PreparedModel& model, int& wall, double* jacobian)
{
    const RotatedEnd<double> u(c.u[0], c.u[1], c.timeU, model), v(c.v[0], c.v[1], c.timeV, model);
    const VerticalTerms<double> residual(u, v, model);
    wall = residual.scale > 0 ? Scene::LEFT_WALL : model.lambda > 0 ? Scene::RIGHT_WALL : Scene::INFINITE;
    if (jacobian)
        residual.derivatives(u, v, model, true, jacobian);
    return residual.value;
}

void compensateEnds(const UprightSegment& c, const PreparedModel& model, Point2d& u, Point2d& v)
{
    const CompensatedEnd<double> a(RotatedEnd<double>(c.u[0], c.u[1], c.timeU, model), model);
    const CompensatedEnd<double> b(RotatedEnd<double>(c.v[0], c.v[1], c.timeV, model), model);
    u = Point2d(a.x, a.y);
    v = Point2d(b.x, b.y);
}

}} // namespace cv::rsackermann
