// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_direction_residual.hpp"
#include "test_simulator.hpp"

namespace opencv_test { namespace {

using simulation::Drive;
using simulation::Street;
using simulation::Surface;

//! A street with its road and the images of lines along and across it.
struct RoadScene
{
    double heading, direction, roadRatio;
    Model model;
    Drive drive;
    Street street;
    Matx33d tilt; // from bearings of the camera to upright ones

    explicit RoadScene(RNG& rng)
    {
        heading = rng.uniform(-0.3, 0.3);
        direction = rng.uniform(-0.3, 0.3);
        roadRatio = rng.uniform(1., 3.);
        const double beta = rng.uniform(0.05, 0.5) * (rng.uniform(0, 2) ? 1 : -1), lambda = rng.uniform(0.5, 2.);
        model.direction = beta < 0 ? -1 : 1;
        model[P_ALPHA] = rng.uniform(-0.03, 0.03);
        model[P_B] = beta * std::cos(direction);
        model[P_D] = beta * std::sin(direction);
        model[P_LAMBDA] = lambda;
        model[P_ROLL] = rng.uniform(-0.03, 0.03);
        model[P_PITCH] = rng.uniform(-0.03, 0.03);
        model[P_STREET] = direction;
        drive = Drive(2 * model[P_ALPHA], beta, heading);
        street = Street(1, 1 / lambda, 1 / roadRatio, direction);
        AckermannMotion motion;
        motion.rollCorrection = model[P_ROLL];
        motion.pitchCorrection = model[P_PITCH];
        tilt = motion.uprightRotation(RollingShutterCamera::fromFocal(Size(640, 380)));
    }

    PreparedModel prepare(const Model& m, bool translates) const
    {
        return PreparedModel(m, heading, roadRatio, translates);
    }

    //! The plane that shows a point at a time and its bearing in the tilted camera.
    Surface see(const Vec3d& P, double t, Vec3d& bearing) const
    {
        const Vec3d inCamera = drive.toCamera(P, t);
        const Vec3d tilted = tilt.t() * inCamera;
        bearing = tilted * (1 / tilted[2]);
        return inCamera[2] > 0.1 && tilted[2] > 0.1 ? street.first(drive.position(t), drive.turn(inCamera, t))
                                                    : simulation::NOTHING;
    }

    /** The image of a line along (or, on the road, across) the street. Returns false if it isn't seen, or near the
    border of two planes. */
    bool randomLine(RNG& rng, bool across, UprightSegment& c, Surface& plane) const
    {
        const Point2d point = uniformPoint(rng, Point2d(-0.5, -0.3), Point2d(0.5, 0.3));
        const Vec3d ray(point.x, point.y, 1);
        plane = street.first(Vec3d(), ray);
        const double distance = street.distance(plane, Vec3d(), ray);
        if (plane == simulation::NOTHING || distance > 50 || (across && plane != simulation::ROAD))
            return false;
        const Vec3d along(std::sin(direction), 0, std::cos(direction)), side(along[2], 0, -along[0]);
        const Vec3d P = ray * distance, Q = P + (across ? side : along) * (rng.uniform(0.1, 0.4) * distance);
        c.timeU = rng.uniform(-0.25, 0.25);
        c.timeV = rng.uniform(-0.25, 0.25);
        c.length = 100;
        c.index = 0;
        if (see(P, c.timeU, c.u) != plane || see(Q, c.timeV, c.v) != plane)
            return false;
        const double margin = 0.05;
        for (int k = 0; k < 2; k++)
            for (int i = -1; i <= 1; i++)
                for (int j = -1; j <= 1; j++)
                    if (street.first(Vec3d(), (k ? Q : P) * (1 / (k ? Q : P)[2]) + Vec3d(i * margin, j * margin, 0)) !=
                        plane)
                        return false;
        return true;
    }
};

// Lines along the street, and across it on the road, point to their vanishing points at the true motion.
TEST(RSAckermann_DirectionResidual, is_zero_at_the_truth)
{
    RNG& rng = theRNG();
    int seen[4] = {}, crossing = 0;
    for (int i = 0; i < 20000; i++)
    {
        const RoadScene scene(rng);
        const bool across = rng.uniform(0, 2) == 1;
        UprightSegment c;
        Surface plane;
        if (!scene.randomLine(rng, across, c, plane))
            continue;
        ASSERT_NEAR(0, directionResidual(c, scene.prepare(scene.model, true), 0), 1e-12) << "plane " << plane;
        seen[plane]++;
        crossing += across;
    }
    EXPECT_GT(seen[simulation::LEFT], 500);
    EXPECT_GT(seen[simulation::RIGHT], 500);
    EXPECT_GT(seen[simulation::ROAD], 500);
    EXPECT_GT(crossing, 200);
}

// Without translation the street's azimuth is a parameter of its own.
TEST(RSAckermann_DirectionResidual, pure_rotation)
{
    RNG& rng = theRNG();
    int seen = 0;
    for (int i = 0; i < 5000; i++)
    {
        RoadScene scene(rng);
        scene.drive.speed = 0;
        UprightSegment c;
        Surface plane;
        if (!scene.randomLine(rng, false, c, plane))
            continue;
        Model model = scene.model;
        model[P_B] = model[P_D] = model[P_LAMBDA] = 0;
        model.direction = 0;
        ASSERT_NEAR(0, directionResidual(c, scene.prepare(model, false), 0), 1e-12);
        seen++;
    }
    EXPECT_GT(seen, 500);
}

// Fourth-order difference quotient with a step that is a fraction of a small change of the parameter.
double differenceQuotient(const UprightSegment& c, Model model, const RoadScene& scene, Parameter p, bool translates,
                          double fraction)
{
    const double h = fraction * (p == P_B || p == P_D ? std::hypot(model[P_B], model[P_D]) : 0.1);
    const double at = model[p], weights[] = {1. / 12, -2. / 3, 0, 2. / 3, -1. / 12};
    double sum = 0;
    for (int k = -2; k <= 2; k++)
    {
        model[p] = at + k * h;
        sum += weights[k + 2] * directionResidual(c, scene.prepare(model, translates), 0);
    }
    return sum / h;
}

TEST(RSAckermann_DirectionResidual, jacobian_agrees_with_differences)
{
    RNG& rng = theRNG();
    int compared[4][PARAMETERS] = {};
    for (int i = 0; i < 20000; i++)
    {
        const RoadScene scene(rng);
        UprightSegment c;
        Surface plane;
        if (!scene.randomLine(rng, false, c, plane))
            continue;
        // not at the minimum
        Model model = scene.model;
        model[P_ALPHA] += 0.002;
        model[P_D] += 0.02 * model[P_B];
        const bool translates = rng.uniform(0, 4) > 0;
        double jacobian[PARAMETERS];
        const double residual = directionResidual(c, scene.prepare(model, translates), jacobian);
        // near 0 a line at the horizon changes between along and across
        if (std::abs(residual) < 1e-4)
            continue;
        for (int p = 0; p < PARAMETERS; p++)
        {
            const double expected = differenceQuotient(c, model, scene, Parameter(p), translates, 1e-3);
            const double other = differenceQuotient(c, model, scene, Parameter(p), translates, 0.7e-3);
            // the residual jumps where the plane changes, so that the step matters
            if (std::abs(expected - other) > 1e-6 * std::abs(expected) + 1e-9)
                continue;
            ASSERT_NEAR(expected, jacobian[p], 1e-5 * std::abs(expected) + 1e-8)
                << "parameter " << p << ", plane " << plane;
            compared[plane][p]++;
        }
    }
    for (int p = 0; p < PARAMETERS; p++)
        EXPECT_GT(compared[simulation::ROAD][p], 300);
}

}} // namespace
