// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "perf_precomp.hpp"
#include "../test/test_simulator.hpp"

namespace opencv_test { namespace {

typedef tuple<int, int> SegmentsAndInliers;
typedef TestBaseWithParam<SegmentsAndInliers> RSAckermann_Estimator;

// Number of segments and percent of inliers.
PERF_TEST_P(RSAckermann_Estimator, estimate,
            testing::Combine(testing::Values(50, 200, 1000, 10000), testing::Values(80, 40)))
{
    const simulation::Simulator simulator =
        simulation::Simulator::fromMetric(simulation::paperCamera(), 0.7, 20, 2.5, 3, 0.02);
    simulation::SegmentOptions options;
    options.count = get<0>(GetParam());
    options.inlierRatio = get<1>(GetParam()) / 100.;
    options.noise = 0.15;
    RNG rng(1);
    const Mat segments = simulation::randomSegments(simulator, options, rng).ends;
    AckermannEstimator::Params params;
    params.wallDistance = 2.5;
    const Ptr<AckermannEstimator> estimator = AckermannEstimator::create(simulator.camera, params);
    AckermannMotion motion;

    declare.in(segments);
    TEST_CYCLE() motion = estimator->estimate(segments);

    // Of twenty verticals among fifty lines little is applied.
    EXPECT_TRUE(motion.status == MOTION_OK || motion.status == MOTION_NOT_SIGNIFICANT);
    SANITY_CHECK_NOTHING();
}

}} // namespace
