// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "../src/motion/contradiction.hpp"

// What a motion that is seen says against one that is given.

namespace opencv_test { namespace {

//! @param azimuth along the walls. @param sigma relative one of the scaled speed; the azimuth is hardly known.
AckermannMotion seenMotion(int direction, double azimuth, double sigma)
{
    const double size = 0.2, c = std::cos(azimuth), s = std::sin(azimuth), along = std::pow(sigma * size, 2),
                 across = std::pow(0.6 * size, 2);
    AckermannMotion m;
    m.direction = direction;
    m.wallSlope = size * c;
    m.wallOffset = size * s;
    m.covariance(1, 1) = along * c * c + across * s * s;
    m.covariance(1, 2) = m.covariance(2, 1) = (along - across) * c * s;
    m.covariance(2, 2) = along * s * s + across * c * c;
    return m;
}

MotionPrior givenSpeed(double speed, double sigma)
{
    MotionPrior prior;
    prior.speed = speed;
    prior.speedSigma = sigma;
    return prior;
}

// Both are known by more than three sigmas, and differ in sign, whichever is forward and wherever the street leads.
TEST(RSAckermann_Contradiction, other_direction)
{
    for (const int direction : {1, -1})
        for (const double azimuth : {0., 0.4, -0.4, 0.8, -0.8, 1.5, -1.5, 2.8})
        {
            SCOPED_TRACE(testing::Message() << direction << " " << azimuth);
            const AckermannMotion sure = seenMotion(direction, azimuth, 0.3),
                                  unsure = seenMotion(direction, azimuth, 0.36);
            const double forward = direction * 9, back = -forward;
            EXPECT_TRUE(showsOtherDirection(sure, givenSpeed(back, 2.8)));
            EXPECT_FALSE(showsOtherDirection(unsure, givenSpeed(back, 2.8)));
            EXPECT_FALSE(showsOtherDirection(sure, givenSpeed(back, 3.2)));
            EXPECT_FALSE(showsOtherDirection(sure, givenSpeed(back, 0)));
            EXPECT_FALSE(showsOtherDirection(sure, givenSpeed(forward, 2.8)));
            EXPECT_FALSE(showsOtherDirection(seenMotion(direction, azimuth, 0), givenSpeed(back, 2.8)));
        }
}

// A yaw rate that nobody has given, with which the motion was estimated, contradicts nothing; what is given may.
TEST(RSAckermann_Contradiction, with_what_is_given_alone)
{
    for (const double sign : {1., -1.})
        for (const bool disagreesWithUsed : {false, true})
            for (const bool disagreesWithGiven : {false, true})
                for (const bool isGiven : {false, true})
                    for (const bool isOtherSpeed : {false, true})
                    {
                        SCOPED_TRACE(testing::Message()
                                     << sign << disagreesWithUsed << disagreesWithGiven << isGiven << isOtherSpeed);
                        AckermannMotion m;
                        m.seenYawRate = sign * 0.3;
                        m.seenYawRateSigma = 0.03;
                        m.seenSpeed = 9;
                        m.seenSpeedSigma = 0.3;
                        // 3-4-5 triangles: the difference has a sigma of 0.05 and 0.5
                        MotionPrior used = givenSpeed(9 + (isOtherSpeed ? 1.6 : 1.4), 0.4), given = used;
                        used.yawRate = sign * (0.3 - (disagreesWithUsed ? 0.16 : 0.14));
                        given.yawRate = sign * (0.3 - (disagreesWithGiven ? 0.16 : 0.14));
                        used.yawRateSigma = 0.04;
                        given.yawRateSigma = isGiven ? 0.04 : 0;
                        compareWithGiven(used, false, m);
                        EXPECT_EQ(disagreesWithUsed || isOtherSpeed, m.contradictsPrior);
                        compareAgain(used, given, m);
                        EXPECT_EQ(isOtherSpeed || (isGiven && disagreesWithGiven), m.contradictsPrior);
                        EXPECT_EQ(isGiven ? sign * 0.3 : 0, m.seenYawRate);
                        EXPECT_EQ(isGiven ? 0.03 : 0, m.seenYawRateSigma);
                        EXPECT_EQ(9, m.seenSpeed);
                    }
}

// The other direction is one whatever yaw rate was used.
TEST(RSAckermann_Contradiction, other_direction_beside_a_yaw_rate)
{
    MotionPrior used = givenSpeed(9, 0.4), given = used;
    used.yawRate = 0.3;
    used.yawRateSigma = 0.04;
    AckermannMotion m;
    m.seenYawRate = 0.3;
    m.seenYawRateSigma = 0.03;
    compareWithGiven(used, true, m);
    EXPECT_TRUE(m.contradictsPrior);
    compareAgain(used, given, m);
    EXPECT_TRUE(m.contradictsPrior);
}

}} // namespace opencv_test::
