// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_warp_cameras.hpp"

namespace opencv_test { namespace {

//! Area of the largest rectangle of valid pixels, by trying all of them; for small images.
int largestArea(const Mat& mask)
{
    Mat sums;
    cv::integral(mask / 255, sums, CV_32S);
    int best = 0;
    for (int y0 = 0; y0 < mask.rows; y0++)
        for (int y1 = y0 + 1; y1 <= mask.rows; y1++)
            for (int x0 = 0; x0 < mask.cols; x0++)
                for (int x1 = x0 + 1; x1 <= mask.cols; x1++)
                {
                    const int area = (x1 - x0) * (y1 - y0);
                    if (area > best &&
                        sums.at<int>(y1, x1) - sums.at<int>(y0, x1) - sums.at<int>(y1, x0) + sums.at<int>(y0, x0) ==
                            area)
                        best = area;
                }
    return best;
}

typedef testing::TestWithParam<int> WarpArea; // TestLens

TEST_P(WarpArea, valid_roi)
{
    RNG rng(31);
    for (int round = 0; round < 6; round++)
    {
        // the whole image in few pixels
        RollingShutterCamera camera = lensCamera(GetParam());
        mountAtRandom(camera, rng);
        const AckermannMotion motion = randomMotion(camera, rng);
        const Matx33d& K = camera.cameraMatrix;
        WarpMapGenerator::Params params;
        params.newCameraMatrix = Matx33d(K(0, 0) / 16, 0, 25, 0, K(1, 1) / 16, 16, 0, 0, 1);
        params.newSize = Size(49, 33);
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera, params);
        Mat map1, map2, mask;
        generator->initRectifyMap(motion, map1, map2, CV_32FC1, mask);
        const Rect roi = generator->validRoi(motion);
        ASSERT_EQ(roi, roi & Rect(Point(), params.newSize));
        EXPECT_EQ(roi.area(), cv::countNonZero(mask(roi)));
        EXPECT_EQ(largestArea(mask), roi.area());
        EXPECT_GT(roi.area(), 400);
        EXPECT_LT(roi.area(), 49 * 33);
    }
}

TEST_P(WarpArea, alpha)
{
    RNG rng(32);
    for (int round = 0; round < 6; round++)
    {
        RollingShutterCamera camera = lensCamera(GetParam());
        mountAtRandom(camera, rng);
        const AckermannMotion motion = randomMotion(camera, rng);
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
        WarpMapGenerator::Params params;
        params.newSize = round % 2 ? Size(800, 451) : Size();
        generator->setParams(params);

        params.newCameraMatrix = generator->optimalNewCameraMatrix(motion, 0);
        generator->setParams(params);
        Mat map1, map2, mask;
        generator->initRectifyMap(motion, map1, map2, CV_32FC1, mask);
        EXPECT_EQ(mask.size().area(), cv::countNonZero(mask)) << "round " << round;
        EXPECT_EQ(Rect(Point(), mask.size()), generator->validRoi(motion));

        const Matx33d whole = generator->optimalNewCameraMatrix(motion, 1);
        const Matx33d half = generator->optimalNewCameraMatrix(motion, 0.5);
        EXPECT_LE(cv::norm(half - (whole + params.newCameraMatrix) * 0.5), 1e-9);
        params.newCameraMatrix = whole;
        generator->setParams(params);
        generator->initDistortMap(motion, map1, map2, CV_32FC1, mask);
        EXPECT_EQ(mask.size().area(), cv::countNonZero(mask)) << "round " << round;
        double low, high;
        cv::minMaxLoc(map1, &low, &high);
        const Size size = params.newSize == Size() ? camera.imageSize : params.newSize;
        EXPECT_NEAR(0, low, 1e-2);
        EXPECT_NEAR(size.width - 1, high, 1e-2);
        cv::minMaxLoc(map2, &low, &high);
        EXPECT_NEAR(0, low, 1e-2);
        EXPECT_NEAR(size.height - 1, high, 1e-2);
    }
}

INSTANTIATE_TEST_CASE_P(RSAckermann, WarpArea, testing::Values(ALL_LENSES));

TEST(RSAckermann_WarpArea, lens_alone_is_like_OpenCV)
{
    // OpenCV samples nine points a side, up to one pixel beyond the last one.
    const int lenses[] = {BROWN_4, BROWN_5, BROWN_8};
    for (int i = 0; i < 3; i++)
    {
        const RollingShutterCamera camera = lensCamera(lenses[i]);
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
        for (double alpha = 0; alpha <= 1; alpha += 0.25)
        {
            const Size size(700, 400);
            const Mat K =
                cv::getOptimalNewCameraMatrix(camera.cameraMatrix, camera.distCoeffs, camera.imageSize, alpha, size);
            const Matx33d got = generator->optimalNewCameraMatrix(AckermannMotion(), alpha, size);
            for (int k = 0; k < 9; k++)
                EXPECT_NEAR(K.at<double>(k / 3, k % 3), got.val[k], 0.005 * size.width)
                    << "entry " << k << ", alpha " << alpha;
        }
    }
}

TEST(RSAckermann_WarpArea, at_rest)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    EXPECT_EQ(Rect(Point(), camera.imageSize), generator->validRoi(AckermannMotion()));
    for (int alpha = 0; alpha <= 1; alpha++)
        EXPECT_LE(cv::norm(generator->optimalNewCameraMatrix(AckermannMotion(), alpha) - camera.cameraMatrix), 1e-9);
}

TEST(RSAckermann_WarpArea, nothing_is_seen)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    AckermannMotion motion;
    motion.status = MOTION_OK;
    motion.wallOffset = 1e9; // a wall at the lens
    RollingShutterCamera late = camera;
    late.referenceRow = -1;
    generator->setCamera(late);
    EXPECT_TRUE(generator->validRoi(motion).empty());
    EXPECT_EQ(camera.cameraMatrix, generator->optimalNewCameraMatrix(motion, 0));
}

TEST(RSAckermann_WarpArea, bad_arguments)
{
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(simulation::paperCamera());
    EXPECT_THROW(generator->optimalNewCameraMatrix(AckermannMotion(), -0.1), cv::Exception);
    EXPECT_THROW(generator->optimalNewCameraMatrix(AckermannMotion(), 1.1), cv::Exception);
    EXPECT_THROW(generator->optimalNewCameraMatrix(AckermannMotion(), std::numeric_limits<double>::quiet_NaN()),
                 cv::Exception);
    EXPECT_THROW(generator->optimalNewCameraMatrix(AckermannMotion(), 0, Size(-1, 5)), cv::Exception);
}

// One pixel a side has no extent that could be fitted to that of the raw image.
TEST(RSAckermann_WarpArea, sizes_of_few_pixels)
{
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(lensCamera(BROWN_5));
    const Size tooSmall[] = {Size(1, 1), Size(1, 100), Size(100, 1)};
    for (int i = 0; i < 3; i++)
    {
        EXPECT_THROW(generator->optimalNewCameraMatrix(AckermannMotion(), 0, tooSmall[i]), cv::Exception)
            << tooSmall[i];
        WarpMapGenerator::Params params;
        params.newSize = tooSmall[i];
        const Ptr<WarpMapGenerator> ofThatSize = WarpMapGenerator::create(generator->getCamera(), params);
        EXPECT_THROW(ofThatSize->optimalNewCameraMatrix(AckermannMotion(), 0), cv::Exception) << tooSmall[i];
    }
    std::string message;
    try
    {
        generator->optimalNewCameraMatrix(AckermannMotion(), 0, Size(1, 100));
    }
    catch (const cv::Exception& e)
    {
        message = e.err;
    }
    EXPECT_NE(std::string::npos, message.find("newSize is 1 x 100; at least 2 x 2 is expected")) << message;

    const Size smallest[] = {Size(2, 2), Size(2, 100), Size(100, 2)};
    for (int i = 0; i < 3; i++)
        for (double alpha = 0; alpha <= 1; alpha += 0.5)
        {
            WarpMapGenerator::Params params;
            params.newSize = smallest[i];
            params.newCameraMatrix = generator->optimalNewCameraMatrix(AckermannMotion(), alpha, smallest[i]);
            EXPECT_GT(params.newCameraMatrix(0, 0), 0) << smallest[i] << ", alpha " << alpha;
            EXPECT_GT(params.newCameraMatrix(1, 1), 0) << smallest[i] << ", alpha " << alpha;
            EXPECT_NO_THROW(WarpMapGenerator::create(generator->getCamera(), params))
                << smallest[i] << ", alpha " << alpha;
        }
}

}} // namespace opencv_test::
