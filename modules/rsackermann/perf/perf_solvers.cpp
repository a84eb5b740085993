// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "perf_precomp.hpp"
#include "../test/test_simulator.hpp"

namespace opencv_test { namespace {

const int BATCH = 1000;

//! Samples of three segments on the left and one on the right wall at the motion of the paper's experiments.
std::vector<VerticalSegment> samples()
{
    const simulation::Simulator simulator =
        simulation::Simulator::fromMetric(simulation::paperCamera(), 0.7, 20, 2.5, 3, 0.02);
    RNG rng(1);
    std::vector<VerticalSegment> result;
    while (result.size() < 4 * BATCH)
    {
        Vec4d segment;
        simulation::Surface wall;
        const simulation::Surface wanted = result.size() % 4 < 3 ? simulation::LEFT : simulation::RIGHT;
        if (simulation::randomVertical(simulator, simulation::SegmentOptions(), rng, segment, wall) && wall == wanted)
            result.push_back(simulation::toVerticalSegment(simulator, segment));
    }
    return result;
}

enum { ONE_LA, THREE_LA, FOUR_LA, FOUR_LA_EXACT };
CV_ENUM(MinimalSolver, ONE_LA, THREE_LA, FOUR_LA, FOUR_LA_EXACT)

typedef TestBaseWithParam<MinimalSolver> RSAckermann_Solver;

// A thousand calls in a run.
PERF_TEST_P(RSAckermann_Solver, solve, MinimalSolver::all())
{
    const int solver = GetParam();
    const std::vector<VerticalSegment> segments = samples();
    const SolverOptions options;
    int found = 0;

    TEST_CYCLE_MULTIRUN(10)
    {
        for (int i = 0; i < BATCH; i++)
        {
            const VerticalSegment* s = &segments[4 * i];
            MinimalSolution solutions[8];
            switch (solver)
            {
            case ONE_LA:
                found += solve1LA(s[0], options, solutions);
                break;
            case THREE_LA:
                found += solve3LA(s + 1, true, options, solutions);
                break;
            case FOUR_LA:
                found += solve4LA(s, true, options, solutions);
                break;
            default:
                found += solve4LAExact(s, true, options, solutions);
                break;
            }
        }
    }

    EXPECT_GT(found, 0);
    SANITY_CHECK_NOTHING();
}

}} // namespace
