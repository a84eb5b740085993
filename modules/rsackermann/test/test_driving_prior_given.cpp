// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"
#include "../src/factors/driving_prior.hpp"

namespace opencv_test { namespace {

typedef AckermannEstimator::Params Params;

DrivingPrior makeTerms(const MotionPrior& prior, const Params& params = Params(), double heading = 0)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.heading = heading;
    return DrivingPrior(prior, camera, params);
}

double costOf(const DrivingPrior& terms, const Model& model, const MotionHypothesis& hypothesis)
{
    Jet r[DrivingPrior::MAX_RESIDUALS];
    const int n = terms.evaluate(model, hypothesis, r);
    double cost = 0;
    for (int i = 0; i < n; i++)
        cost += r[i].value * r[i].value;
    return cost;
}

Model exampleModel()
{
    Model m;
    m.direction = 1;
    m[P_ALPHA] = 0.01;
    m[P_B] = 0.3;
    m[P_D] = -0.05;
    m[P_LAMBDA] = 1.3;
    return m;
}

TEST(RSAckermann_DrivingPrior, reverse_has_its_probability)
{
    Params params;
    params.reverseProbability = 0.003;
    const DrivingPrior terms = makeTerms(MotionPrior(), params);
    Model forward, back;
    forward.direction = 1;
    back.direction = -1;
    forward[P_B] = back[P_B] = terms.expectedScaledSpeed();
    const MotionHypothesis hypothesis(MODEL_3LA, 1);
    // A cost is minus twice the logarithm of a probability.
    EXPECT_NEAR(-2 * std::log(0.003 / 0.997), costOf(terms, back, hypothesis) - costOf(terms, forward, hypothesis),
                1e-9);
}

// The size of a speed is log-normal: its direction is as probable as the sign.
TEST(RSAckermann_DrivingPrior, direction_of_a_given_speed)
{
    for (const double sigmas : {-2., -0.5, 0., 0.5, 2.})
    {
        MotionPrior given;
        given.speedSigma = 3;
        given.speed = sigmas * given.speedSigma;
        const DrivingPrior terms = makeTerms(given);
        Model forward, back;
        forward.direction = 1;
        back.direction = -1;
        forward[P_B] = back[P_B] = terms.expectedScaledSpeed();
        const MotionHypothesis hypothesis(MODEL_3LA, 1);
        const double ofForward = 0.5 * std::erfc(-sigmas / std::sqrt(2.));
        EXPECT_NEAR(-2 * std::log((1 - ofForward) / ofForward),
                    costOf(terms, back, hypothesis) - costOf(terms, forward, hypothesis), 1e-6)
            << sigmas;
    }
}

TEST(RSAckermann_DrivingPrior, line_delay_is_uncertain)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.lineDelaySigma = 0.1 * camera.lineDelay;
    const Params params;
    MotionPrior prior;
    prior.yawRate = 0.3;
    prior.yawRateSigma = 0.04;
    prior.speed = -20;
    prior.speedSigma = 1.5;
    const DrivingPrior terms(prior, camera, params);
    const double unit = camera.secondsPerUnitTime();
    // 3-4-5 triangles
    EXPECT_NEAR(0.05 * unit / 2, terms.given().alphaSigma, 1e-12);
    EXPECT_NEAR(2.5 * unit, terms.given().speedSigma, 1e-12);
}

// Its covariance is that of samples of the logarithms.
TEST(RSAckermann_DrivingPrior, expected_motion)
{
    const int samples = 200000;
    Params params;
    params.priorWallDistanceLogSigma = 0.05;
    params.priorWallRatioLogSigma = 0.03;
    params.wallDeviationSigma = 0.02;
    for (const int direction : {1, -1})
    {
        MotionPrior prior;
        prior.speed = direction * 20;
        prior.speedSigma = 0.8;
        prior.yawRate = 0.3;
        prior.yawRateSigma = 0.01;
        const DrivingPrior terms = makeTerms(prior, params, 0.4);
        Matx<double, PARAMETERS, PARAMETERS> covariance;
        const Model m = terms.expectedMotion(MotionHypothesis(MODEL_4LA, 2), direction, covariance);
        EXPECT_EQ(direction, m.direction);
        EXPECT_EQ(terms.expectedAlpha(), m[P_ALPHA]);
        EXPECT_NEAR(terms.alphaScale(), std::sqrt(covariance(P_ALPHA, P_ALPHA)), 1e-12);
        RNG rng(3);
        Matx33d sampled;
        const double ofMean = std::hypot(0.8 / 20, 0.05 / std::sqrt(2.)); // both walls, whose ratio is independent
        for (int i = 0; i < samples; i++)
        {
            const double mean = rng.gaussian(ofMean), ratio = rng.gaussian(0.03), azimuth = 0.4 + rng.gaussian(0.02),
                         left = m.direction * terms.expectedScaledSpeed() * std::exp(mean - ratio / 2);
            const Vec3d difference(left * std::cos(azimuth) - m[P_B], left * std::sin(azimuth) - m[P_D],
                                   std::exp(ratio) - m[P_LAMBDA]);
            sampled += difference * difference.t() * (1. / samples);
        }
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++)
                EXPECT_NEAR(sampled(i, k), covariance(P_B + i, P_B + k),
                            0.03 * std::sqrt(sampled(i, i) * sampled(k, k)))
                    << i << " " << k;

        const Model turning = terms.expectedMotion(MotionHypothesis(MODEL_1LA, 0), direction, covariance);
        EXPECT_EQ(0, turning[P_B]);
        EXPECT_EQ(0, turning[P_D]);
        EXPECT_EQ(0, covariance(P_B, P_B));
        const Model straight = terms.expectedMotion(MotionHypothesis(MODEL_3LA, 2), direction, covariance);
        EXPECT_EQ(0, straight[P_ALPHA]);
        EXPECT_EQ(0, covariance(P_ALPHA, P_ALPHA));
        EXPECT_EQ(m[P_B], straight[P_B]);
    }
}

// The street is where both say, a given wall is the left one, and a camera that looks aside sees one wall.
TEST(RSAckermann_DrivingPrior, expected_motion_of_other_scenes)
{
    MotionPrior prior;
    prior.speed = 20;
    prior.speedSigma = 0.8;
    Matx<double, PARAMETERS, PARAMETERS> covariance;
    const MotionHypothesis both(MODEL_3LA, 2), one(MODEL_3LA, 1);
    const auto azimuthSigma = [&](const Model& m) {
        const Vec3d across = Vec3d(-m[P_D], m[P_B], 0) * (1 / (m[P_B] * m[P_B] + m[P_D] * m[P_D]));
        return std::sqrt(across.dot(covariance.get_minor<3, 3>(P_B, P_B) * across));
    };
    Params params;
    params.wallDeviationSigma = 0;
    EXPECT_NEAR(1, azimuthSigma(makeTerms(prior, params).expectedMotion(both, 1, covariance)), 1e-9);
    params.wallDeviationSigma = 0.03;
    prior.wallDirection = 0.1;
    prior.wallDirectionSigma = 0.04;
    const Model oblique = makeTerms(prior, params).expectedMotion(both, 1, covariance);
    EXPECT_NEAR(0.036, std::atan2(oblique[P_D], oblique[P_B]), 1e-4); // 3-4-5
    EXPECT_NEAR(0.024, azimuthSigma(oblique), 1e-9);
    prior.wallDirectionSigma = 0;

    params.wallDistance = 3;
    const DrivingPrior beside = makeTerms(prior, params);
    const Model m = beside.expectedMotion(both, 1, covariance);
    EXPECT_NEAR(std::hypot(0.8 / 20, params.wallDistanceLogSigma), std::sqrt(covariance(P_B, P_B)) / m[P_B], 2e-3);
    EXPECT_NEAR(params.priorWallRatioLogSigma, std::sqrt(std::log1p(covariance(P_LAMBDA, P_LAMBDA))), 0.1);
    for (const double heading : {CV_PI / 2, -CV_PI / 2})
        for (const double speed : {20., -20.})
        {
            prior.speed = speed;
            const Model aside = makeTerms(prior, params, heading).expectedMotion(one, speed < 0 ? -1 : 1, covariance);
            EXPECT_GT(aside.direction * aside[P_D], 0); // in front
            EXPECT_EQ(0, aside[P_LAMBDA]);
            EXPECT_EQ(0, covariance(P_LAMBDA, P_LAMBDA));
            EXPECT_EQ(heading < 0, hasRightWallOnly(aside, Heading(heading)));
        }
}

TEST(RSAckermann_DrivingPrior, each_piece_in_units_of_its_sigma)
{
    const double unit = simulation::paperCamera().secondsPerUnitTime();
    Params params;
    params.wallDistance = 2.5;
    const MotionHypothesis hypothesis(MODEL_4LA, 1);
    const Model m = exampleModel();
    const double azimuth = std::atan2(m[P_D], m[P_B]), speed = std::hypot(m[P_B], m[P_D]) * 2.5 / unit,
                 yawRate = 2 * m[P_ALPHA] / unit;
    MotionPrior prior;
    prior.speed = speed;
    prior.speedSigma = 0.5;
    prior.yawRate = yawRate;
    prior.yawRateSigma = 0.02;
    prior.wallDirection = azimuth;
    prior.wallDirectionSigma = 0.01;
    const double agreeing = costOf(makeTerms(prior, params), m, hypothesis);
    MotionPrior other = prior;
    other.yawRate += 0.08;
    EXPECT_NEAR(16, costOf(makeTerms(other, params), m, hypothesis) - agreeing, 1e-6);
    other = prior;
    other.wallDirection += 0.02;
    EXPECT_NEAR(4, costOf(makeTerms(other, params), m, hypothesis) - agreeing, 1e-3);

    // How far walls deviate from the car's direction.
    params.wallDeviationSigma = 0;
    const double free = costOf(makeTerms(MotionPrior(), params), m, hypothesis);
    params.wallDeviationSigma = 0.1;
    for (double heading = -1.5; heading < 2; heading++)
        EXPECT_NEAR(std::pow(std::sin(azimuth - heading) / 0.1, 2),
                    costOf(makeTerms(MotionPrior(), params, heading), m, hypothesis) - free, 1e-9);
}

}} // namespace
