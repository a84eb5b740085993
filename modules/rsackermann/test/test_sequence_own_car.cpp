// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "../src/sequence/frame_terms.hpp"

namespace opencv_test { namespace {

using namespace cv::rsackermann;

// The bonnet is what stands still below all that moves; what stands still above it may be a car ahead.
TEST(RSAckermann_OwnCar, is_what_stands_still_below)
{
    RNG rng(7);
    for (int round = 0; round < 200; round++)
    {
        const double edge = rng.uniform(0.1, 0.3), focal = 800;
        const int bonnet = rng.uniform(20, 60), street = rng.uniform(20, 200);
        std::vector<TrackedBearing> bearings;
        int stillAbove = 0;
        for (int i = 0; i < bonnet + street; i++)
        {
            TrackedBearing b = TrackedBearing();
            const bool isBelow = i < bonnet;
            b.isStill = isBelow || i % 10 == 0;
            b.now.x = rng.uniform(-0.5, 0.5);
            b.now.y = isBelow ? rng.uniform(edge, 0.4) : b.isStill ? rng.uniform(-0.3, 0.) : rng.uniform(-0.3, edge);
            b.other = b.now + (b.isStill ? Point2d() : Point2d(0.01, 0.01));
            stillAbove += b.isStill && !isBelow;
            bearings.push_back(b);
        }
        for (int i = int(bearings.size()) - 1; i > 0; i--)
            std::swap(bearings[i], bearings[rng.uniform(0, i + 1)]);
        double cost = 0;
        const std::vector<TrackedBearing> above = aboveOwnCar(bearings, focal, cost);
        ASSERT_EQ(size_t(street), above.size());
        int still = 0;
        for (const TrackedBearing& b : above)
        {
            EXPECT_LT(b.now.y, edge);
            still += b.isStill;
        }
        EXPECT_EQ(stillAbove, still);
        EXPECT_DOUBLE_EQ(std::log(double(bearings.size())), cost);
    }
}

// Without one all points are left.
TEST(RSAckermann_OwnCar, a_street_has_none)
{
    RNG rng(8);
    std::vector<TrackedBearing> bearings;
    for (int i = 0; i < 100; i++)
    {
        TrackedBearing b = TrackedBearing();
        b.isStill = i % 4 == 0;
        b.now = Point2d(rng.uniform(-0.5, 0.5), rng.uniform(-0.3, 0.4));
        bearings.push_back(b);
    }
    double cost = 0;
    EXPECT_EQ(bearings.size(), aboveOwnCar(bearings, 800, cost).size());
}

}} // namespace
