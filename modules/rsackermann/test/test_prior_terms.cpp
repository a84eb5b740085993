// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"
#include "../src/estimator/prior_residuals.hpp"

namespace opencv_test { namespace {

typedef AckermannEstimator::Params Params;

PriorTerms makeTerms(const MotionPrior& prior, const Params& params = Params())
{
    const RollingShutterCamera camera = simulation::paperCamera();
    return PriorTerms(prior, camera, params, MotionLimits(camera, params));
}

double costOf(const PriorTerms& terms, const Model& model, const Structure& structure)
{
    Jet r[PriorTerms::MAX_RESIDUALS];
    const int n = terms.evaluate(model, structure, r);
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

//! A motion of the frame before, of a model, with the covariance of that model.
MotionPrior previousOf(int model, int walls, double noise)
{
    MotionPrior prior;
    AckermannMotion& m = prior.previous;
    m.status = MOTION_OK;
    m.model = model;
    const bool turns = model == MODEL_1LA || model == MODEL_4LA, translates = model == MODEL_3LA || model == MODEL_4LA;
    m.alpha = turns ? 0.012 : 0;
    m.wallSlope = translates ? 0.28 : 0;
    m.wallOffset = translates ? -0.04 : 0;
    m.wallRatio = translates && walls == 2 ? 1.1 : 0;
    const bool known[4] = {turns, translates, translates, translates && walls == 2};
    const Matx44d root(1e-3, 0, 0, 0, -2e-3, 0.02, 0, 0, 1e-3, 5e-3, 0.01, 0, 0.01, 0.02, 0.03, 0.1);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            m.covariance(i, j) = known[i] && known[j] ? (root * root.t())(i, j) : 0;
    prior.previousNoise = noise;
    return prior;
}

// The cost of a change is its square in the metric of the inverse covariance, whatever the model of the frame before.
TEST(RSAckermann_PriorTerms, previous_motion_of_each_model)
{
    const int models[] = {MODEL_1LA, MODEL_3LA, MODEL_3LA, MODEL_4LA, MODEL_4LA}, walls[] = {0, 1, 2, 1, 2};
    const RollingShutterCamera camera = simulation::paperCamera();
    const double noise = 0.1, maxAlpha = MotionLimits(camera, Params()).maxAlpha;
    for (int k = 0; k < 5; k++)
    {
        const MotionPrior prior = previousOf(models[k], walls[k], noise);
        const AckermannMotion& m = prior.previous;
        const Structure structure(MODEL_4LA, 2);
        const Model model = exampleModel();
        const double values[4] = {m.alpha, m.wallSlope, m.wallOffset, m.wallRatio}, wall = std::hypot(m.wallSlope, m.wallOffset);
        const double ranges[4] = {maxAlpha, wall, wall, m.wallRatio};
        std::vector<int> known;
        for (int i = 0; i < 4; i++)
            if (m.covariance(i, i) > 0)
                known.push_back(i);
        const int n = int(known.size());
        Mat1d covariance(n, n), change(n, 1);
        for (int i = 0; i < n; i++)
        {
            change(i) = model.value[known[i]] - values[known[i]];
            for (int j = 0; j < n; j++)
                covariance(i, j) = m.covariance(known[i], known[j]) + (i == j ? std::pow(noise * ranges[known[i]], 2) : 0);
        }
        const double expected = Mat1d(change.t() * covariance.inv() * change)(0);
        EXPECT_NEAR(expected, costOf(makeTerms(prior), model, structure) - costOf(makeTerms(MotionPrior()), model, structure), 1e-6 * expected) << k;
        EXPECT_GT(expected, 0.01) << k;
    }
}

TEST(RSAckermann_PriorTerms, previous_motion_for_samples)
{
    MotionPrior prior = previousOf(MODEL_1LA, 0, 0.01);
    const double carried = std::hypot(1e-3, 0.01 * MotionLimits(simulation::paperCamera(), Params()).maxAlpha);
    EXPECT_EQ(0.012, makeTerms(prior).sampleAlpha);
    EXPECT_NEAR(carried, makeTerms(prior).sampleAlphaSigma, 1e-9);
    // A gyro that is more exact takes its place.
    const double unit = simulation::paperCamera().secondsPerUnitTime();
    prior.yawRate = 0.3;
    prior.yawRateSigma = 0.5 * carried * 2 / unit;
    EXPECT_NEAR(0.3 * unit / 2, makeTerms(prior).sampleAlpha, 1e-12);
    prior.yawRateSigma = 2 * carried * 2 / unit;
    EXPECT_EQ(0.012, makeTerms(prior).sampleAlpha);
    // A motion without yaw doesn't know the yaw rate.
    EXPECT_EQ(0, makeTerms(previousOf(MODEL_3LA, 1, 0.01)).sampleAlphaSigma);
}

TEST(RSAckermann_PriorTerms, motions_that_say_nothing)
{
    MotionPrior prior = previousOf(MODEL_4LA, 2, 0.1);
    EXPECT_TRUE(makeTerms(prior).hasPrevious);
    prior.previous.status = MOTION_NOT_SIGNIFICANT;
    EXPECT_FALSE(makeTerms(prior).hasPrevious);
    EXPECT_FALSE(makeTerms(previousOf(MODEL_4LA, 2, 0)).hasPrevious);
}

TEST(RSAckermann_PriorTerms, reverse_has_its_probability)
{
    Params params;
    params.reverseProbability = 0.003;
    Model forward, back;
    forward.direction = 1;
    back.direction = -1;
    const PriorTerms terms = makeTerms(MotionPrior(), params);
    const Structure structure(MODEL_3LA, 1);
    // A cost is minus twice the logarithm of a probability.
    EXPECT_NEAR(-2 * std::log(0.003), costOf(terms, back, structure) - costOf(terms, forward, structure), 1e-9);
}

TEST(RSAckermann_PriorTerms, each_piece_in_units_of_its_sigma)
{
    const double unit = simulation::paperCamera().secondsPerUnitTime();
    Params params;
    params.wallDistance = 2.5;
    const Structure structure(MODEL_4LA, 1);
    const Model m = exampleModel();
    const double azimuth = std::atan2(m[P_D], m[P_B]), speed = std::hypot(m[P_B], m[P_D]) * 2.5 / unit, yawRate = 2 * m[P_ALPHA] / unit;
    const double none = costOf(makeTerms(MotionPrior(), params), m, structure);
    MotionPrior prior;
    prior.speed = speed - 1.5;
    prior.speedSigma = 0.5;
    EXPECT_NEAR(9, costOf(makeTerms(prior, params), m, structure) - none, 1e-6);
    prior = MotionPrior();
    prior.yawRate = yawRate + 0.08;
    prior.yawRateSigma = 0.02;
    EXPECT_NEAR(16, costOf(makeTerms(prior, params), m, structure) - none, 1e-6);
    prior = MotionPrior();
    prior.wallDirection = azimuth + 0.02;
    prior.wallDirectionSigma = 0.01;
    EXPECT_NEAR(4, costOf(makeTerms(prior, params), m, structure) - none, 1e-3);

    // How far walls usually deviate from the car's direction.
    params.wallDeviationSigma = 0;
    const double free = costOf(makeTerms(MotionPrior(), params), m, structure);
    params.wallDeviationSigma = 0.1;
    EXPECT_NEAR(std::pow(std::sin(azimuth) / 0.1, 2), costOf(makeTerms(MotionPrior(), params), m, structure) - free, 1e-9);
}

}} // namespace
