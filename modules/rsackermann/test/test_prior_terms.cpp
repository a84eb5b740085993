// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"
#include "../src/factors/given_prior.hpp"

namespace opencv_test { namespace {

typedef AckermannEstimator::Params Params;

PriorTerms makeTerms(const MotionPrior& prior, const Params& params = Params(), double heading = 0)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.heading = heading;
    return PriorTerms(prior, camera, params);
}

double costOf(const PriorTerms& terms, const Model& model, const MotionHypothesis& hypothesis)
{
    Jet r[PriorTerms::MAX_RESIDUALS];
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

TEST(RSAckermann_PriorTerms, reverse_has_its_probability)
{
    Params params;
    params.reverseProbability = 0.003;
    Model forward, back;
    forward.direction = 1;
    back.direction = -1;
    const PriorTerms terms = makeTerms(MotionPrior(), params);
    const MotionHypothesis hypothesis(MODEL_3LA, 1);
    // A cost is minus twice the logarithm of a probability.
    EXPECT_NEAR(-2 * std::log(0.003), costOf(terms, back, hypothesis) - costOf(terms, forward, hypothesis), 1e-9);
}

TEST(RSAckermann_PriorTerms, line_delay_is_uncertain)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.lineDelaySigma = 0.1 * camera.lineDelay;
    Params params;
    params.wallDistance = 2.5;
    MotionPrior prior;
    prior.yawRate = 0.3;
    prior.yawRateSigma = 0.04;
    prior.speed = -20;
    prior.speedSigma = 1.5;
    const PriorTerms terms(prior, camera, params);
    const double unit = camera.secondsPerUnitTime();
    // 3-4-5 triangles
    EXPECT_NEAR(0.05 * unit / 2, terms.alphaSigma, 1e-12);
    EXPECT_NEAR(2.5 * unit / 2.5, terms.scaledSpeedSigma, 1e-12);
}

TEST(RSAckermann_PriorTerms, each_piece_in_units_of_its_sigma)
{
    const double unit = simulation::paperCamera().secondsPerUnitTime();
    Params params;
    params.wallDistance = 2.5;
    const MotionHypothesis hypothesis(MODEL_4LA, 1);
    const Model m = exampleModel();
    const double azimuth = std::atan2(m[P_D], m[P_B]), speed = std::hypot(m[P_B], m[P_D]) * 2.5 / unit,
                 yawRate = 2 * m[P_ALPHA] / unit;
    const double none = costOf(makeTerms(MotionPrior(), params), m, hypothesis);
    MotionPrior prior;
    prior.speed = speed - 1.5;
    prior.speedSigma = 0.5;
    EXPECT_NEAR(9, costOf(makeTerms(prior, params), m, hypothesis) - none, 1e-6);
    prior = MotionPrior();
    prior.yawRate = yawRate + 0.08;
    prior.yawRateSigma = 0.02;
    EXPECT_NEAR(16, costOf(makeTerms(prior, params), m, hypothesis) - none, 1e-6);
    prior = MotionPrior();
    prior.wallDirection = azimuth + 0.02;
    prior.wallDirectionSigma = 0.01;
    EXPECT_NEAR(4, costOf(makeTerms(prior, params), m, hypothesis) - none, 1e-3);

    // How far walls usually deviate from the car's direction.
    params.wallDeviationSigma = 0;
    const double free = costOf(makeTerms(MotionPrior(), params), m, hypothesis);
    params.wallDeviationSigma = 0.1;
    for (double heading = -1.5; heading < 2; heading++)
        EXPECT_NEAR(std::pow(std::sin(azimuth - heading) / 0.1, 2),
                    costOf(makeTerms(MotionPrior(), params, heading), m, hypothesis) - free, 1e-9);
}

}} // namespace
