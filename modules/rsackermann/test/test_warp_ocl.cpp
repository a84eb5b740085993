// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "opencv2/core/ocl.hpp"
#include "test_warp_cameras.hpp"

// Maps of an OpenCL device against those of the CPU. OpenCV takes a CPU as a device only where the environment variable
// OPENCV_OPENCL_DEVICE says so, for instance ":CPU:" with PoCL.

namespace opencv_test { namespace {

void skipWithoutDevice()
{
    if (!cv::ocl::useOpenCL())
        throw SkipTestException("There is no OpenCL device");
}

//! Puts back the use of OpenCL when a test ends.
struct KeepOpenCL
{
    KeepOpenCL() : used(cv::ocl::useOpenCL()) {}
    ~KeepOpenCL() { cv::ocl::setUseOpenCL(used); }
    bool used;
};

double maxDifference(const UMat& a, const Mat& b, const Mat& mask = Mat())
{
    return cvtest::norm(a.getMat(ACCESS_READ), b, NORM_INF, mask);
}

typedef testing::TestWithParam<std::tuple<int, int> > WarpOpenCL; // TestLens, ScanDirection

TEST_P(WarpOpenCL, equals_CPU)
{
    skipWithoutDevice();
    RNG rng(51);
    for (int round = 0; round < 4; round++)
    {
        RollingShutterCamera camera = lensCamera(std::get<0>(GetParam()));
        mountAtRandom(camera, rng);
        camera.scanDirection = std::get<1>(GetParam());
        AckermannMotion motion = randomMotion(camera, rng);
        if (round == 0)
            motion.status = MOTION_NOT_SIGNIFICANT;
        WarpMapGenerator::Params params;
        if (round % 2)
        {
            params.newCameraMatrix = Matx33d(600, 3, 290, 0, 640, 210, 0, 0, 1);
            params.newSize = Size(601, 423);
        }
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera, params);
        UMat map1, map2, mask;
        Mat expected1, expected2, expectedMask;
        generator->initRectifyMap(motion, map1, map2, CV_32FC1, mask);
        generator->initRectifyMap(motion, expected1, expected2, CV_32FC1, expectedMask);
        ASSERT_EQ(expected1.size(), map1.size());

        // At the border a rounding error decides whether a pixel is seen.
        const Mat seen = mask.getMat(ACCESS_READ) & expectedMask;
        EXPECT_LE(cv::countNonZero(mask.getMat(ACCESS_READ) != expectedMask), 20) << "round " << round;
        EXPECT_LE(maxDifference(map1, expected1, seen), 1e-3) << "round " << round;
        EXPECT_LE(maxDifference(map2, expected2, seen), 1e-3) << "round " << round;
        EXPECT_GE(cv::countNonZero(seen), 100000);
        // in single precision there are differences, or the device hasn't been used
        EXPECT_GT(maxDifference(map1, expected1, seen) + maxDifference(map2, expected2, seen), 0) << "round " << round;
    }
}

INSTANTIATE_TEST_CASE_P(RSAckermann, WarpOpenCL,
                        testing::Combine(testing::Values(ALL_LENSES),
                                         testing::Values(SCAN_TOP_TO_BOTTOM, SCAN_BOTTOM_TO_TOP, SCAN_LEFT_TO_RIGHT, SCAN_RIGHT_TO_LEFT)));

TEST(RSAckermann_WarpOpenCL, map_types)
{
    skipWithoutDevice();
    const RollingShutterCamera camera = lensCamera(BROWN_5);
    const AckermannMotion motion = AckermannMotion::fromMetric(camera, 0.6, 15, 2.5, 3, 0);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    UMat columns, rows, xy, none(3, 3, CV_8U), whole, fraction;
    generator->initRectifyMap(motion, columns, rows);
    generator->initRectifyMap(motion, xy, none, CV_32FC2);
    EXPECT_TRUE(none.empty());
    std::vector<Mat> split;
    cv::split(xy.getMat(ACCESS_READ), split);
    EXPECT_EQ(0, maxDifference(columns, split[0]));
    EXPECT_EQ(0, maxDifference(rows, split[1]));

    const int types[] = {CV_16SC2, 0};
    Mat expectedWhole, expectedFraction;
    cv::convertMaps(split[0], split[1], expectedWhole, expectedFraction, CV_16SC2);
    for (int i = 0; i < 2; i++)
    {
        generator->initRectifyMap(motion, whole, fraction, types[i]);
        ASSERT_EQ(CV_16SC2, whole.type());
        ASSERT_EQ(CV_16UC1, fraction.type());
        EXPECT_EQ(0, maxDifference(whole, expectedWhole));
        EXPECT_EQ(0, maxDifference(fraction, expectedFraction));
    }
}

TEST(RSAckermann_WarpOpenCL, absurd_motion_gives_no_NaN)
{
    skipWithoutDevice();
    RNG rng(52);
    const double magnitudes[] = {1, 10, 1e3, 1e9, 1e200};
    for (int round = 0; round < 20; round++)
    {
        RollingShutterCamera camera = lensCamera(round % 2 ? BROWN_5 : NO_LENS);
        mountAtRandom(camera, rng);
        AckermannMotion motion;
        motion.status = MOTION_OK;
        motion.alpha = rng.uniform(-1., 1.) * magnitudes[round % 5];
        motion.B = rng.uniform(-1., 1.) * magnitudes[round % 5];
        motion.D = rng.uniform(-1., 1.) * magnitudes[round % 5];
        motion.lambda = rng.uniform(0., 2.);
        motion.G = rng.uniform(-1., 1.) * magnitudes[round % 5];
        UMat map1, map2;
        WarpMapGenerator::create(camera)->initRectifyMap(motion, map1, map2);
        EXPECT_TRUE(cv::checkRange(map1.getMat(ACCESS_READ), true, 0, -SHRT_MAX - 1., SHRT_MAX + 1.));
        EXPECT_TRUE(cv::checkRange(map2.getMat(ACCESS_READ), true, 0, -SHRT_MAX - 1., SHRT_MAX + 1.));
    }
}

TEST(RSAckermann_WarpOpenCL, without_a_device)
{
    const KeepOpenCL keep;
    cv::ocl::setUseOpenCL(false);
    const RollingShutterCamera camera = lensCamera(BROWN_5);
    const AckermannMotion motion = AckermannMotion::fromMetric(camera, 0.6, 15, 2.5, 3, 0);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    UMat map1, map2, mask;
    Mat expected1, expected2, expectedMask;
    for (int distort = 0; distort < 2; distort++)
    {
        if (distort)
        {
            generator->initDistortMap(motion, map1, map2, CV_32FC1, mask);
            generator->initDistortMap(motion, expected1, expected2, CV_32FC1, expectedMask);
        }
        else
        {
            generator->initRectifyMap(motion, map1, map2, CV_32FC1, mask);
            generator->initRectifyMap(motion, expected1, expected2, CV_32FC1, expectedMask);
        }
        EXPECT_EQ(0, maxDifference(map1, expected1));
        EXPECT_EQ(0, maxDifference(map2, expected2));
        EXPECT_EQ(0, maxDifference(mask, expectedMask));
    }
}

}} // namespace opencv_test::
