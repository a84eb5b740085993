// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_simulator.hpp"
#include "../src/sequence/frame_fit.hpp"
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

// It looks like a wall that a car passes backward, and the road in front of a car at rest like its bonnet. One that
// crosses looks like a bend, and all of the street like the car itself.
TEST(RSAckermann_OwnCar, rests_beside_a_truck_that_passes)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const double unit = camera.secondsPerUnitTime(), interval = 1. / 30, moved = 8 * interval; // m
    RNG rng(9);
    for (int round = 0; round < 40; round++)
    {
        const bool crosses = round % 2 == 1;
        std::vector<TrackedBearing> bearings;
        const auto add = [&](double x, double y, double z, double forward, double aside) {
            TrackedBearing b = TrackedBearing();
            const Point2d noise(rng.gaussian(1e-4), rng.gaussian(1e-4));
            b.now = Point2d(x, y) * (1 / z);
            b.other = Point2d(x - aside, y) * (1 / (z - forward)) + noise;
            b.timeNow = b.now.y;
            b.timeOther = b.other.y - interval / unit;
            b.pitch = FLOW_PITCH_BEFORE;
            b.roll = FLOW_ROLL_BEFORE;
            b.isStill = cv::norm(b.now - b.other) * camera.cameraMatrix(0, 0) < POINT_SIGMA;
            if (std::abs(b.now.x) < 0.39 && std::abs(b.now.y) < 0.23)
                bearings.push_back(b);
        };
        while (bearings.size() < 120)
            add(5, rng.uniform(-3., 1.), rng.uniform(12., 30.), 0, 0); // a wall
        while (bearings.size() < 200)
            add(rng.uniform(-3., 4.), camera.height, rng.uniform(5., 15.), 0, 0);
        while (bearings.size() < (crosses ? 380 : 260))
        {
            if (crosses)
                add(rng.uniform(-3., 3.), rng.uniform(0.1, 1.), 6, 0, moved);
            else
                add(-2.4, rng.uniform(-2., 1.), rng.uniform(6., 12.), moved, 0);
        }
        const SequenceFit fit = fitFrame(camera, bearings, std::vector<UprightSegment>(),
                                         SequenceState(camera, AckermannEstimator::Params()), true, FitNuisances());
        EXPECT_NEAR(0, fit.state.value[SEQUENCE_SPEED], 0.1) << round;
        EXPECT_FALSE(fit.moves) << round;
    }
}

}} // namespace
