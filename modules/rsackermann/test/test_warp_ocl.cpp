// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "opencv2/core/ocl.hpp"
#include "test_warp_cameras.hpp"

// Maps of an OpenCL device against those of the CPU. OpenCV takes a CPU as a device only if the environment variable
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

//! The map of either direction.
void initMap(const Ptr<WarpMapGenerator>& generator, bool distort, const AckermannMotion& motion, OutputArray map1,
             OutputArray map2, int m1type = CV_32FC1, OutputArray mask = noArray())
{
    if (distort)
        generator->initDistortMap(motion, map1, map2, m1type, mask);
    else
        generator->initRectifyMap(motion, map1, map2, m1type, mask);
}

typedef testing::TestWithParam<std::tuple<int, int, bool>> WarpOpenCL; // TestLens, ScanDirection, whether to distort

RollingShutterCamera scannedCamera(const WarpOpenCL::ParamType& param)
{
    RollingShutterCamera camera = lensCamera(std::get<0>(param));
    camera.scanDirection = std::get<1>(param);
    return camera;
}

TEST_P(WarpOpenCL, equals_CPU)
{
    skipWithoutDevice();
    const bool distort = std::get<2>(GetParam());
    RNG rng(51);
    for (int round = 0; round < 4; round++)
    {
        RollingShutterCamera camera = lensCamera(std::get<0>(GetParam()));
        mountAtRandom(camera, rng);
        camera.scanDirection = std::get<1>(GetParam());
        AckermannMotion motion = randomMotion(camera, rng);
        motion.headingCorrection = rng.uniform(-0.3, 0.3);
        motion.pitchRate = motion.rollRate = 0;
        motion.rotationCurve.release();
        if (round == 0)
            motion.status = MOTION_NOT_SIGNIFICANT;
        if (round > 1)
        {
            motion.offsetArea = distort ? Rect2d(-0.3, -0.2, 0.7, 0.35) : Rect2d(-1, -0.8, 2, 1.6);
            motion.inverseDepthOffset.create(distort ? Size(9, 6) : Size(19, 16), CV_64F);
            rng.fill(motion.inverseDepthOffset, RNG::NORMAL, 0, 0.05 * std::hypot(motion.wallSlope, motion.wallOffset));
        }
        WarpMapGenerator::Params params;
        params.tolerance = 1e-4; // of both
        if (round % 2)
        {
            params.newCameraMatrix = Matx33d(600, 3, 290, 0, 640, 210, 0, 0, 1);
            params.newSize = Size(601, 423);
        }
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera, params);
        UMat map1, map2, mask;
        Mat expected1, expected2, expectedMask;
        initMap(generator, distort, motion, map1, map2, CV_32FC1, mask);
        initMap(generator, distort, motion, expected1, expected2, CV_32FC1, expectedMask);
        ASSERT_EQ(expected1.size(), map1.size());

        // At the border a rounding error decides whether a pixel is seen.
        const Mat seen = mask.getMat(ACCESS_READ) & expectedMask;
        EXPECT_LE(cv::countNonZero(mask.getMat(ACCESS_READ) != expectedMask), 20) << "round " << round;
        EXPECT_LE(maxDifference(map1, expected1, seen), 1e-3) << "round " << round;
        EXPECT_LE(maxDifference(map2, expected2, seen), 1e-3) << "round " << round;
        EXPECT_GE(cv::countNonZero(seen), distort ? 60000 : 90000);
        // in single precision there are differences, or the device hasn't been used
        EXPECT_GT(maxDifference(map1, expected1, seen) + maxDifference(map2, expected2, seen), 0) << "round " << round;
    }
}

// The device's kernel doesn't know them.
TEST_P(WarpOpenCL, rows_that_pitch_and_roll_are_left_to_the_processor)
{
    skipWithoutDevice();
    const bool distort = std::get<2>(GetParam());
    const RollingShutterCamera camera = scannedCamera(GetParam());
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    for (bool isCurve : {false, true})
    {
        AckermannMotion motion = motionFromMetric(camera, 0.6, 15, 2.5, 3, 0);
        if (isCurve)
            motion.rotationCurve = (Mat_<double>(3, 3) << 0, 0, 0, 0.002, 0, 0, 0, 0.001, 0);
        else
            (distort ? motion.pitchRate : motion.rollRate) = 0.02;
        UMat map1, map2, mask;
        Mat expected1, expected2, expectedMask;
        initMap(generator, distort, motion, map1, map2, CV_32FC1, mask);
        initMap(generator, distort, motion, expected1, expected2, CV_32FC1, expectedMask);
        EXPECT_EQ(0, maxDifference(map1, expected1)) << isCurve;
        EXPECT_EQ(0, maxDifference(map2, expected2)) << isCurve;
        EXPECT_EQ(0, maxDifference(mask, expectedMask)) << isCurve;
    }
}

TEST_P(WarpOpenCL, map_types)
{
    skipWithoutDevice();
    const bool distort = std::get<2>(GetParam());
    const RollingShutterCamera camera = scannedCamera(GetParam());
    const AckermannMotion motion = motionFromMetric(camera, 0.6, 15, 2.5, 3, 0);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    UMat columns, rows, mask, xy, none(3, 3, CV_8U), whole, fraction;
    Mat hostMask;
    initMap(generator, distort, motion, columns, rows, CV_32FC1, mask);
    initMap(generator, distort, motion, xy, none, CV_32FC2, hostMask);
    EXPECT_TRUE(none.empty());
    EXPECT_EQ(0, maxDifference(mask, hostMask));
    std::vector<Mat> split;
    cv::split(xy.getMat(ACCESS_READ), split);
    EXPECT_EQ(0, maxDifference(columns, split[0]));
    EXPECT_EQ(0, maxDifference(rows, split[1]));

    const int types[] = {CV_16SC2, 0, -1};
    Mat expectedWhole, expectedFraction;
    cv::convertMaps(split[0], split[1], expectedWhole, expectedFraction, CV_16SC2);
    for (int i = 0; i < 3; i++)
    {
        initMap(generator, distort, motion, whole, fraction, types[i]);
        ASSERT_EQ(CV_16SC2, whole.type());
        ASSERT_EQ(CV_16UC1, fraction.type());
        EXPECT_EQ(0, maxDifference(whole, expectedWhole));
        EXPECT_EQ(0, maxDifference(fraction, expectedFraction));
    }
}

TEST_P(WarpOpenCL, preallocated_outputs_are_reused)
{
    skipWithoutDevice();
    const bool distort = std::get<2>(GetParam());
    const RollingShutterCamera camera = scannedCamera(GetParam());
    const AckermannMotion motion = motionFromMetric(camera, 0.6, 15, 2.5, 3, 0);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    Mat expected1, expected2, expectedMask;
    UMat large(camera.imageSize.height + 2, camera.imageSize.width + 3, CV_32FC1, Scalar(5));
    UMat map1 = large(Rect(Point(2, 1), camera.imageSize)), map2(camera.imageSize, CV_32FC1),
         mask(camera.imageSize, CV_8U);
    const void* const handles[] = {map2.handle(ACCESS_READ), mask.handle(ACCESS_READ)};
    initMap(generator, distort, motion, map1, map2, CV_32FC1, mask);
    EXPECT_EQ(handles[0], map2.handle(ACCESS_READ));
    EXPECT_EQ(handles[1], mask.handle(ACCESS_READ));
    initMap(generator, distort, motion, expected1, expected2, CV_32FC1, expectedMask);
    const Mat written = large.getMat(ACCESS_READ);
    EXPECT_LE(cvtest::norm(written(Rect(Point(2, 1), camera.imageSize)), expected1, NORM_INF,
                           expectedMask & mask.getMat(ACCESS_READ)),
              1e-3);
    EXPECT_EQ(written.cols, cv::countNonZero(written.row(0) == 5));
    EXPECT_EQ(written.rows, cv::countNonZero(written.col(1) == 5));
}

INSTANTIATE_TEST_CASE_P(RSAckermann, WarpOpenCL,
                        testing::Combine(testing::Values(ALL_LENSES),
                                         testing::Values(SCAN_TOP_TO_BOTTOM, SCAN_BOTTOM_TO_TOP, SCAN_LEFT_TO_RIGHT,
                                                         SCAN_RIGHT_TO_LEFT),
                                         testing::Bool()));

TEST(RSAckermann_WarpOpenCL, absurd_motion_gives_no_NaN)
{
    skipWithoutDevice();
    RNG rng(52);
    const double magnitudes[] = {1, 10, 1e3, 1e9, 1e150};
    const int lenses[] = {ALL_LENSES};
    for (int round = 0; round < 70; round++)
    {
        RollingShutterCamera camera = lensCamera(lenses[round % 7]);
        mountAtRandom(camera, rng);
        camera.imageSize = Size(161, 97);
        AckermannMotion motion;
        motion.status = MOTION_OK;
        motion.alpha = rng.uniform(-1., 1.) * magnitudes[round % 5];
        motion.wallSlope = rng.uniform(-1., 1.) * magnitudes[round % 5];
        motion.wallOffset = rng.uniform(-1., 1.) * magnitudes[round % 5];
        motion.wallRatio = rng.uniform(0., 2.);
        motion.roadSlope = rng.uniform(-1., 1.) * magnitudes[round % 5];
        UMat map1, map2;
        for (int distort = 0; distort < 2; distort++)
        {
            initMap(WarpMapGenerator::create(camera), distort != 0, motion, map1, map2);
            EXPECT_TRUE(cv::checkRange(map1.getMat(ACCESS_READ), true, 0, -SHRT_MAX - 1., SHRT_MAX + 1.));
            EXPECT_TRUE(cv::checkRange(map2.getMat(ACCESS_READ), true, 0, -SHRT_MAX - 1., SHRT_MAX + 1.));
        }
    }
}

TEST(RSAckermann_WarpOpenCL, walls_that_are_passed_show_nothing)
{
    skipWithoutDevice();
    RollingShutterCamera camera = simulation::paperCamera();
    camera.referenceRow = 0;
    const int passedRow = 300;
    for (int right = 0; right < 2; right++)
    {
        const AckermannMotion motion = motionThroughWall(camera, passedRow, right != 0);
        UMat map1, map2, mask;
        initMap(WarpMapGenerator::create(camera), true, motion, map1, map2, CV_32FC1, mask);
        const Mat columns = map1.getMat(ACCESS_READ);
        EXPECT_EQ(0, cv::countNonZero(columns.rowRange(0, passedRow - 1) == -16384)) << right;
        EXPECT_EQ((camera.imageSize.height - passedRow - 2) * columns.cols,
                  cv::countNonZero(columns.rowRange(passedRow + 2, columns.rows) == -16384))
            << right;
        initMap(WarpMapGenerator::create(camera), false, motion, map1, map2, CV_32FC1, mask);
        double last;
        cv::minMaxLoc(map2.getMat(ACCESS_READ), 0, &last);
        EXPECT_LE(last, passedRow + 0.01) << right;
    }
}

TEST(RSAckermann_WarpOpenCL, rows_beyond_a_wall_beside_show_nothing)
{
    skipWithoutDevice();
    const double passedRow = 300;
    for (int right = 0; right < 2; right++)
    {
        RollingShutterCamera camera = simulation::paperCamera();
        const AckermannMotion motion = motionSideways(camera, passedRow, right != 0);
        UMat map1, map2;
        initMap(WarpMapGenerator::create(camera), false, motion, map1, map2);
        const Mat rows = map2.getMat(ACCESS_READ);
        double last;
        cv::minMaxLoc(rows, 0, &last, 0, 0, rows != -16384);
        EXPECT_LE(last, passedRow + 0.1) << "right " << right;
        EXPECT_GE(last, passedRow - 10) << "right " << right;
    }
}

// Rays up to the border of strongly distorted images, and pixels beyond the lens model.
TEST(RSAckermann_WarpOpenCL, strong_lenses)
{
    skipWithoutDevice();
    RollingShutterCamera barrel = simulation::paperCamera(), pincushion = barrel, fisheye = barrel, ended = barrel;
    barrel.cameraMatrix = Matx33d(330, 0, 320, 0, 330, 190, 0, 0, 1);
    barrel.distCoeffs = {-0.36, 0.16, 1e-3, -1e-3};
    pincushion.cameraMatrix = Matx33d(500, 0, 320, 0, 500, 190, 0, 0, 1);
    pincushion.distCoeffs = {0.8, 0.3, -2e-3, 2e-3};
    fisheye.cameraMatrix = Matx33d(300, 0, 320, 0, 300, 190, 0, 0, 1);
    fisheye.lensModel = LENS_FISHEYE;
    fisheye.distCoeffs = {-0.02, 0.01, -0.01, 0.002};
    ended.cameraMatrix = Matx33d(200, 0, 319.5, 0, 200, 189.5, 0, 0, 1);
    ended.distCoeffs = {-0.5, 0, 0, 0};
    const RollingShutterCamera cameras[] = {barrel, pincushion, fisheye, ended};
    for (int i = 0; i < 4; i++)
    {
        const AckermannMotion motion = motionFromMetric(cameras[i], 0.6, 15, 2.5, 3, 0);
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(cameras[i]);
        UMat map1, map2, mask;
        Mat expected1, expected2, expectedMask;
        generator->initDistortMap(motion, map1, map2, CV_32FC1, mask);
        generator->initDistortMap(motion, expected1, expected2, CV_32FC1, expectedMask);
        const Mat seen = mask.getMat(ACCESS_READ) & expectedMask;
        EXPECT_LE(cv::countNonZero(mask.getMat(ACCESS_READ) != expectedMask), 20) << "camera " << i;
        EXPECT_LE(maxDifference(map1, expected1, seen), 1e-3) << "camera " << i;
        EXPECT_LE(maxDifference(map2, expected2, seen), 1e-3) << "camera " << i;
        EXPECT_GE(cv::countNonZero(seen), 30000) << "camera " << i;
    }
}

TEST(RSAckermann_WarpOpenCL, without_a_device)
{
    const KeepOpenCL keep;
    cv::ocl::setUseOpenCL(false);
    const RollingShutterCamera camera = lensCamera(BROWN_5);
    const AckermannMotion motion = motionFromMetric(camera, 0.6, 15, 2.5, 3, 0);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    UMat map1, map2, mask;
    Mat expected1, expected2, expectedMask;
    for (int distort = 0; distort < 2; distort++)
    {
        initMap(generator, distort != 0, motion, map1, map2, CV_32FC1, mask);
        initMap(generator, distort != 0, motion, expected1, expected2, CV_32FC1, expectedMask);
        EXPECT_EQ(0, maxDifference(map1, expected1));
        EXPECT_EQ(0, maxDifference(map2, expected2));
        EXPECT_EQ(0, maxDifference(mask, expectedMask));
    }
}

}} // namespace opencv_test::
