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

        params.wallDistance = 3; // counts for more than a speed
        EXPECT_TRUE(setGivenScale(camera, params, prior, motion));
        EXPECT_EQ(SCALE_WALL, motion.scale);
        EXPECT_EQ(3, motion.wallDistance);
        params.wallDistance = 0;
    }
}

}} // namespace
