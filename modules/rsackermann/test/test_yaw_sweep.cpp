// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_private_problem.hpp"
#include "../src/factors/segment_residuals.hpp"
#include "../src/single/yaw_sweep.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

Fit fitOf(double B, double D, double variance, double covariance)
{
    Fit fit(MotionHypothesis(MODEL_4LA, 1));
    fit.model[P_B] = B;
    fit.model[P_D] = D;
    fit.model.direction = 1;
    fit.covariance(P_B, P_B) = fit.covariance(P_D, P_D) = variance;
    fit.covariance(P_B, P_D) = fit.covariance(P_D, P_B) = covariance;
    return fit;
}

TEST(RSAckermann_YawSweep, two_sigmas_apart_are_two_peaks)
{
    const Fit fit = fitOf(1, 2, 0.01, 0.0099);
    const auto isAtAway = [&](double B, double D) { return isAt(fit, fitOf(1 + B, 2 + D, 0, 0).model); };
    EXPECT_TRUE(isAtAway(0, 0));
    EXPECT_TRUE(isAtAway(0.19, 0.19)); // along their correlation
    EXPECT_FALSE(isAtAway(0.21, 0.21));
    EXPECT_FALSE(isAtAway(0.05, -0.05));
    Model other = fit.model;
    other[P_STREET] = other[P_LAMBDA] = 1; // which aren't free
    EXPECT_TRUE(isAt(fit, other));
    other.direction = -1;
    EXPECT_FALSE(isAt(fit, other));
    EXPECT_TRUE(isAt(fitOf(1, 2, 0, 0), fit.model));
}

TEST(RSAckermann_YawSweep, left_wall_is_the_first)
{
    RNG rng(2);
    for (int i = 0; i < 1000; i++)
    {
        const Heading heading(rng.uniform(-CV_PI, CV_PI));
        Model m;
        m[P_ALPHA] = rng.uniform(-0.01, 0.01);
        m[P_B] = rng.uniform(-0.2, 0.2);
        m[P_D] = rng.uniform(-0.2, 0.2);
        m[P_LAMBDA] = i % 3 == 0 ? 0 : rng.uniform(0.2, 5.);
        m.direction = i % 2 ? 1 : -1;
        const Model renamed = withLeftWallFirst(m, heading);
        EXPECT_EQ(m[P_LAMBDA] == 0 && isFirstWallRight(m, heading), isFirstWallRight(renamed, heading));
        UprightSegment segment;
        segment.u = Vec3d(rng.uniform(-1., 1.), rng.uniform(-0.5, 0.5), 1);
        segment.v = segment.u + Vec3d(rng.uniform(-0.1, 0.1), 0.3, 0);
        segment.timeU = -0.3;
        segment.timeV = 0.4;
        int wall;
        EXPECT_NEAR(verticalResidual(segment, m, heading, wall, 0),
                    verticalResidual(segment, renamed, heading, wall, 0), 1e-12);
    }
}

// A minimum on the valley of another one is no peak of its own, and a sweep ends where another one has been.
TEST(RSAckermann_YawSweep, no_motion_is_swept_twice)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Simulator street = Simulator::fromMetric(camera, 0.5, 20, 2.5, 3, 0);
    AckermannEstimator::Params params;
    RNG rng(4);
    simulation::SegmentOptions options;
    options.noise = 0.3;
    RefinementProblem problem = makeProblem(camera, params, simulation::randomSegments(street, options, rng).ends);
    const DrivingPrior prior(MotionPrior(), camera, params);
    problem.prior = &prior;
    problem.weigh();
    Fit fit(MotionHypothesis(MODEL_4LA, 2));
    fit.model = modelOf(street);
    fit.refine(problem);
    Fit renamed(fit.hypothesis);
    renamed.model = fit.model;
    renamed.model[P_B] *= -fit.model[P_LAMBDA];
    renamed.model[P_D] *= -fit.model[P_LAMBDA];
    renamed.model[P_LAMBDA] = 1 / fit.model[P_LAMBDA];
    renamed.refine(problem);
    EXPECT_TRUE(isAt(fit, renamed.model));

    std::vector<YawSweep> valleys;
    EXPECT_FALSE(contain(valleys, fit));
    valleys.push_back(YawSweep(problem, fit, valleys));
    const YawSweep& valley = valleys[0];
    ASSERT_EQ(valley.fits.size(), valley.logMasses.size());
    ASSERT_GT(valley.fits.size(), 10u);
    double low = 0, high = 0;
    for (const Fit& swept : valley.fits)
    {
        EXPECT_TRUE(valley.contains(swept));
        low = std::min(low, swept.model[P_ALPHA] - fit.model[P_ALPHA]);
        high = std::max(high, swept.model[P_ALPHA] - fit.model[P_ALPHA]);
    }
    const double sigma = std::sqrt(fit.covariance(P_ALPHA, P_ALPHA));
    EXPECT_LT(low, -3 * sigma);
    EXPECT_GT(high, 3 * sigma);

    EXPECT_TRUE(contain(valleys, fit));
    EXPECT_EQ(1u, YawSweep(problem, fit, valleys).fits.size());
    Fit elsewhere = fit;
    elsewhere.model[P_B] *= 3;
    EXPECT_FALSE(contain(valleys, elsewhere));
    elsewhere = fit;
    elsewhere.model[P_ALPHA] += 2 * high;
    EXPECT_FALSE(contain(valleys, elsewhere));
}

}} // namespace opencv_test
