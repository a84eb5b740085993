// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

const double trueYawRate = 40 * degree, trueSpeed = 20, trueDirection = 0.03;

//! The errors in many frames of the same street.
struct Errors
{
    std::vector<double> yawRate, speed, direction, displacement;
};

double largest(const std::vector<double>& values)
{
    return *std::max_element(values.begin(), values.end());
}

Simulator street()
{
    return Simulator::fromMetric(simulation::paperCamera(), trueYawRate, trueSpeed, 2.5, 3, trueDirection);
}

AckermannMotion estimate(const Simulator& truth, int seed, const MotionPrior& prior)
{
    AckermannEstimator::Params params;
    params.wallDistance = 2.5;
    params.gravitySigma = 0;
    simulation::SegmentOptions options;
    options.inlierRatio = 0.8;
    options.noise = 0.15;
    RNG rng(seed + 1);
    return AckermannEstimator::create(truth.camera, params)
        ->estimate(simulation::randomSegments(truth, options, rng).ends, noArray(), prior);
}

Errors errors(const MotionPrior& prior)
{
    const Simulator truth = street();
    Errors result;
    for (int seed = 0; seed < 101; seed++)
    {
        const AckermannMotion m = estimate(truth, seed, prior);
        EXPECT_EQ(MOTION_OK, m.status) << "seed " << seed;
        double yawRate, speed;
        m.yawRate(truth.camera, yawRate);
        m.speed(truth.camera, speed);
        result.yawRate.push_back(std::abs(yawRate - trueYawRate));
        result.speed.push_back(std::abs(speed - trueSpeed));
        result.direction.push_back(std::abs(std::atan(m.delta()) - trueDirection));
        result.displacement.push_back(truth.meanDisplacement(Simulator::fromMotion(truth.camera, m)));
    }
    return result;
}

//! A given value is as exact as it was given, and it helps.
void expectHelps(const MotionPrior& prior, std::vector<double> Errors::*given, double sigma)
{
    const Errors with = errors(prior), without = errors(MotionPrior());
    EXPECT_LT(largest(with.*given), 3 * sigma);
    EXPECT_LT(median(with.*given), median(without.*given));
    EXPECT_LT(median(with.displacement), median(without.displacement));
}

TEST(RSAckermann_Prior, speed)
{
    MotionPrior prior;
    prior.speed = trueSpeed;
    prior.speedSigma = 0.5;
    expectHelps(prior, &Errors::speed, prior.speedSigma);
}

TEST(RSAckermann_Prior, yaw_rate)
{
    MotionPrior prior;
    prior.yawRate = trueYawRate;
    prior.yawRateSigma = 0.5 * degree;
    expectHelps(prior, &Errors::yawRate, prior.yawRateSigma);
}

TEST(RSAckermann_Prior, wall_direction)
{
    MotionPrior prior;
    prior.wallDirection = trueDirection;
    prior.wallDirectionSigma = 0.2 * degree;
    expectHelps(prior, &Errors::direction, prior.wallDirectionSigma);
}

TEST(RSAckermann_Prior, all_together)
{
    MotionPrior prior;
    prior.speed = trueSpeed;
    prior.speedSigma = 0.5;
    prior.yawRate = trueYawRate;
    prior.yawRateSigma = 0.5 * degree;
    prior.wallDirection = trueDirection;
    prior.wallDirectionSigma = 0.2 * degree;
    const Errors with = errors(prior);
    EXPECT_LT(largest(with.speed), 3 * prior.speedSigma);
    EXPECT_LT(largest(with.yawRate), 3 * prior.yawRateSigma);
    EXPECT_LT(largest(with.direction), 3 * prior.wallDirectionSigma);
}

// A wrong prior with a large sigma loses against the segments.
TEST(RSAckermann_Prior, weak_prior)
{
    MotionPrior prior;
    prior.speed = 2 * trueSpeed;
    prior.speedSigma = 20 * trueSpeed;
    prior.yawRate = -trueYawRate;
    prior.yawRateSigma = 20 * trueYawRate;
    const Errors with = errors(prior), without = errors(MotionPrior());
    EXPECT_LT(median(with.displacement), 1.1 * median(without.displacement));
}

// A speed that leaves open whether the car stands doesn't make it stand where the distance of a wall is given, too.
TEST(RSAckermann_Prior, vague_speed_beside_a_given_wall)
{
    RNG rng(8);
    int count = 0, beyond = 0;
    for (int i = 0; i < 60; i++)
    {
        const double wall = rng.uniform(3., 8.), yawRate = rng.gaussian(5) * degree, speed = rng.uniform(1., 6.);
        Simulator truth =
            Simulator::fromMetric(simulation::paperCamera(), yawRate, speed, wall, rng.uniform(3., 8.), 0);
        simulation::SegmentOptions options;
        options.noise = 0.3;
        const Mat segments = simulation::randomSegments(truth, options, rng).ends;
        RollingShutterCamera camera = truth.camera;
        camera.setRollPitch(rng.gaussian(1) * degree, rng.gaussian(0.3) * degree);
        AckermannEstimator::Params params;
        params.wallDistance = wall;
        MotionPrior prior;
        prior.speedSigma = 2;
        prior.speed = std::max(speed + rng.gaussian(prior.speedSigma), 0.1);
        const AckermannMotion m = AckermannEstimator::create(camera, params)->estimate(segments, noArray(), prior);
        double found;
        if (m.status != MOTION_OK || !m.yawRate(camera, found))
            continue;
        count++;
        beyond += std::abs(found - yawRate) > 3 * std::sqrt(m.metricCovariance(camera)(0, 0));
    }
    EXPECT_GT(count, 30);
    EXPECT_LE(beyond, 0.03 * count);
}

// A yaw rate that is hardly known is as good as none, and no reason to correct anything.
TEST(RSAckermann_Prior, vague_yaw_rate_is_none)
{
    RNG rng(9);
    for (int i = 0; i < 30; i++)
    {
        const Simulator truth =
            Simulator::fromMetric(simulation::paperCamera(), rng.gaussian(5) * degree, rng.uniform(0., 20.),
                                  rng.uniform(3., 8.), rng.uniform(3., 8.), 0);
        const Mat segments = simulation::randomSegments(truth, simulation::SegmentOptions(), rng).ends;
        MotionPrior vague;
        vague.yawRate = rng.gaussian(1);
        vague.yawRateSigma = 30;
        const Ptr<AckermannEstimator> estimator = AckermannEstimator::create(truth.camera);
        const AckermannMotion expected = estimator->estimate(segments),
                              motion = estimator->estimate(segments, noArray(), vague);
        ASSERT_EQ(expected.status, motion.status) << i;
        EXPECT_NEAR(expected.expectedRaw, motion.expectedRaw, 0.02 * expected.expectedRaw) << i;
        EXPECT_NEAR(expected.alpha, motion.alpha, 0.1 * std::sqrt(expected.covariance(0, 0))) << i;
        EXPECT_FALSE(motion.contradictsPrior) << i;
    }
}

// Exact ones and those that say nothing are values as others.
TEST(RSAckermann_Prior, yaw_rates_of_any_sigma)
{
    RNG rng(10);
    const Simulator truth = Simulator::fromMetric(simulation::paperCamera(), 0.2, 10, 4, 5, 0);
    const Mat segments = simulation::randomSegments(truth, simulation::SegmentOptions(), rng).ends;
    for (const double sigma : {1e-29, 1e-12, 1e-8, 1e8, 1e29})
    {
        MotionPrior prior;
        prior.yawRate = 0.2;
        prior.yawRateSigma = sigma;
        const AckermannMotion motion = AckermannEstimator::create(truth.camera)->estimate(segments, noArray(), prior);
        ASSERT_EQ(MOTION_OK, motion.status) << sigma;
        EXPECT_NEAR(0.1 * truth.camera.secondsPerUnitTime(), motion.alpha,
                    3 * std::sqrt(motion.covariance(0, 0)) + 1e-9);
    }
}

// Limits are for what isn't given.
TEST(RSAckermann_Prior, beyond_the_limits)
{
    for (const int side : {-1, 1})
    {
        SCOPED_TRACE(side);
        const double yawRate = side * 200 * degree, speed = side * 80;
        const Simulator truth = Simulator::fromMetric(simulation::paperCamera(), yawRate, speed, 12, 15, 0);
        RNG rng(11);
        const Mat segments = simulation::randomSegments(truth, simulation::SegmentOptions(), rng).ends;
        AckermannEstimator::Params params;
        params.wallDistance = 12;
        ASSERT_GT(std::abs(yawRate), params.maxYawRate);
        ASSERT_GT(std::abs(speed), params.maxSpeed);
        MotionPrior prior;
        prior.yawRate = 1.01 * yawRate;
        prior.yawRateSigma = 0.01 * std::abs(yawRate);
        prior.speed = 1.01 * speed;
        prior.speedSigma = 0.01 * std::abs(speed);
        const AckermannMotion motion =
            AckermannEstimator::create(truth.camera, params)->estimate(segments, noArray(), prior);
        double found;
        ASSERT_EQ(MOTION_OK, motion.status);
        EXPECT_FALSE(motion.contradictsPrior);
        ASSERT_TRUE(motion.yawRate(truth.camera, found));
        EXPECT_NEAR(yawRate, found, 0.03 * std::abs(yawRate));
        ASSERT_TRUE(motion.speed(truth.camera, found));
        EXPECT_NEAR(speed, found, 0.03 * std::abs(speed));
    }
}

// Metric values without a scale can't be used.
TEST(RSAckermann_Prior, without_scale)
{
    const Simulator truth = street();
    simulation::SegmentOptions options;
    RNG rng(1);
    const Mat segments = simulation::randomSegments(truth, options, rng).ends;
    RollingShutterCamera camera = truth.camera;
    camera.lineDelay = 0;
    const Ptr<AckermannEstimator> estimator = AckermannEstimator::create(camera);
    MotionPrior prior;
    prior.speed = -10;
    prior.speedSigma = 0.1;
    prior.yawRate = -1;
    prior.yawRateSigma = 0.01;
    EXPECT_EQ(estimator->estimate(segments).alpha, estimator->estimate(segments, noArray(), prior).alpha);
}

typedef void (*Spoil)(MotionPrior&);
typedef std::pair<const char*, Spoil> BadField;
class RSAckermann_PriorCheck : public testing::TestWithParam<BadField>
{
};
const BadField badFields[] = {
    BadField("speed", [](MotionPrior& p) { p.speed = NaN; }),
    BadField("speedSigma", [](MotionPrior& p) { p.speedSigma = -1; }),
    BadField("speedSigma", [](MotionPrior& p) { p.speedSigma = NaN; }),
    BadField("yawRate", [](MotionPrior& p) { p.yawRate = infinity; }),
    BadField("yawRateSigma", [](MotionPrior& p) { p.yawRateSigma = -1; }),
    BadField("yawRateSigma", [](MotionPrior& p) { p.yawRateSigma = infinity; }),
    BadField("wallDirection", [](MotionPrior& p) { p.wallDirection = NaN; }),
    BadField("wallDirectionSigma", [](MotionPrior& p) { p.wallDirectionSigma = -1; }),
};
INSTANTIATE_TEST_CASE_P(/*nothing*/, RSAckermann_PriorCheck, testing::ValuesIn(badFields));

TEST_P(RSAckermann_PriorCheck, names_the_field)
{
    MotionPrior prior;
    EXPECT_NO_THROW(prior.check());
    GetParam().second(prior);
    std::string message;
    try
    {
        prior.check();
    }
    catch (const cv::Exception& e)
    {
        message = e.err;
    }
    EXPECT_NE(std::string::npos, message.find(GetParam().first)) << message;
    const Ptr<AckermannEstimator> estimator = AckermannEstimator::create(simulation::paperCamera());
    EXPECT_THROW(estimator->estimate(Mat(), noArray(), prior), cv::Exception);
}

// Without the distance of a wall, too, a speed is reported with the sign that was given, or not at all.
TEST(RSAckermann_Prior, sign_of_a_given_speed)
{
    for (double height : {0., 1.2})
        for (int given = -1; given <= 1; given += 2)
            for (int driven = -1; driven <= 1; driven += 2)
            {
                RollingShutterCamera camera = simulation::paperCamera();
                camera.height = height;
                const Simulator truth = Simulator::fromMetric(camera, 0, driven * trueSpeed, 2.5, 3, 0);
                simulation::SegmentOptions options;
                options.noise = 0.15;
                RNG rng(7);
                const Mat segments = simulation::randomSegments(truth, options, rng).ends;
                MotionPrior prior;
                prior.speed = given * trueSpeed;
                prior.speedSigma = 0.5;
                const AckermannMotion m = AckermannEstimator::create(camera)->estimate(segments, noArray(), prior);
                const std::string name = cv::format("given %d, driven %d, height %g", given, driven, height);
                double speed = 0;
                if (m.speed(camera, speed))
                {
                    EXPECT_NEAR(given * trueSpeed, speed, 1e-9) << name;
                }
                EXPECT_GE(m.roadSlope * m.direction, 0) << name;
                if (given == driven)
                {
                    EXPECT_EQ(driven, m.direction) << name;
                    EXPECT_EQ(SCALE_SPEED, m.scale) << name;
                }
            }
}

TEST(RSAckermann_Prior, contradictions)
{
    struct
    {
        double speed, yawRate; // given less true; 0: not given
        bool wallIsKnown, contradicts;
    } const cases[] = {{0, 0, true, false},
                       {0.3, 0, true, false},
                       {-2 * trueSpeed, 0, true, true},
                       {20, 0, true, true},
                       {0.3, 0, false, false},
                       {-2 * trueSpeed, 0, false, true},
                       {0, 0.3 * degree, true, false},
                       {0, -80 * degree, true, true},
                       {0.3, -80 * degree, true, true}};
    for (const auto& c : cases)
        for (int seed = 0; seed < 5; seed++)
        {
            const Simulator truth = street();
            AckermannEstimator::Params params;
            params.wallDistance = c.wallIsKnown ? 2.5 : 0;
            params.gravitySigma = 0; // or the roll explains the yaw rate as well
            simulation::SegmentOptions options;
            options.inlierRatio = 0.8;
            options.noise = 0.15;
            RNG rng(seed + 1);
            MotionPrior prior;
            prior.speed = trueSpeed + c.speed;
            prior.speedSigma = c.speed == 0 ? 0 : 0.5;
            prior.yawRate = trueYawRate + c.yawRate;
            prior.yawRateSigma = c.yawRate == 0 ? 0 : degree;
            const AckermannMotion m =
                AckermannEstimator::create(truth.camera, params)
                    ->estimate(simulation::randomSegments(truth, options, rng).ends, noArray(), prior);
            const std::string name =
                cv::format("speed %+g, yaw rate %+g, wall %d, seed %d", c.speed, c.yawRate, int(c.wallIsKnown), seed);
            EXPECT_EQ(c.contradicts, m.contradictsPrior) << name;
            EXPECT_EQ(c.speed != 0 && c.wallIsKnown, m.seenSpeedSigma > 0) << name;
            EXPECT_EQ(c.yawRate != 0, m.seenYawRateSigma > 0) << name;
            if (m.seenSpeedSigma > 0)
            {
                EXPECT_LT(std::abs(m.seenSpeed - trueSpeed), 4 * m.seenSpeedSigma) << name;
            }
            if (m.seenYawRateSigma > 0)
            {
                EXPECT_LT(std::abs(m.seenYawRate - trueYawRate), 4 * m.seenYawRateSigma) << name;
            }
        }
}

}} // namespace
