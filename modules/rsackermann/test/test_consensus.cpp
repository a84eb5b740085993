// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_private_problem.hpp"
#include "../src/single/consensus.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

//! Exact segments on a street, from left to right, and how many of them are on the left wall.
RefinementProblem exactProblem(const Simulator& street, const AckermannEstimator::Params& params, int& left)
{
    RNG rng(2);
    simulation::SegmentOptions options;
    options.count = 40;
    const simulation::Segments segments = simulation::randomSegments(street, options, rng);
    left = 0;
    for (int i = 0; i < options.count; i++)
        left += segments.truth[i] == simulation::LEFT;
    const RefinementProblem problem = makeProblem(street.camera, params, segments.ends);
    EXPECT_EQ(size_t(options.count), problem.verticals.size());
    return problem;
}

//! Largest difference of the best of the models from the truth, relative to the speed.
double errorOf(const Model* models, int count, const Model& truth)
{
    double best = DBL_MAX;
    for (int i = 0; i < count; i++)
    {
        if (models[i].direction != truth.direction)
            continue;
        double worst = std::abs(models[i][P_LAMBDA] - truth[P_LAMBDA]) / truth[P_LAMBDA];
        for (int p = P_ALPHA; p <= P_D; p++)
            worst = std::max(worst, std::abs(models[i].value[p] - truth.value[p]) / std::hypot(truth[P_B], truth[P_D]));
        best = std::min(best, worst);
    }
    return best;
}

// Three segments of one wall and one of the other, whichever that is, give the motion.
TEST(RSAckermann_Consensus, samples_and_their_mirror_images)
{
    const double speeds[] = {20, -15}, directions[] = {0, 4};
    for (int k = 0; k < 2; k++)
    {
        const Simulator street =
            Simulator::fromMetric(simulation::paperCamera(), 0.5, speeds[k], 2.5, 3, directions[k] * degree);
        AckermannEstimator::Params params;
        params.wallDistance = 2.5;
        int left;
        const RefinementProblem problem = exactProblem(street, params, left);
        ASSERT_GE(left, 8);
        ASSERT_GE(40 - left, 8);
        CandidateConsensus consensus(problem, MotionHypothesis(MODEL_4LA, 2), 0.5);
        ASSERT_EQ(4, consensus.sampleSize());
        const int threeLeft[] = {0, left / 2, left - 1, 38}, threeRight[] = {2, left, left + (40 - left) / 2, 39};
        Model models[CandidateConsensus::MAX_MODELS];
        EXPECT_LT(errorOf(models, consensus.generate(threeLeft, models), modelOf(street)), 0.05) << k;
        EXPECT_LT(errorOf(models, consensus.generate(threeRight, models), modelOf(street)), 0.05) << k;
    }
}

// The limit of the speed is one for the left wall; a right wall that is nearer may be passed faster in its own terms.
TEST(RSAckermann_Consensus, near_right_wall)
{
    const Simulator street = Simulator::fromMetric(simulation::paperCamera(), 0.4, 25, 6, 2, 0);
    AckermannEstimator::Params params;
    params.wallDistance = 6;
    params.maxSpeed = 30;
    int left;
    const RefinementProblem problem = exactProblem(street, params, left);
    ASSERT_GE(left, 2);
    const Model truth = modelOf(street);
    ASSERT_GT(truth[P_LAMBDA] * std::hypot(truth[P_B], truth[P_D]), problem.limits.maxScaledSpeed);
    CandidateConsensus consensus(problem, MotionHypothesis(MODEL_4LA, 2), 0.5);
    const int threeRight[] = {0, left, left + (40 - left) / 2, 39};
    Model models[CandidateConsensus::MAX_MODELS];
    EXPECT_LT(errorOf(models, consensus.generate(threeRight, models), truth), 0.05);
}

}} // namespace
