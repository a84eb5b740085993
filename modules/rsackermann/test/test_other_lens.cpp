// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"
#include "../src/single/refinement.hpp"

// doc/theory.md, "Posterior": a lens that isn't known.

namespace opencv_test { namespace {

// A vertical about (x, y) at an angle to the vertical, of the given length.
UprightSegment makeVertical(double x, double y, double angle, double length)
{
    UprightSegment s = UprightSegment();
    const Vec3d half(length / 2 * std::sin(angle), length / 2 * std::cos(angle), 0);
    s.u = Vec3d(x, y, 1) - half;
    s.v = Vec3d(x, y, 1) + half;
    return s;
}

double angleOf(const UprightSegment& s)
{
    return std::asin((s.v[0] - s.u[0]) / cv::norm(s.v - s.u));
}

RefinementProblem makeProblem(const RollingShutterCamera& camera)
{
    RefinementProblem problem((MotionLimits(camera, AckermannEstimator::Params())));
    problem.uprightRotation = camera.uprightRotation;
    return problem;
}

TEST(RSAckermann_OtherLens, bearings)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.setRollPitch(0.05, -0.1);
    const Matx33d R = camera.uprightRotation;
    const double distortion = 0.2;
    RefinementProblem problem = makeProblem(camera);
    problem.verticals.assign(1, makeVertical(0.3, -0.2, 0.1, 0.3));
    problem.others.assign(1, makeVertical(-0.5, 0.1, 1.4, 0.2));
    const RefinementProblem before = problem;
    double logJacobian;
    ASSERT_TRUE(seeThroughOtherLens(distortion, problem, logJacobian));
    const auto expectBent = [&](const Vec3d& from, const Vec3d& to) {
        Vec3d a = R.t() * from, b = R.t() * to;
        a *= 1 / a[2];
        b *= 1 / b[2];
        const double r2 = a[0] * a[0] + a[1] * a[1];
        EXPECT_NEAR(a[0] * (1 + distortion * r2), b[0], 1e-12);
        EXPECT_NEAR(a[1] * (1 + distortion * r2), b[1], 1e-12);
        EXPECT_NEAR(1, to[2], 1e-12);
    };
    expectBent(before.verticals[0].u, problem.verticals[0].u);
    expectBent(before.verticals[0].v, problem.verticals[0].v);
    expectBent(before.others[0].u, problem.others[0].u);
    expectBent(before.others[0].v, problem.others[0].v);
}

// The derivative of the angle through the lens by the angle, about the middle of each segment.
TEST(RSAckermann_OtherLens, jacobian)
{
    RNG rng(5);
    const RollingShutterCamera camera = simulation::paperCamera();
    for (int i = 0; i < 1000; i++)
    {
        const double x = rng.uniform(-0.8, 0.8), y = rng.uniform(-0.4, 0.4), angle = rng.uniform(-0.1, 0.1),
                     length = rng.uniform(0.03, 0.3), distortion = rng.uniform(-0.15, 0.45), step = 1e-5;
        double bent[2], logJacobian, unused;
        for (int k = 0; k < 2; k++)
        {
            RefinementProblem turned = makeProblem(camera);
            turned.verticals.assign(1, makeVertical(x, y, angle + (k ? step : -step), length));
            ASSERT_TRUE(seeThroughOtherLens(distortion, turned, unused));
            bent[k] = std::sin(angleOf(turned.verticals[0]));
        }
        RefinementProblem problem = makeProblem(camera);
        problem.verticals.assign(1, makeVertical(x, y, angle, length));
        ASSERT_TRUE(seeThroughOtherLens(distortion, problem, logJacobian));
        EXPECT_NEAR((bent[1] - bent[0]) / (std::sin(angle + step) - std::sin(angle - step)), std::exp(logJacobian),
                    5e-3);
    }
}

TEST(RSAckermann_OtherLens, rays_that_would_cross)
{
    RefinementProblem problem = makeProblem(simulation::paperCamera());
    problem.verticals.assign(1, makeVertical(2, 0, 0, 0.2));
    double logJacobian;
    EXPECT_FALSE(seeThroughOtherLens(-0.15, problem, logJacobian));
}

// Verticals above the horizon that a lens bends, seen by a camera at rest, look like those of a fast drive between near
// walls through the assumed lens.
TEST(RSAckermann_OtherLens, standing_camera_with_a_wide_lens_is_not_corrected)
{
    const Size size(1280, 720);
    RollingShutterCamera assumed = RollingShutterCamera::fromFocal(size);
    assumed.setRollPitch(0, 0);
    RollingShutterCamera calibrated = assumed;
    ASSERT_GT(assumed.distortionSigma, 0);
    assumed.lineDelay = calibrated.lineDelay = 0.03 / size.height;
    calibrated.distortionSigma = 0;
    RollingShutterCamera camera(size, assumed.cameraMatrix, std::vector<double>({-0.3, 0, 0, 0}));
    int corrected = 0;
    for (int seed = 0; seed < 20; seed++)
    {
        RNG rng(seed);
        std::vector<Vec4f> segments;
        while (segments.size() < 200)
        {
            const double x = rng.uniform(-0.6, 0.6), y = rng.uniform(-0.4, -0.05);
            std::vector<Point3d> points;
            points.push_back(Point3d(x, y, 1));
            points.push_back(Point3d(x, y + rng.uniform(0.06, 0.2), 1));
            std::vector<Point2d> ends;
            projectPoints(points, Vec3d(), Vec3d(), camera.cameraMatrix, camera.distCoeffs, ends);
            const Vec4f s(float(ends[0].x + rng.gaussian(0.2)), float(ends[0].y), float(ends[1].x + rng.gaussian(0.2)),
                          float(ends[1].y));
            segments.push_back(s);
        }
        EXPECT_NE(MOTION_OK, AckermannEstimator::create(assumed)->estimate(segments).status) << seed;
        corrected += AckermannEstimator::create(calibrated)->estimate(segments).status == MOTION_OK;
    }
    EXPECT_GE(corrected, 15);
}

// A lens that may be bent takes nothing from a motion that the verticals show.
TEST(RSAckermann_OtherLens, motion_is_corrected_as_with_a_known_lens)
{
    RNG rng(3);
    for (int i = 0; i < 20; i++)
    {
        RollingShutterCamera camera = simulation::paperCamera();
        const double yawRate = rng.uniform(0.3, 0.6);
        const simulation::Simulator simulator = simulation::Simulator::fromMetric(camera, yawRate, 8, 6, 7, 0);
        const Mat segments = simulation::randomSegments(simulator, simulation::SegmentOptions(), rng).ends;
        MotionPrior prior;
        prior.yawRate = yawRate;
        prior.yawRateSigma = 0.02;
        const AckermannMotion known = AckermannEstimator::create(camera)->estimate(segments, noArray(), prior);
        camera.distortionSigma = 0.15;
        const AckermannMotion unknown = AckermannEstimator::create(camera)->estimate(segments, noArray(), prior);
        ASSERT_EQ(MOTION_OK, known.status);
        ASSERT_EQ(MOTION_OK, unknown.status);
        EXPECT_NEAR(known.alpha, unknown.alpha, 0.02 * std::abs(known.alpha));
    }
}

// No lens bends a vertical about the horizon: each explains a camera at rest as well as the given one does, by the
// probability of the lens, however much it stretches the others. So few may as well be a slow turn.
TEST(RSAckermann_OtherLens, verticals_about_the_horizon_tell_none)
{
    RollingShutterCamera camera = simulation::paperCamera();
    RNG rng(5);
    Mat segments;
    for (int i = 0; i < 60; i++)
    {
        const double x = rng.uniform(100., 540.), half = rng.uniform(40., 100.),
                     lean = 0.05 * camera.secondsPerUnitTime() * half + rng.gaussian(0.25);
        segments.push_back(Mat(Matx14d(x - lean, 189.5 - half, x + lean, 189.5 + half)));
    }
    AckermannEstimator::Params params;
    params.gravitySigma = 0;
    const auto expectedOf = [&](double distortionSigma, double oddsOfRest) {
        camera.distortionSigma = distortionSigma;
        params.standingProbability = oddsOfRest / (1 + oddsOfRest);
        return AckermannEstimator::create(camera, params)->estimate(segments).expectedRaw;
    };
    const double known = expectedOf(0, 1), all = expectedOf(0, 1 + 2 * std::exp(-0.5) + std::exp(-2.) + std::exp(-4.5));
    EXPECT_GT(known, 1.3 * all);
    for (const double sigma : {1e-6, 0.1, 0.3})
        EXPECT_NEAR(all, expectedOf(sigma, 1), 0.01 * all) << sigma;
}

}} // namespace
