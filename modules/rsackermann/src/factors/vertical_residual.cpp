// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../scene/planes.hpp"
#include "vertical_residual.hpp"
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

}} // namespace cv::rsackermann
