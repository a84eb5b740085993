// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../scene.hpp"
#include "direction_residual.hpp"

namespace cv {
namespace rsackermann {

namespace {

struct ModelJets
{
    Jet alpha, B, D, lambda, G, street, cosRoll, sinRoll, cosPitch, sinPitch;
    Scene scene;

    ModelJets(const Model& m, double roadRatio)
        : alpha(Jet::variable(m[P_ALPHA], P_ALPHA)), B(Jet::variable(m[P_B], P_B)), D(Jet::variable(m[P_D], P_D)),
          lambda(Jet::variable(m[P_LAMBDA], P_LAMBDA)), street(Jet::variable(m[P_STREET], P_STREET))
    {
        const Jet roll = Jet::variable(m[P_ROLL], P_ROLL), pitch = Jet::variable(m[P_PITCH], P_PITCH);
        cosRoll = cos(roll);
        sinRoll = sin(roll);
        cosPitch = cos(pitch);
        sinPitch = sin(pitch);
        G = (m.direction * roadRatio) * hypot(B, D);
        scene.B = m[P_B];
        scene.D = m[P_D];
        scene.lambda = m[P_LAMBDA];
        scene.G = G.value;
        scene.direction = m.direction < 0 ? -1 : 1;
    }
};

struct JetPoint
{
    Jet x, y;
};

} // namespace

// The global-shutter point of a bearing on the plane on which it is seen (doc/theory.md, "Compensation").
static JetPoint compensate(const Vec3d& b, double t, const ModelJets& m, double heading)
{
    const Jet half = t * m.alpha, theta = 2 * half;
    const Jet c = cos(theta), s = sin(theta), c2 = cos(half + heading), s2 = sin(half + heading);
    const Jet tau = t * sinc(half);

    // rollRotation() * pitchRotation() * b, turned by theta
    const Jet yPitched = b[1] * m.cosPitch + b[2] * m.sinPitch, z = b[2] * m.cosPitch - b[1] * m.sinPitch;
    const Jet x = b[0] * m.cosRoll - m.sinRoll * yPitched, y = b[0] * m.sinRoll + m.cosRoll * yPitched;
    const Jet N = c * x + s * z, M = c * z - s * x;
    const Jet g = tau * (M * s2 - N * c2);

    const double X = N.value / M.value, Y = y.value / M.value;
    JetPoint p;
    switch (m.scene.nearest(X, Y))
    {
    case Scene::LEFT_WALL:
        p.x = (N + g * m.D) / (M + g * m.B);
        p.y = y * (1. - tau * (m.D - m.B * p.x) * c2) / M;
        break;
    case Scene::RIGHT_WALL:
        p.x = (N - g * m.lambda * m.D) / (M - g * m.lambda * m.B);
        p.y = y * (1. - tau * m.lambda * (m.B * p.x - m.D) * c2) / M;
        break;
    case Scene::ROAD:
        p.y = y / (M + tau * m.G * c2 * y);
        p.x = (N + g * m.G * p.y) / M;
        break;
    default:
        p.x = N / M;
        p.y = y / M;
    }
    return p;
}

// Lateral distance between a and b as seen from the vanishing point (vx, 0, vz).
static Jet lateralDistance(const JetPoint& a, const JetPoint& b, const Jet& vx, const Jet& vz)
{
    const Jet dx = vx - vz * (0.5 * (a.x + b.x)), dy = -(vz * (0.5 * (a.y + b.y)));
    return ((b.x - a.x) * dy - (b.y - a.y) * dx) / (hypot(dx, dy) + 1e-12);
}

Jet directionResidual(const Candidate& segment, const Model& model, double heading, double roadRatio, bool translates)
{
    const ModelJets m(model, roadRatio);
    const JetPoint u = compensate(segment.u, segment.timeU, m, heading), v = compensate(segment.v, segment.timeV, m, heading);
    const Jet vx = translates ? m.D : sin(m.street), vz = translates ? m.B : cos(m.street);
    const Jet along = lateralDistance(u, v, vx, vz), across = lateralDistance(u, v, -vz, vx);
    return std::abs(along.value) < std::abs(across.value) ? along : across;
}

}} // namespace cv::rsackermann
