// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_simulator.hpp"
#include "../src/single/inliers_and_scale.hpp"

namespace opencv_test { namespace {

// Forward and in reverse; a speed of the other direction gives none.
TEST(RSAckermann_Estimator, scale_by_a_given_speed)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    AckermannEstimator::Params params;
    for (int direction = -1; direction <= 1; direction += 2)
    {
        MotionPrior prior;
        prior.speed = direction * 5;
        prior.speedSigma = 1;
        AckermannMotion motion;
        motion.direction = direction;
        motion.wallSlope = 0.03;
        motion.wallOffset = 0.04;
        EXPECT_TRUE(setGivenScale(camera, params, prior, motion));
        EXPECT_EQ(SCALE_SPEED, motion.scale);
        EXPECT_NEAR(5 * camera.secondsPerUnitTime() / 0.05, motion.wallDistance, 1e-12);

        AckermannMotion other;
        other.direction = -direction;
        other.wallSlope = 0.05;
        EXPECT_FALSE(setGivenScale(camera, params, prior, other));
        EXPECT_EQ(0, other.wallDistance);

        params.wallDistance = 3; // counts for more than a speed that is known less
        EXPECT_TRUE(setGivenScale(camera, params, prior, motion));
        EXPECT_EQ(SCALE_WALL, motion.scale);
        EXPECT_EQ(3, motion.wallDistance);
        EXPECT_NEAR(0.1 * 3 * 0.05 / camera.secondsPerUnitTime(), motion.speedSigma, 1e-9);
        prior.speedSigma = 0.4;
        EXPECT_TRUE(setGivenScale(camera, params, prior, motion));
        EXPECT_EQ(SCALE_SPEED, motion.scale);
        EXPECT_EQ(0.4, motion.speedSigma);
        params.wallDistance = 0;
    }
}

// A street between walls, whose motion knows both: cameras that look along it see both, others one.
TEST(RSAckermann_Estimator, only_wall_that_is_seen)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.lineDelay = 30e-6;
    MetricMotion metric;
    metric.leftDistance = 4;
    metric.rightDistance = 10;
    for (const double speed : {8., -8.})
        for (const double heading : {0., 0.8, 1.6, 3.0, -0.8, -1.6, -3.0})
        {
            SCOPED_TRACE(format("%g m/s, heading %g", speed, heading));
            metric.speed = speed;
            metric.wallDirection = heading;
            const AckermannMotion both = AckermannMotion::fromMetric(camera, metric);
            AckermannMotion motion = both;
            motion.covariance = Matx44d::diag(Vec4d(1e-6, 1e-8, 1e-8, 0));
            const double sigma = std::sqrt(motion.metricCovariance(camera)(1, 1));
            keepSeenWalls(camera, motion);
            const bool seesBoth = std::abs(heading) < 0.5 || std::abs(heading) > 2.5;
            ASSERT_EQ(seesBoth ? both.wallRatio : 0, motion.wallRatio);
            motion.wallDistance = seesBoth || heading > 0 ? 4 : 10;
            double got;
            ASSERT_TRUE(motion.speed(camera, got));
            EXPECT_NEAR(speed, got, 1e-9);
            EXPECT_NEAR(sigma, std::sqrt(motion.metricCovariance(camera)(1, 1)), 1e-9);
            EXPECT_NEAR(both.delta(), motion.delta(), 1e-9 * std::abs(both.delta()));
        }
}

}} // namespace
