// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../compensation.hpp"
#include "../scene.hpp"
#include "vertical_residual.hpp"

namespace cv {
namespace rsackermann {

// A turned bearing and its derivatives by alpha, roll and pitch.
struct BearingWithDerivatives
{
    double value[3];                // N, M, G of TurnedBearing
    double derivative[PARAMETERS][3];

    BearingWithDerivatives(const Vec3d& bearing, double t, const PreparedModel& m, bool wantDerivatives)
    {
        const double alpha = m.model[P_ALPHA], cr = m.cosRoll, sr = m.sinRoll, cp = m.cosPitch, sp = m.sinPitch;
        const RowMotion row(alpha, m.heading, t);
        // rollRotation() * pitchRotation() * bearing
        const double y = cp * bearing[1] + sp * bearing[2];
        const Point2d turned(cr * bearing[0] - sr * y, cp * bearing[2] - sp * bearing[1]);
        const TurnedBearing b(turned, row);
        value[0] = b.N;
        value[1] = b.M;
        value[2] = b.G;
        if (!wantDerivatives)
            return;
        const double across = b.M * row.s2 - b.N * row.c2, along = b.M * row.c2 + b.N * row.s2;
        derivative[P_ALPHA][0] = 2 * t * b.M;
        derivative[P_ALPHA][1] = -2 * t * b.N;
        derivative[P_ALPHA][2] = t * t * sincDerivative(alpha * t) * across - row.tau * t * along;
        setTiltDerivative(P_ROLL, Point2d(-sr * bearing[0] - cr * y, 0), row);
        setTiltDerivative(P_PITCH, Point2d(-sr * (cp * bearing[2] - sp * bearing[1]), -sp * bearing[2] - cp * bearing[1]), row);
    }

    // N, M and G are linear in the bearing.
    void setTiltDerivative(Parameter p, const Point2d& change, const RowMotion& row)
    {
        const TurnedBearing b(change, row);
        derivative[p][0] = b.N;
        derivative[p][1] = b.M;
        derivative[p][2] = b.G;
    }

    double column(double B, double D) const { return (value[0] + value[2] * D) / (value[1] + value[2] * B); }

    // Adds sign times the derivatives of column() on the wall scale * (D - B x).
    void addColumnDerivatives(const Model& model, double scale, double sign, double* jacobian) const
    {
        const double B = scale * model[P_B], D = scale * model[P_D];
        const double denominator = value[1] + value[2] * B, p = column(B, D);
        const double byB = -p * value[2] / denominator, byD = value[2] / denominator;
        jacobian[P_B] += sign * scale * byB;
        jacobian[P_D] += sign * scale * byD;
        if (scale != 1)
            jacobian[P_LAMBDA] -= sign * (model[P_B] * byB + model[P_D] * byD);
        const Parameter others[3] = {P_ALPHA, P_ROLL, P_PITCH};
        for (int i = 0; i < 3; i++)
        {
            const double* d = derivative[others[i]];
            jacobian[others[i]] += sign * (d[0] + d[2] * D - p * (d[1] + d[2] * B)) / denominator;
        }
    }
};

double verticalResidual(const Candidate& candidate, const PreparedModel& prepared, int& wall, double* jacobian)
{
    const Model& model = prepared.model;
    const BearingWithDerivatives u(candidate.u, candidate.timeU, prepared, jacobian != 0);
    const BearingWithDerivatives v(candidate.v, candidate.timeV, prepared, jacobian != 0);

    // The nearest wall is the one with a positive depth where the candidate is seen by it.
    double scale = 1;
    wall = Scene::LEFT_WALL;
    const double middle = (u.column(model[P_B], model[P_D]) + v.column(model[P_B], model[P_D])) / 2;
    if (model.direction * (model[P_D] - model[P_B] * middle) < 0)
    {
        scale = -model[P_LAMBDA];
        wall = model[P_LAMBDA] > 0 ? Scene::RIGHT_WALL : Scene::INFINITE;
    }
    const double B = scale * model[P_B], D = scale * model[P_D];
    if (jacobian)
    {
        std::fill(jacobian, jacobian + PARAMETERS, 0.);
        u.addColumnDerivatives(model, scale, 1, jacobian);
        v.addColumnDerivatives(model, scale, -1, jacobian);
    }
    return u.column(B, D) - v.column(B, D);
}

}} // namespace cv::rsackermann
