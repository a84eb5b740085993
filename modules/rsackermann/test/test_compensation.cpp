// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_simulator.hpp"

// Internals of the library that it doesn't export.
#include "../src/motion/compensation.hpp"
#include "../src/factors/rotated_end.hpp"
#include "../src/factors/segment_residuals.hpp"

namespace opencv_test { namespace {

using simulation::Drive;
using simulation::Street;
using simulation::Surface;

//! A random motion in a random street, in the units of the estimation.
struct RandomScene
{
    double heading;
    Model model;
    Drive drive;
    Street street;

    explicit RandomScene(RNG& rng)
    {
        const double headings[] = {0, CV_PI / 2, -CV_PI / 2, CV_PI, rng.uniform(-CV_PI, CV_PI)};
        heading = headings[rng.uniform(0, 5)];
        // walls at distance 1 and 1 / lambda
        const double direction = rng.uniform(-CV_PI, CV_PI);
        const double beta = rng.uniform(0.02, 0.6) * (rng.uniform(0, 2) ? 1 : -1);
        const double lambda = rng.uniform(0, 3) ? rng.uniform(0.4, 2.5) : 0;
        model.direction = beta < 0 ? -1 : 1;
        model[P_ALPHA] = rng.uniform(-0.1, 0.1);
        model[P_B] = beta * std::cos(direction);
        model[P_D] = beta * std::sin(direction);
        model[P_LAMBDA] = lambda;
        model[P_ROLL] = rng.uniform(-0.05, 0.05);
        model[P_PITCH] = rng.uniform(-0.05, 0.05);
        drive = Drive(2 * model[P_ALPHA], beta, heading);
        street = Street(1, lambda > 0 ? 1 / lambda : 0, 0, direction);
    }
};

//! A segment that is more or less vertical.
UprightSegment randomCandidate(RNG& rng)
{
    UprightSegment c;
    const Point2d u = uniformPoint(rng, Point2d(-0.6, -0.4), Point2d(0.6, 0.4)),
                  v = uniformPoint(rng, Point2d(-0.03, -0.4), Point2d(0.03, 0.4));
    c.u = Vec3d(u.x, u.y, 1);
    c.v = Vec3d(u.x + v.x, v.y, 1);
    c.timeU = rng.uniform(-0.25, 0.25);
    c.timeV = rng.uniform(-0.25, 0.25);
    c.length = 100;
    c.index = 0;
    return c;
}

//! The column of the global-shutter image at which a bearing's point is, if it is on the plane.
bool trueColumn(const RandomScene& scene, Surface plane, const Vec3d& bearing, double t, double& column)
{
    const Vec3d origin = scene.drive.position(t), ray = scene.drive.turn(bearing, t);
    const double distance = scene.street.distance(plane, origin, ray);
    const Vec3d P = origin + distance * ray;
    if (!(distance < 1e3) || !(P[2] > 0.1))
        return false;
    column = P[0] / P[2];
    return true;
}

// sin(x)/x is the product of the cosines of halved angles, and its derivative that times the sum of their tangents. The
// rounding of sixty factors is below 1e-14.
TEST(RSAckermann_Compensation, derivative_of_sinc)
{
    for (double x = -LARGEST_IN_SERIES; x <= LARGEST_IN_SERIES; x += 1e-4)
    {
        double product = 1, sum = 0;
        for (int k = 1; k < 60; k++)
        {
            product *= std::cos(std::ldexp(x, -k));
            sum -= std::ldexp(std::tan(std::ldexp(x, -k)), -k);
        }
        ASSERT_NEAR(product * sum, sincDerivativeSeries(x), 1e-14 * std::abs(x)) << x;
    }
    double sincX, cosX, slope;
    sincTerms(2., sincX, cosX, slope);
    EXPECT_DOUBLE_EQ(std::sin(2.) / 2, sincX);
    EXPECT_DOUBLE_EQ(std::cos(2.), cosX);
    EXPECT_DOUBLE_EQ(std::cos(2.) / 2 - std::sin(2.) / 4, slope);
}

TEST(RSAckermann_Compensation, series_of_sinc_and_cos)
{
    for (double x = -0.6; x < 0.6; x += 1e-4)
    {
        double sincX, cosX;
        sincAndCos(x, sincX, cosX);
        ASSERT_NEAR(x == 0 ? 1 : std::sin(x) / x, sincX, 4e-16) << x;
        ASSERT_NEAR(std::cos(x), cosX, 4e-16) << x;
    }
    double sincX, cosX;
    sincAndCos(0, sincX, cosX);
    EXPECT_EQ(1, sincX);
    EXPECT_EQ(1, cosX);
}

TEST(RSAckermann_Compensation, row_motion_agrees_with_integration)
{
    RNG& rng = theRNG();
    for (int i = 0; i < 10000; i++)
    {
        const double alpha = rng.uniform(-0.25, 0.25), heading = rng.uniform(-CV_PI, CV_PI), t = rng.uniform(-0.5, 0.5);
        const RowMotion row(alpha, heading, t);
        const Drive drive(2 * alpha, 1, heading);
        ASSERT_LT(cv::norm(drive.position(t) - row.tau * Vec3d(row.s2, 0, row.c2)), 1e-13);
        ASSERT_LT(cv::norm(drive.turn(Vec3d(0.3, 0.1, 1), t) - Vec3d(0.3 * row.c + row.s, 0.1, row.c - 0.3 * row.s)),
                  1e-15);
    }
}

// p1 of a rolling-shutter point is the column of its point in space at the reference row.
TEST(RSAckermann_Compensation, column_agrees_with_ray_casting)
{
    RNG& rng = theRNG();
    int compared = 0;
    for (int i = 0; i < 10000; i++)
    {
        const RandomScene scene(rng);
        const Point2d direction = uniformPoint(rng, Point2d(-0.6, -0.4), Point2d(0.6, 0.4));
        const Vec3d bearing(direction.x, direction.y, 1);
        const double t = rng.uniform(-0.25, 0.25);
        for (int plane = simulation::LEFT; plane <= simulation::RIGHT; plane++)
        {
            double expected;
            if (!trueColumn(scene, Surface(plane), bearing, t, expected))
                continue;
            const double scale = plane == simulation::LEFT ? 1 : -scene.model[P_LAMBDA];
            const double length = rng.uniform(0.5, 2.);
            const RotatedBearing rotated(HorizontalBearing(length * bearing[0], length * bearing[2]),
                                         RowMotion(scene.model[P_ALPHA], scene.heading, t));
            const double B = scale * scene.model[P_B], D = scale * scene.model[P_D];
            ASSERT_NEAR(expected, rotated.column(B, D), 1e-12 * (1 + expected * expected));
            compared++;
        }
    }
    EXPECT_GT(compared, 5000);
}

// The residual is the difference of the true columns, on the wall that the segment is seen on.
TEST(RSAckermann_Compensation, residual_agrees_with_ray_casting)
{
    RNG& rng = theRNG();
    int compared[4] = {0, 0, 0, 0};
    for (int i = 0; i < 20000; i++)
    {
        const RandomScene scene(rng);
        const UprightSegment candidate = randomCandidate(rng);
        AckermannMotion tilt;
        tilt.rollCorrection = scene.model[P_ROLL];
        tilt.pitchCorrection = scene.model[P_PITCH];
        const Matx33d R = tilt.uprightRotation(RollingShutterCamera::fromFocal(Size(640, 380)));
        const Vec3d u = R * candidate.u, v = R * candidate.v;
        for (int plane = simulation::LEFT; plane <= simulation::RIGHT; plane++)
        {
            double a, b;
            if (!trueColumn(scene, Surface(plane), u, candidate.timeU, a) ||
                !trueColumn(scene, Surface(plane), v, candidate.timeV, b))
                continue;
            int wall = -1;
            const double residual = verticalResidual(candidate, scene.model, scene.heading, wall, 0);
            ASSERT_EQ(plane, wall);
            ASSERT_NEAR(a - b, residual, 1e-12 * (1 + a * a + b * b));
            compared[plane]++;
        }
    }
    EXPECT_GT(compared[simulation::LEFT], 1000);
    EXPECT_GT(compared[simulation::RIGHT], 1000);
}

// Central differences of the fourth order.
double difference(const UprightSegment& candidate, Model model, double heading, Parameter parameter, bool& sameWall)
{
    const double h = 1e-3, at = model[parameter];
    const double weights[] = {1. / 12, -2. / 3, 0, 2. / 3, -1. / 12};
    int wall, first = -1;
    verticalResidual(candidate, model, heading, first, 0);
    double sum = 0;
    for (int k = -2; k <= 2; k++)
    {
        model[parameter] = at + k * h;
        sum += weights[k + 2] * verticalResidual(candidate, model, heading, wall, 0);
        sameWall = sameWall && wall == first;
    }
    return sum / h;
}

TEST(RSAckermann_Compensation, jacobian_agrees_with_differences)
{
    RNG& rng = theRNG();
    int compared[4][PARAMETERS] = {};
    for (int i = 0; i < 20000; i++)
    {
        RandomScene scene(rng);
        if (rng.uniform(0, 10) == 0)
            scene.model[P_ALPHA] = 0;
        const UprightSegment candidate = randomCandidate(rng);
        double jacobian[PARAMETERS];
        int wall;
        const double residual = verticalResidual(candidate, scene.model, scene.heading, wall, jacobian);
        // near the vanishing point a step may change the wall; close to the camera the columns run away
        if (std::abs(residual) > 1)
            continue;
        for (int p = 0; p < PARAMETERS; p++)
        {
            bool sameWall = true;
            const double expected = difference(candidate, scene.model, scene.heading, Parameter(p), sameWall);
            // lambda = 0 stands for an absent wall
            if (!sameWall || (p == P_LAMBDA && scene.model[P_LAMBDA] == 0))
                continue;
            ASSERT_NEAR(expected, jacobian[p], 1e-5 * std::abs(expected) + 1e-10) << "parameter " << p;
            compared[wall][p]++;
        }
    }
    for (int p = 0; p < PARAMETERS; p++)
    {
        EXPECT_GT(compared[simulation::LEFT][p], 1000) << p;
        EXPECT_GT(compared[simulation::RIGHT][p], 1000) << p;
    }
}

// Without walls the residual is that of a pure rotation and says nothing about walls.
TEST(RSAckermann_Compensation, residual_at_infinity)
{
    RNG& rng = theRNG();
    int seen = 0;
    for (int i = 0; i < 1000; i++)
    {
        RandomScene scene(rng);
        scene.model[P_LAMBDA] = scene.model[P_ROLL] = scene.model[P_PITCH] = 0;
        const UprightSegment c = randomCandidate(rng);
        double jacobian[PARAMETERS];
        int wall;
        const double residual = verticalResidual(c, scene.model, scene.heading, wall, jacobian);
        if (wall != simulation::NOTHING)
            continue;
        const double a = scene.model[P_ALPHA];
        ASSERT_NEAR(std::tan(std::atan(c.u[0]) + 2 * a * c.timeU) - std::tan(std::atan(c.v[0]) + 2 * a * c.timeV),
                    residual, 1e-14);
        ASSERT_EQ(0, jacobian[P_B]);
        ASSERT_EQ(0, jacobian[P_D]);
        seen++;
    }
    EXPECT_GT(seen, 100);
}

// Which decides whether it may see two walls: nearer to the car's course than 60 degrees.
TEST(RSAckermann_Compensation, camera_looks_along_the_course_or_across_it)
{
    for (int degrees = -179; degrees <= 180; degrees += 2)
    {
        const double fromCourse = std::min(std::abs(degrees), 180 - std::abs(degrees));
        EXPECT_EQ(fromCourse < 60, Heading(degrees * CV_PI / 180).looksAlong()) << degrees;
    }
}

}} // namespace
