// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_simulator.hpp"
#include "../src/single/relative_depth.hpp"

namespace opencv_test { namespace {

void addVertical(double x, double length, Mat& segments)
{
    Mat row(Matx14d(x, 150, x, 150 + length));
    segments.push_back(row);
}

// What stands in the image at a step of the depth speaks for it, what stands beside doesn't, and what is short isn't
// asked.
TEST(RSAckermann_RelativeDepth, edges_in_common_with_the_image)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Size size = camera.imageSize;
    Mat values(size, CV_32F, Scalar(1));
    const int stripe = size.width / 4;
    for (int i = 1; i < 4; i += 2)
        values.colRange(i * stripe, (i + 1) * stripe).setTo(2);
    const DepthMap depth(values, DEPTH_RAW, 1, DEPTH_RELATIVE);
    const RelativeDepth relative(depth, camera, Matx33d::eye());
    Mat atSteps(0, 4, CV_64F), beside(0, 4, CV_64F);
    for (int i = 1; i < 4; i++)
        addVertical(i * stripe - 0.5, 100, atSteps);
    addVertical(1.5 * stripe, 100, atSteps);
    for (int i = 0; i < 4; i++)
        addVertical((i + 0.5) * stripe, 100, beside);
    const double minLength = 35, most = relative.edgesInCommon(atSteps, minLength);
    // Three of four, each by 1: the sum over the root of the squares about the mean.
    EXPECT_NEAR(3 / std::sqrt(3 - 9 / 4.), most, 1e-9);
    // All that agree are no less, but one alone says nothing.
    EXPECT_GT(relative.edgesInCommon(atSteps.rowRange(0, 3), minLength), most);
    EXPECT_EQ(0, relative.edgesInCommon(atSteps.row(0), minLength));
    EXPECT_EQ(0, relative.edgesInCommon(beside, minLength));
    EXPECT_EQ(0, relative.edgesInCommon(Mat(0, 4, CV_64F), minLength));
    for (int i = 0; i < 20; i++)
        addVertical(1.5 * stripe + 0.1 * i, 30, atSteps);
    EXPECT_EQ(most, relative.edgesInCommon(atSteps, minLength));
    EXPECT_LT(relative.edgesInCommon(atSteps, 25), 0.8 * most);
}

// Depths err in proportion: the horizon of a road is known nearly as well as its nearest parts allow.
TEST(RSAckermann_RelativeDepth, road_with_noise)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    RNG rng(4);
    const double scale = 3, shift = 2, horizon = camera.cameraMatrix(1, 2), f = camera.cameraMatrix(1, 1);
    double slopes = 0, zeros = 0;
    const int rounds = 60;
    for (int round = 0; round < rounds; round++)
    {
        Mat values(camera.imageSize, CV_32F);
        for (int y = 0; y < values.rows; y++)
            for (int x = 0; x < values.cols; x++)
                values.at<float>(y, x) =
                    float(shift + scale * std::max(y - horizon, 0.) / f * (1 + rng.gaussian(0.04)));
        const DepthMap depth(values, DEPTH_RAW, 1, DEPTH_RELATIVE);
        const RelativeDepth road(depth, camera, Matx33d::eye());
        ASSERT_TRUE(road.hasRoad());
        slopes += std::pow(road.slope() / scale - 1, 2) / rounds;
        zeros += std::pow((road.infinity() - shift) / scale, 2) / rounds;
    }
    EXPECT_LT(std::sqrt(slopes), 0.004);
    EXPECT_LT(std::sqrt(zeros), 0.00032);
}

}} // namespace
