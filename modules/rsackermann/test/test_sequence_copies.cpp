// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_simulator.hpp"
#include "../src/sequence/copies.hpp"

namespace opencv_test { namespace {

using namespace cv::rsackermann;

//! Points to the frame before and to the next one, of which some stand.
std::vector<TrackedBearing> pointsOf(int stillBefore, int stillAfter)
{
    std::vector<TrackedBearing> bearings;
    for (int i = 0; i < 200; i++)
    {
        TrackedBearing b = TrackedBearing();
        b.pitch = i < 100 ? FLOW_PITCH_BEFORE : FLOW_PITCH_AFTER;
        b.isStill = i % 100 < (i < 100 ? stillBefore : stillAfter);
        bearings.push_back(b);
    }
    return bearings;
}

// What neither the expected motion nor rest explains, as the points of a camera that shakes harder than expected, is no
// copy of the image before.
TEST(RSAckermann_Copies, are_images_in_which_points_stand)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    SequenceState fast(camera, AckermannEstimator::Params());
    fast.value[SEQUENCE_SPEED] = 10;
    fast.covariance(SEQUENCE_SPEED, SEQUENCE_SPEED) = 0.01;
    SequenceFit fit(fast);
    fit.stands = true;
    MotionPrior slow;
    slow.speed = 0.1;
    slow.speedSigma = 0.1;
    for (const double passed : {0.04, -0.04})
    {
        const int before = passed > 0 ? 100 : 0, after = 100 - before;
        EXPECT_TRUE(showsCopy(fit, pointsOf(before, after), passed, MotionPrior()));
        EXPECT_FALSE(showsCopy(fit, pointsOf(after, before), passed, MotionPrior()));
        EXPECT_FALSE(showsCopy(fit, pointsOf(before, after), passed, slow));
    }
    for (const int still : {0, 30, 70, 100})
        EXPECT_EQ(still > 50, showsCopy(fit, pointsOf(still, 0), 0.04, MotionPrior())) << still;
    fit.stands = false;
    EXPECT_FALSE(showsCopy(fit, pointsOf(100, 0), 0.04, MotionPrior()));
}

}} // namespace
