// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_posts_in_street.hpp"
#include "opencv2/imgproc.hpp"

// Scale and shift of a relative depth against the simulator, in a street with posts.

namespace opencv_test { namespace {

using simulation::PostsInStreet;

TEST(RSAckermann_DepthAlignment, finds_scale_and_shift)
{
    RNG rng(5);
    for (int round = 0; round < 8; round++)
    {
        PostsInStreet s(rng, round == 3 ? -1 : 1);
        const bool knowsSpeed = round % 2 != 0;
        s.prior.speed = s.speed;
        s.prior.speedSigma = knowsSpeed ? 0.2 : 0;
        DepthMap depth = s.relative(rng);
        AckermannMotion motion = s.motion;
        ASSERT_TRUE(s.align(depth, motion)) << round;
        const double unit = s.camera.secondsPerUnitTime();
        EXPECT_NEAR(s.yawRate, 2 * motion.alpha / unit, 0.03) << round;
        EXPECT_NEAR(1, motion.roadSlope / (s.speed * unit / s.camera.height), knowsSpeed ? 0.03 : 0.1) << round;
        EXPECT_LE(std::sqrt(motion.covariance(0, 0)), 0.0101 * unit / 2) << round;
        EXPECT_LT(motion.expectedResidual, 0.5 * motion.expectedRaw) << round;
        EXPECT_LT(motion.probabilityWorse, 0.1) << round;
    }
}

// Without values from elsewhere the verticals show yaw rate and scale, whichever way the car goes and whichever row is
// the reference.
TEST(RSAckermann_DepthAlignment, verticals_show_the_motion)
{
    RNG rng(11);
    for (const double direction : {1., -1.})
        for (const double reference : {0., 189.5, 379.})
        {
            SCOPED_TRACE(testing::Message() << direction << " " << reference);
            const int rounds = 6;
            double scale = 0;
            for (int round = 0; round < rounds; round++)
            {
                PostsInStreet s(rng, direction, 0, 700, 0, 160e-6, reference);
                s.params.gravitySigma = s.params.vehiclePitchSigma = 1e-4;
                s.camera.setRollPitch(s.roll, s.pitch);
                s.prior.yawRate = s.yawRate + 0.3;
                s.prior.yawRateSigma = 1;
                DepthMap depth = s.relative(rng);
                AckermannMotion motion = s.motion;
                ASSERT_TRUE(s.align(depth, motion));
                const double unit = s.camera.secondsPerUnitTime();
                EXPECT_NEAR(s.yawRate, 2 * motion.alpha / unit, 0.03);
                scale += motion.roadSlope / (s.speed * unit / s.camera.height) / rounds;
            }
            RecordProperty("scale", format("%.4f", scale));
            EXPECT_NEAR(1, scale, 0.02);
        }
}

// A camera that looks sideways sees the roll of the car as its own pitch.
TEST(RSAckermann_DepthAlignment, of_cameras_that_look_sideways)
{
    RNG rng(9);
    for (const double heading : {-1.2, 1.2})
    {
        PostsInStreet s(rng, 1, heading);
        DepthMap depth = s.relative(rng);
        AckermannMotion motion = s.motion;
        ASSERT_TRUE(s.align(depth, motion)) << heading;
        EXPECT_LE(s.relativeError(depth), 0.15) << heading;
        EXPECT_NEAR(s.yawRate, 2 * motion.alpha / s.camera.secondsPerUnitTime(), 0.03) << heading;
        EXPECT_NEAR(s.roll, motion.rollCorrection, 0.003) << heading;
        EXPECT_NEAR(s.pitch, motion.pitchCorrection, 0.006) << heading;
    }
}

// As far as the shutter displaces what the image shows: to first order, as that of a short read-out is.
TEST(RSAckermann_DepthAlignment, displacement)
{
    RNG rng(10);
    const double modes[][4] = {{1, 0, 700, 0},    {-1, 0, 700, 0},   {1, 0, 350, 0},
                               {1, 0, 350, 0.1},  {1, 0, 350, -0.1}, {1, 0, 350, 0.3},
                               {1, 0, 350, -0.3}, {1, 1.2, 500, 0},  {1, -1.2, 500, 0}};
    for (const auto& m : modes)
    {
        SCOPED_TRACE(testing::Message() << m[0] << " " << m[1] << " " << m[2] << " " << m[3]);
        PostsInStreet s(rng, m[0], m[1], m[2], m[3], 4e-6);
        s.prior.yawRateSigma = 0.002;
        s.prior.speed = s.speed;
        s.prior.speedSigma = 0.05;
        DepthMap depth = s.relative(rng);
        AckermannMotion motion = s.motion;
        ASSERT_TRUE(s.align(depth, motion));
        // Sideways the tilt is hardly known.
        EXPECT_NEAR(s.meanDisplacement(), motion.expectedRaw, (m[1] == 0 ? 0.04 : 0.12) * motion.expectedRaw);
    }
}

TEST(RSAckermann_DepthAlignment, without_a_yaw_rate_what_is_expected_is_uncertain)
{
    RNG rng(6);
    PostsInStreet s(rng);
    s.params.standingProbability = 1e-9; // that it stands is something else
    DepthMap depth = s.relative(rng), same = depth;
    AckermannMotion given = s.motion, free = s.motion;
    ASSERT_TRUE(s.align(depth, given));
    s.prior.yawRateSigma = 0;
    ASSERT_TRUE(s.align(same, free));
    EXPECT_GT(free.covariance(0, 0), 4 * given.covariance(0, 0));
    EXPECT_GT(free.expectedResidual, 1.5 * given.expectedResidual);
    EXPECT_LT(std::abs(2 * free.alpha / s.camera.secondsPerUnitTime() - s.yawRate),
              3 * 2 * std::sqrt(free.covariance(0, 0)) / s.camera.secondsPerUnitTime());
    // Normal errors of the correction exceed what they leave undone as often as it says.
    const int draws = 100000;
    int worse = 0;
    for (int i = 0; i < draws; i++)
    {
        const double error = rng.gaussian(free.expectedResidual / std::sqrt(2 / CV_PI));
        worse += std::abs(error) > std::abs(free.expectedRaw + error);
    }
    EXPECT_NEAR(double(worse) / draws, free.probabilityWorse, 0.2 * free.probabilityWorse);
    EXPECT_GT(free.probabilityWorse, 0.003);
}

// A car that turns as usual, and leans, is likelier than most that turn more: the likeliest motions hardly turn.
TEST(RSAckermann_DepthAlignment, yaw_rate_is_the_mean)
{
    RNG rng(15);
    double products = 0, squares = 0;
    for (int round = 0; round < 16; round++)
    {
        PostsInStreet s(rng);
        s.params.gravitySigma = CV_PI / 180;
        s.params.standingProbability = 1e-9;
        s.prior.yawRateSigma = 0;
        DepthMap depth = s.relative(rng);
        AckermannMotion motion = s.motion;
        ASSERT_TRUE(s.align(depth, motion)) << round;
        products += 2 * motion.alpha / s.camera.secondsPerUnitTime() * s.yawRate;
        squares += s.yawRate * s.yawRate;
    }
    RecordProperty("share", format("%.4f", products / squares));
    EXPECT_GT(products / squares, 0.1); // of the likeliest ones: 0.05
}

// What a yaw rate that is known otherwise has to do with the walls is a share of what it was.
TEST(RSAckermann_DepthAlignment, correlations_with_the_walls_stay)
{
    RNG rng(14);
    const PostsInStreet s(rng);
    DepthMap depth = s.relative(rng);
    const double correlations[] = {1, 0.5, -0.3, 0.1}, sigmas[] = {1, 0.2, 0.03, 2};
    AckermannMotion motion = s.motion;
    for (int i = 0; i < 4; i++)
    {
        motion.covariance(i, i) = sigmas[i] * sigmas[i];
        motion.covariance(0, i) = motion.covariance(i, 0) = correlations[i] * sigmas[0] * sigmas[i];
    }
    ASSERT_TRUE(s.align(depth, motion));
    const double sigma = std::sqrt(motion.covariance(0, 0));
    EXPECT_LT(sigma, 0.1 * sigmas[0]);
    for (int i = 1; i < 4; i++)
    {
        EXPECT_NEAR(correlations[i], motion.covariance(0, i) / (sigma * sigmas[i]), 1e-9) << i;
        EXPECT_EQ(motion.covariance(0, i), motion.covariance(i, 0)) << i;
    }
}

// Whatever the image shows without it, unless it doesn't depend on the motion.
TEST(RSAckermann_DepthAlignment, shows_a_motion_that_is_not_seen_without_it)
{
    RNG rng(12);
    for (const double direction : {1., -1.})
    {
        PostsInStreet s(rng, direction);
        s.prior.speed = s.speed;
        s.prior.speedSigma = 2;
        DepthMap depth = s.relative(rng);
        AckermannMotion motion;
        motion.status = MOTION_NOT_SIGNIFICANT;
        motion.expectedRaw = motion.expectedResidual = 1;
        ASSERT_TRUE(s.align(depth, motion));
        EXPECT_EQ(MOTION_OK, motion.status);
        EXPECT_EQ(MODEL_4LA, motion.model);
        EXPECT_EQ(direction, motion.direction);
        EXPECT_NEAR(s.yawRate, 2 * motion.alpha / s.camera.secondsPerUnitTime(), 0.03);
        EXPECT_LE(s.relativeError(depth), 0.1);
        EXPECT_LT(motion.expectedResidual, 0.5 * motion.expectedRaw);
        EXPECT_LT(motion.probabilityWorse, 0.1);
    }
}

// A camera at rest sees no motion with a depth, either, nor does one that may rest more often.
TEST(RSAckermann_DepthAlignment, rest_is_rest)
{
    RNG rng(13);
    for (int round = 0; round < 5; round++)
    {
        PostsInStreet s(rng, 0);
        s.prior = MotionPrior();
        s.motion = AckermannMotion();
        EXPECT_TRUE(s.isRefused(s.relative(rng).values)) << round;
    }
    PostsInStreet s(rng);
    s.prior = MotionPrior();
    DepthMap depth = s.relative(rng), same = depth;
    AckermannMotion moving = s.motion, doubtful = s.motion;
    ASSERT_TRUE(s.align(depth, moving));
    s.params.standingProbability = 0.99;
    ASSERT_TRUE(s.align(same, doubtful));
    EXPECT_EQ(moving.alpha, doubtful.alpha);
    EXPECT_LT(doubtful.expectedRaw, moving.expectedRaw);
    EXPECT_GT(doubtful.expectedResidual, moving.expectedResidual);
    EXPECT_GT(doubtful.probabilityWorse, moving.probabilityWorse);
}

TEST(RSAckermann_DepthAlignment, refuses_what_the_image_contradicts)
{
    RNG rng(7);
    for (int round = 0; round < 5; round++)
    {
        const PostsInStreet s(rng), other(rng);
        Mat mirrored, depths;
        flip(s.inverse, mirrored, 1);
        EXPECT_TRUE(s.isRefused(mirrored)) << round;
        EXPECT_TRUE(s.isRefused(other.inverse)) << round;
        EXPECT_TRUE(s.isRefused(-s.inverse)) << round;
        cv::divide(1, s.inverse + 0.01, depths);
        EXPECT_TRUE(s.isRefused(depths)) << round;
    }
}

TEST(RSAckermann_DepthAlignment, refuses_degenerate_depths)
{
    RNG rng(8);
    PostsInStreet s(rng);
    const Size size = s.camera.imageSize;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(s.isRefused(Mat(size, CV_32F, Scalar(3))));
    EXPECT_TRUE(s.isRefused(Mat::zeros(size, CV_32F)));
    EXPECT_TRUE(s.isRefused(Mat(size, CV_16U, Scalar(65535))));
    EXPECT_TRUE(s.isRefused(Mat(size, CV_32F, Scalar(nan))));
    EXPECT_TRUE(s.isRefused(Mat(size, CV_32F, Scalar(INFINITY))));
    Mat noise(size, CV_32F);
    rng.fill(noise, RNG::UNIFORM, 0, 1);
    EXPECT_TRUE(s.isRefused(noise));
    rng.fill(noise, RNG::UNIFORM, -FLT_MAX / 2, FLT_MAX / 2);
    EXPECT_TRUE(s.isRefused(noise));

    // A half of it suffices.
    DepthMap depth = s.relative(rng);
    depth.values(Rect(0, 0, size.width, size.height / 4)).setTo(nan);
    AckermannMotion motion = s.motion;
    EXPECT_TRUE(s.align(depth, motion));
    s.segments.clear();
    EXPECT_TRUE(s.isRefused(s.inverse));
}

}} // namespace opencv_test::
