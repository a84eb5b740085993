// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_drive_simulator.hpp"

#include "../src/optim/hac_covariance.hpp"

namespace opencv_test { namespace {

using namespace simulation;

//! Share of the means of swaying drives of 10 s that are within 2 standard deviations of 0.
double covered(double memory, const std::function<Sway(RNG&)>& sway)
{
    typedef Eigen::Matrix<double, 1, 1> Value;
    const int drives = 1000, frames = 50;
    const double seconds = 10;
    RNG rng(7);
    int within = 0;
    for (int i = 0; i < drives; i++)
    {
        const Sway at = sway(rng);
        std::vector<Value> values(frames);
        Value sum(0);
        for (int k = 0; k < frames; k++)
            sum += values[k] = Value(at(seconds * k / frames));
        const double variance = cv::rsackermann::hacCovariance(values, seconds, Value(memory))(0, 0);
        within += sum[0] * sum[0] <= 4 * variance;
    }
    ::testing::Test::RecordProperty("within_2_sigma_percent", cvRound(100. * within / drives));
    return double(within) / drives;
}

const double USUAL = 0.5; // seconds, of a car on its springs

TEST(RSAckermann_PrivateHacCovariance, rough_road)
{
    const double share = covered(USUAL, [](RNG& rng) { return onSprings(0.1, rng); });
    EXPECT_GE(share, 0.93);
    EXPECT_LE(share, 0.98);
}

TEST(RSAckermann_PrivateHacCovariance, tilts_that_wander)
{
    const double share = covered(USUAL, [](RNG& rng) { return wandering(0.25, USUAL, rng); });
    EXPECT_GE(share, 0.93);
    EXPECT_LE(share, 0.98);
}

TEST(RSAckermann_PrivateHacCovariance, tilts_that_wander_slowly_and_are_said_to)
{
    const double memory = 2;
    const double share = covered(memory, [&](RNG& rng) { return wandering(0.25, memory, rng); });
    EXPECT_GE(share, 0.93);
    EXPECT_LE(share, 0.99);
}

TEST(RSAckermann_PrivateHacCovariance, noise)
{
    const double share = covered(0, [](RNG& rng) {
        RNG fresh(rng.next());
        return [fresh](double) mutable { return fresh.gaussian(1); };
    });
    EXPECT_GE(share, 0.93);
    EXPECT_LE(share, 0.98);
}

// How values scatter has nothing to do with their mean, nor with the direction of time.
TEST(RSAckermann_PrivateHacCovariance, constants_and_direction_of_time)
{
    typedef Eigen::Vector2d Values;
    RNG rng(9);
    std::vector<Values> values(40), others(40);
    for (size_t k = 0; k < values.size(); k++)
        values[k] = others[others.size() - 1 - k] = Values(rng.gaussian(1), rng.gaussian(1));
    for (Values& v : others)
        v += Values(7, -3);
    const Values memories(USUAL, 0);
    const Eigen::Matrix2d expected = cv::rsackermann::hacCovariance(values, 10, memories),
                          same = cv::rsackermann::hacCovariance(others, 10, memories);
    EXPECT_LT((same - expected).norm(), 1e-9 * expected.norm());
}

}} // namespace opencv_test::
