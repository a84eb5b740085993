// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../scene.hpp"
#include "direction_residual.hpp"

namespace cv {
namespace rsackermann {

using std::cos;
using std::sin;

namespace {

// T is double, or Jet where derivatives are wanted.
template <class T> struct ModelNumbers
{
    T alpha, B, D, lambda, G, street, cosRoll, sinRoll, cosPitch, sinPitch;
    Scene scene;

    ModelNumbers(const Model& m, double roadRatio)
        : alpha(makeVariable<T>(m[P_ALPHA], P_ALPHA)), B(makeVariable<T>(m[P_B], P_B)), D(makeVariable<T>(m[P_D], P_D)),
          lambda(makeVariable<T>(m[P_LAMBDA], P_LAMBDA)), street(makeVariable<T>(m[P_STREET], P_STREET))
    {
        const T roll = makeVariable<T>(m[P_ROLL], P_ROLL), pitch = makeVariable<T>(m[P_PITCH], P_PITCH);
        cosRoll = cos(roll);
        sinRoll = sin(roll);
        cosPitch = cos(pitch);
        sinPitch = sin(pitch);
        G = (m.direction * roadRatio) * length(B, D);
        scene.B = m[P_B];
        scene.D = m[P_D];
        scene.lambda = m[P_LAMBDA];
        scene.G = valueOf(G);
        scene.direction = m.direction < 0 ? -1 : 1;
    }
};

template <class T> struct PointOf
{
    T x, y;
};

} // namespace

// The global-shutter point of a bearing on the plane on which it is seen (doc/theory.md, "Compensation").
template <class T> static PointOf<T> compensate(const Vec3d& b, double t, const ModelNumbers<T>& m, const Heading& heading)
{
    const T half = t * m.alpha, cosHalf = cos(half), sinHalf = sin(half);
    const T c = 1. - 2 * (sinHalf * sinHalf), s = 2 * (sinHalf * cosHalf);
    const T c2 = heading.c * cosHalf - heading.s * sinHalf, s2 = heading.c * sinHalf + heading.s * cosHalf;
    const T tau = t * sinc(half);

    // rollRotation() * pitchRotation() * b, turned by theta
    const T yPitched = b[1] * m.cosPitch + b[2] * m.sinPitch, z = b[2] * m.cosPitch - b[1] * m.sinPitch;
    const T x = b[0] * m.cosRoll - m.sinRoll * yPitched, y = b[0] * m.sinRoll + m.cosRoll * yPitched;
    const T N = c * x + s * z, M = c * z - s * x;
    const T g = tau * (M * s2 - N * c2);

    const double X = valueOf(N) / valueOf(M), Y = valueOf(y) / valueOf(M);
    PointOf<T> p;
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
template <class T> static T lateralDistance(const PointOf<T>& a, const PointOf<T>& b, const T& vx, const T& vz)
{
    const T dx = vx - vz * (0.5 * (a.x + b.x)), dy = -(vz * (0.5 * (a.y + b.y)));
    return ((b.x - a.x) * dy - (b.y - a.y) * dx) / (length(dx, dy) + 1e-12);
}

template <class T> static T nearerDirection(const PointOf<T>& u, const PointOf<T>& v, const T& vx, const T& vz)
{
    const T along = lateralDistance<T>(u, v, vx, vz), across = lateralDistance<T>(u, v, -vz, vx);
    return std::abs(valueOf(along)) < std::abs(valueOf(across)) ? along : across;
}

template <class T> static T residual(const Candidate& segment, const Model& model, double heading, double roadRatio, bool translates)
{
    const ModelNumbers<T> m(model, roadRatio);
    const Heading direction(heading);
    const PointOf<T> u = compensate(segment.u, segment.timeU, m, direction), v = compensate(segment.v, segment.timeV, m, direction);
    return nearerDirection<T>(u, v, translates ? m.D : sin(m.street), translates ? m.B : cos(m.street));
}

Jet directionResidual(const Candidate& segment, const Model& model, double heading, double roadRatio, bool translates)
{
    return residual<Jet>(segment, model, heading, roadRatio, translates);
}

double directionResidualValue(const Candidate& segment, const Model& model, double heading, double roadRatio, bool translates)
{
    return residual<double>(segment, model, heading, roadRatio, translates);
}

CompensatedSegment::CompensatedSegment(const Candidate& segment, const Model& model, double heading, double roadRatio)
{
    const ModelNumbers<double> m(model, roadRatio);
    const Heading direction(heading);
    const PointOf<double> a = compensate(segment.u, segment.timeU, m, direction), b = compensate(segment.v, segment.timeV, m, direction);
    u = Point2d(a.x, a.y);
    v = Point2d(b.x, b.y);
}

double CompensatedSegment::residual(double street) const
{
    const PointOf<double> a = {u.x, u.y}, b = {v.x, v.y};
    return nearerDirection<double>(a, b, std::sin(street), std::cos(street));
}

}} // namespace cv::rsackermann
