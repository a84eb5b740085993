// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "../src/sequence/contradicted_values.hpp"

namespace opencv_test {

using namespace cv::rsackermann;

namespace {

enum Value { YAW_RATE, SPEED };

//! What is given, and what a frame shows of one of both; the other one agrees.
struct Frame
{
    MotionPrior prior;
    AckermannMotion motion;

    Frame(Value value, double given, double seen, double seenSigma)
    {
        prior.yawRate = motion.seenYawRate = 0.1;
        prior.speed = motion.seenSpeed = 10;
        prior.yawRateSigma = prior.speedSigma = 0.01;
        motion.seenYawRateSigma = motion.seenSpeedSigma = 0.2;
        (value == SPEED ? prior.speed : prior.yawRate) = given;
        (value == SPEED ? motion.seenSpeed : motion.seenYawRate) = seen;
        (value == SPEED ? motion.seenSpeedSigma : motion.seenYawRateSigma) = seenSigma;
    }

    //! Whether the value is used, as the other one always is.
    bool isUsed(Value value, ContradictedValues& values)
    {
        const MotionPrior used = values.usable(prior, false, motion);
        const bool result = (value == SPEED ? used.speedSigma : used.yawRateSigma) > 0;
        EXPECT_EQ(!result, motion.contradictsPrior);
        EXPECT_EQ(value == SPEED ? prior.yawRateSigma : prior.speedSigma,
                  value == SPEED ? used.yawRateSigma : used.speedSigma);
        EXPECT_EQ(prior.yawRate, used.yawRate);
        EXPECT_EQ(prior.speed, used.speed);
        return result;
    }
};

} // namespace

typedef testing::TestWithParam<Value> RSAckermann_ContradictedValues;

// A source that errs is left out from the first frame that shows it, whether or not others do.
TEST_P(RSAckermann_ContradictedValues, vague_frames_confirm_nothing)
{
    RNG rng(3);
    for (int round = 0; round < 1000; round++)
    {
        const double error = rng.uniform(0.5, 4.) * (round % 2 ? 1 : -1), truth = rng.uniform(-20., 20.);
        ContradictedValues values;
        EXPECT_TRUE(Frame(GetParam(), truth - error, truth, std::abs(error)).isUsed(GetParam(), values));
        EXPECT_FALSE(Frame(GetParam(), truth - error, truth, 0.2 * std::abs(error)).isUsed(GetParam(), values));
        for (int i = 0; i < 10; i++)
        {
            const double sigma = rng.uniform(0.1, 2.) * std::abs(error);
            Frame frame(GetParam(), truth - error, truth + rng.uniform(-1., 1.) * sigma, sigma);
            EXPECT_FALSE(frame.isUsed(GetParam(), values)) << i;
        }
        // Nothing shows it.
        EXPECT_FALSE(Frame(GetParam(), truth - error, 0, 0).isUsed(GetParam(), values));
        // Not given, it contradicts nothing, and stays what it was.
        Frame without(GetParam(), truth - error, truth, 0.2 * std::abs(error));
        (GetParam() == SPEED ? without.prior.speedSigma : without.prior.yawRateSigma) = 0;
        values.usable(without.prior, false, without.motion);
        EXPECT_FALSE(without.motion.contradictsPrior);
        EXPECT_FALSE(Frame(GetParam(), truth - error, truth, std::abs(error)).isUsed(GetParam(), values));
    }
}

// A frame that would show the error, and doesn't, confirms the value, for those after it as well.
TEST_P(RSAckermann_ContradictedValues, are_confirmed_by_frames_that_would_show_it)
{
    RNG rng(4);
    for (int round = 0; round < 1000; round++)
    {
        const double error = rng.uniform(0.5, 4.) * (round % 2 ? 1 : -1), truth = rng.uniform(-20., 20.);
        ContradictedValues values;
        EXPECT_FALSE(Frame(GetParam(), truth - error, truth, 0.2 * std::abs(error)).isUsed(GetParam(), values));
        EXPECT_FALSE(Frame(GetParam(), truth, truth, 0.4 * std::abs(error)).isUsed(GetParam(), values));
        EXPECT_TRUE(Frame(GetParam(), truth, truth, 0.3 * std::abs(error)).isUsed(GetParam(), values));
        EXPECT_TRUE(Frame(GetParam(), truth, truth, std::abs(error)).isUsed(GetParam(), values));
    }
}

INSTANTIATE_TEST_CASE_P(/**/, RSAckermann_ContradictedValues, testing::Values(YAW_RATE, SPEED));

// The other direction is the speed's, of that frame alone.
TEST(RSAckermann_ContradictedSpeed, other_direction)
{
    ContradictedValues values;
    for (const bool isOther : {true, false})
    {
        Frame frame(SPEED, 10, 10, 0.2);
        const MotionPrior used = values.usable(frame.prior, isOther, frame.motion);
        EXPECT_EQ(isOther, frame.motion.contradictsPrior);
        EXPECT_EQ(isOther, used.speedSigma == 0);
        EXPECT_EQ(frame.prior.yawRateSigma, used.yawRateSigma);
    }
}

} // namespace opencv_test
