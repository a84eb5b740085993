// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_private_problem.hpp"
#include "../src/estimator/selection.hpp"
#include "../src/estimator/significance.hpp"
#include "../src/estimator/street_direction.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

//! A wide camera, so that it sees two walls also if it looks aside.
RollingShutterCamera wideCamera(double heading)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.cameraMatrix(0, 0) = camera.cameraMatrix(1, 1) = 180;
    camera.heading = heading;
    return camera;
}

Fit select(const RollingShutterCamera& camera, const Simulator& street, int model, RefinementProblem* problemAfter = 0)
{
    RNG rng(4);
    simulation::SegmentOptions options;
    options.count = 60;
    options.noise = 0.1;
    AckermannEstimator::Params params;
    params.gravitySigma = 0;
    params.model = model;
    params.wallDistance = 2.5;
    RefinementProblem problem = makeProblem(camera, params, simulation::randomSegments(street, options, rng).ends);
    MotionPrior nothing;
    problem.prior = PriorTerms(nothing, camera, params, problem.limits);
    const Fit fit = selectMotion(problem, params);
    if (problemAfter)
        *problemAfter = problem;
    return fit;
}

TEST(RSAckermann_Selection, two_walls_only_along_the_street)
{
    const double headings[] = {0, 40, 65, -40, -65, 180};
    const int expected[] = {2, 2, 1, 2, 1, 2};
    for (int k = 0; k < 6; k++)
    {
        const RollingShutterCamera camera = wideCamera(headings[k] * degree);
        const Simulator street = Simulator::fromMetric(camera, 0.3, 12, 2.5, 3, camera.heading);
        EXPECT_EQ(expected[k], select(camera, street, MODEL_3LA).hypothesis.walls) << headings[k];
    }
}

TEST(RSAckermann_Selection, only_the_model_that_is_asked_for)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Simulator street = Simulator::fromMetric(camera, 0.5, 20, 2.5, 3, 0);
    const int models[] = {MODEL_1LA, MODEL_3LA, MODEL_4LA};
    for (int k = 0; k < 3; k++)
        EXPECT_EQ(models[k], select(camera, street, models[k]).hypothesis.motion);
}

// Segments that are nearly exact: the noise becomes theirs, but walls aren't as plane as segments are straight.
TEST(RSAckermann_Selection, noise_is_measured_and_the_loss_widened)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    RefinementProblem problem((MotionLimits(camera, AckermannEstimator::Params())));
    select(camera, Simulator::fromMetric(camera, 0.5, 20, 2.5, 3, 0), MODEL_4LA, &problem);
    // Both ends of a segment err by 0.1 pixels, across a distance that the motion hardly changes.
    EXPECT_NEAR(0.1 * std::sqrt(2.), problem.sigma, 0.05);
    EXPECT_GE(problem.lossScale * problem.sigma, 0.6 * 3 * 0.25 - 1e-9);
    EXPECT_LT(problem.lossScale * problem.sigma, 3 * 0.25);
    EXPECT_GE(problem.lossScale, 3);
}

// Lines along a street at an angle, on the road and the walls, as a camera at rest sees them.
TEST(RSAckermann_StreetDirection, is_found_at_every_angle)
{
    const RollingShutterCamera camera = wideCamera(0);
    const double angles[] = {-0.75, -0.4, 0, 0.3, 0.75};
    for (int k = 0; k < 5; k++)
    {
        const Vec3d along(std::sin(angles[k]), 0, std::cos(angles[k])), across(along[2], 0, -along[0]);
        const Simulator still(camera, simulation::Drive(), simulation::Street());
        Mat segments(0, 4, CV_64F);
        for (int i = -4; i <= 4; i++)
            for (int side = 0; side < 2; side++)
            {
                // beside the car on the road, and above it on a wall
                const Vec3d offset = side ? Vec3d(across * (i < 0 ? -3. : 3.) + Vec3d(0, -0.4 * (std::abs(i) + 1), 0))
                                          : Vec3d(across * (0.8 * i) + Vec3d(0, 1.2, 0));
                Point2d u, v;
                if (!still.projectAt(offset + along * 5, 0, u) || !still.projectAt(offset + along * 12, 0, v) ||
                    !still.inside(u) || !still.inside(v))
                    continue;
                Mat row(Matx14d(u.x, u.y, v.x, v.y));
                segments.push_back(row);
            }
        RefinementProblem problem = makeProblem(camera, AckermannEstimator::Params(), segments);
        problem.directionSigma = 1;
        ASSERT_GE(problem.others.size(), 5u) << k;
        Model model;
        ASSERT_TRUE(startFromStreetDirection(problem, MotionHypothesis(MODEL_1LA, 0), model)) << k;
        EXPECT_NEAR(angles[k], model[P_STREET], 0.011) << k; // the step of the search
        // Walls keep the side on which they are.
        for (int sign = -1; sign <= 1; sign += 2)
        {
            Model walls;
            walls.direction = 1;
            walls[P_B] = 0.2 * sign;
            ASSERT_TRUE(startFromStreetDirection(problem, MotionHypothesis(MODEL_3LA, 1), walls)) << k;
            EXPECT_NEAR(0.2 * sign * std::cos(model[P_STREET]), walls[P_B], 0.01) << k;
            EXPECT_NEAR(0.2 * sign * std::sin(model[P_STREET]), walls[P_D], 0.01) << k;
        }
        problem.others.resize(4);
        problem.arrange();
        EXPECT_FALSE(startFromStreetDirection(problem, MotionHypothesis(MODEL_1LA, 0), model)) << k;
    }
}

TEST(RSAckermann_Significance, number_of_false_alarms)
{
    // N - m sizes, (N over k) sets, (k over m) samples, each of the other k - m inliers by chance
    EXPECT_NEAR(std::log(7. * 252 * 10 * 0.1 * 0.1), logFalseAlarms(10, 5, 3, 0.1), 1e-9);
    EXPECT_NEAR(std::log(19.) + std::log(20.) + std::log(19.) + 18 * std::log(0.25), logFalseAlarms(20, 19, 1, 0.25),
                1e-9);
    EXPECT_EQ(DBL_MAX, logFalseAlarms(20, 3, 3, 0.1));
    EXPECT_EQ(DBL_MAX, logFalseAlarms(20, 0, 1, 0.1));
}

}} // namespace
