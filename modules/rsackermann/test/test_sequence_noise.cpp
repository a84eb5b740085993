// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_random.hpp"

#include "../src/factors/robust_losses.hpp"
#include "../src/sequence/residual_noise.hpp"

namespace opencv_test { namespace {

using namespace cv::rsackermann;

TEST(RSAckermann_PrivateResidualNoise, weights_make_residuals_of_unit_variance)
{
    RNG rng(1);
    for (int i = 0; i < 10000; i++)
    {
        const PointNoise noise = {rng.uniform(0.01, 1.), rng.uniform(0., 1.)};
        const Point2d d = i % 10 ? gaussianPoint(rng, 3) : Point2d(), weak = i % 7 ? gaussianPoint(rng, 3) : Point2d(),
                      deviation = noise.depths * d,
                      ofTexture = std::min(POINT_SIGMA * noise.points, TRACKING_SIGMA) * weak;
        const double sigma = POINT_SIGMA * noise.points;
        Matx22d covariance = sigma * sigma * Matx22d::eye();
        for (const Point2d& p : {deviation, ofTexture})
            covariance += Matx22d(p.x * p.x, p.x * p.y, p.x * p.y, p.y * p.y);
        const Matx22d W = noise.weight(weak, d);
        ASSERT_LT(cvtest::norm(W * covariance * W, Matx22d::eye(), NORM_INF), 1e-9) << i;
        ASSERT_NEAR(W(0, 1), W(1, 0), 1e-12) << i;
    }
}

// Neither a point that is all but behind the camera nor an edge without any texture makes weights that aren't numbers.
TEST(RSAckermann_PrivateResidualNoise, weights_of_extremes_are_numbers)
{
    RNG rng(4);
    for (int i = 0; i < 10000; i++)
    {
        const double sigma = std::pow(10, rng.uniform(-3., 0.));
        const PointNoise noise = {sigma, rng.uniform(0., 1.)};
        const Matx22d W = noise.weight(gaussianPoint(rng, std::pow(10, rng.uniform(0., 7.))),
                                       gaussianPoint(rng, std::pow(10, rng.uniform(0., 9.))));
        ASSERT_TRUE(checkRange(W)) << i;
        ASSERT_LT(cvtest::norm(W, NORM_INF), 1.01 / (POINT_SIGMA * sigma)) << i;
    }
}

//! Residuals of points whose depths are off by a share of the usual deviation. @param edges usual length of weak, for
//! half of them.
PointResiduals residualsOf(const PointNoise& noise, double edges, int count, RNG& rng)
{
    PointResiduals residuals;
    for (int i = 0; i < count; i++)
    {
        const Point2d d = gaussianPoint(rng, 4), weak = i % 2 ? Point2d() : gaussianPoint(rng, edges);
        const double sigma = POINT_SIGMA * noise.points;
        residuals.add(gaussianPoint(rng, sigma) + rng.gaussian(std::min(sigma, TRACKING_SIGMA)) * weak +
                          rng.gaussian(noise.depths) * d,
                      weak, d);
    }
    return residuals;
}

TEST(RSAckermann_PrivateResidualNoise, is_what_residuals_show)
{
    RNG rng(2);
    for (const double points : {0.03, 0.3, 0.6})
        for (const double depths : {0., 0.1, 0.5})
            for (const double edges : {0, 30})
            {
                SCOPED_TRACE(testing::Message() << points << " " << depths << " " << edges);
                const PointNoise noise = {points, depths};
                PointResiduals residuals = residualsOf(noise, edges, 10000, rng);
                // A third as many move otherwise.
                for (int i = 0; i < 3000; i++)
                    residuals.add(gaussianPoint(rng, 30), Point2d(), gaussianPoint(rng, 4));
                const PointNoise found = residuals.noise(0.01);
                EXPECT_GT(found.points, points * 0.95);
                EXPECT_LT(found.points, points * 1.7);
                EXPECT_NEAR(depths, found.depths, 0.3 * depths + 0.15);
            }
}

TEST(RSAckermann_PrivateResidualNoise, is_within_limits)
{
    RNG rng(3);
    const PointNoise exact = residualsOf({0.01, 0}, 0, 1000, rng).noise(0.2),
                     wild = residualsOf({5, 5}, 0, 1000, rng).noise(0.2), none = PointResiduals().noise(0.2);
    EXPECT_EQ(0.2, exact.points);
    EXPECT_LT(exact.depths, 0.01);
    EXPECT_EQ(1, wild.points);
    EXPECT_EQ(1, wild.depths);
    EXPECT_EQ(1, none.points);
    EXPECT_EQ(1, none.depths);
    PointResiduals farAway; // however far a point is off its plane it is seen there
    farAway.add(Point2d(1, 1), Point2d(), Point2d());
    EXPECT_TRUE(farAway.across.empty());
    EXPECT_TRUE(farAway.along.empty());
}

// Wherever points deviate to: the variance of what neighbours deviate together. Outliers don't count, and what they
// deviate alike in the other direction, too, doesn't.
TEST(RSAckermann_PrivateResidualNoise, dependence_is_that_of_neighbours)
{
    RNG rng(4);
    for (const int together : {1, 4, 20})
        for (const bool isSpread : {false, true})
            for (const bool isTurned : {false, true})
            {
                double mean = 0;
                const int rounds = 40, houses = 40;
                for (int round = 0; round < rounds; round++)
                {
                    Neighbours neighbours(1);
                    for (int i = 0; i < houses; i++)
                    {
                        const double deviation = rng.uniform(0, 2) ? 1 : -1, across = isTurned ? deviation : 0;
                        for (int k = 0; k < together; k++)
                        {
                            const double angle = rng.uniform(0., 2 * CV_PI);
                            const Vec2d d(3 * std::cos(angle), 3 * std::sin(angle));
                            // Neighbours are within reach, all else isn't.
                            const Point2d place(isSpread ? 7. * (k * houses + i) : 7. * i, rng.uniform(0., 0.9));
                            const Vec2d residual = (deviation * d + across * Vec2d(-d[1], d[0])) / 3;
                            neighbours.add(place, residual, d);
                            neighbours.add(place, Vec2d(100, 100), d);
                            neighbours.add(place, residual, Point2d());
                        }
                    }
                    mean += neighbours.dependence() / rounds;
                }
                EXPECT_NEAR(isSpread || isTurned ? 1 : together, mean / DEPENDENCE, 0.05 * together);
            }
    EXPECT_EQ(DEPENDENCE, Neighbours(1).dependence());
}

}} // namespace
