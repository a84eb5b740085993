// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_warp_cameras.hpp"

namespace opencv_test { namespace {

const float FAR_OUTSIDE = -16384;

AckermannMotion exampleMotion(const RollingShutterCamera& camera)
{
    return motionFromMetric(camera, 0.6, 15, 2.5, 3, camera.heading);
}

//! Largest difference of two maps over pixels whose mask isn't 0.
double maxDifference(const Mat& a, const Mat& b, const Mat& mask = Mat())
{
    return cvtest::norm(a, b, NORM_INF, mask);
}

//! Every coordinate is a number, and none is farther off than what fits into CV_16SC2.
void expectAddressable(const Mat& map)
{
    EXPECT_TRUE(cv::checkRange(map, true, 0, -SHRT_MAX - 1., SHRT_MAX + 1.));
}

//////////////////////////////////////////////// inverse of one another ////////////////////////////////////////////////

typedef testing::TestWithParam<int> WarpLens; // TestLens

//! Bilinear interpolation of a map in the pixel cell that begins at (i, j).
float interpolate(const Mat& map, int i, int j, float u, float v)
{
    const float* m0 = map.ptr<float>(j) + i;
    const float* m1 = map.ptr<float>(j + 1) + i;
    return (1 - v) * ((1 - u) * m0[0] + u * m0[1]) + v * ((1 - u) * m1[0] + u * m1[1]);
}

//! Whether the corners of a pixel cell show different planes; there the distort map has a crease that isn't
//! interpolated well.
bool isCrease(const simulation::Simulator& simulator, int i, int j)
{
    const simulation::Surface first = simulator.surface(Point2d(i, j));
    return simulator.surface(Point2d(i + 1, j)) != first || simulator.surface(Point2d(i, j + 1)) != first ||
           simulator.surface(Point2d(i + 1, j + 1)) != first;
}

TEST_P(WarpLens, rectify_then_distort_is_identity)
{
    RNG rng(99);
    for (int round = 0; round < 10; round++)
    {
        RollingShutterCamera camera = lensCamera(GetParam());
        mountAtRandom(camera, rng);
        camera.scanDirection = rng.uniform(0, 4);
        const AckermannMotion motion = randomMotion(camera, rng);
        const simulation::Simulator simulator = simulation::Simulator::fromMotion(camera, motion);
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
        Mat toRaw[2], toGlobal[2], mask;
        generator->initRectifyMap(motion, toRaw[0], toRaw[1], CV_32FC1, mask);
        generator->initDistortMap(motion, toGlobal[0], toGlobal[1]);

        double worst = 0;
        int compared = 0, creases = 0;
        for (int y = 0; y < mask.rows; y++)
            for (int x = 0; x < mask.cols; x++)
            {
                const float u = toRaw[0].at<float>(y, x), v = toRaw[1].at<float>(y, x);
                const int i = cvFloor(u), j = cvFloor(v);
                if (i < 0 || j < 0 || i + 1 >= mask.cols || j + 1 >= mask.rows)
                    continue;
                const double error = std::max(std::abs(interpolate(toGlobal[0], i, j, u - i, v - j) - x),
                                              std::abs(interpolate(toGlobal[1], i, j, u - i, v - j) - y));
                compared++;
                if (error > 0.01 && isCrease(simulator, i, j))
                    creases++;
                else
                    worst = std::max(worst, error);
            }
        EXPECT_LE(worst, 0.01) << "round " << round;
        EXPECT_LE(creases, 2000) << "round " << round;
        EXPECT_GE(compared, 100000) << "round " << round;

        // Without interpolation there is no exception.
        Mat places, back, found;
        cv::merge(toRaw, 2, places);
        generator->correctPoints(motion, places.reshape(2, (int)places.total()), back, noArray(), found);
        double worstPoint = 0;
        for (int i = 0; i < back.rows; i++)
            if (mask.data[i])
            {
                ASSERT_EQ(255, found.at<uchar>(i));
                const Vec2f p = back.at<Vec2f>(i);
                worstPoint = std::max(worstPoint, std::max(std::abs((double)p[0] - i % mask.cols),
                                                           std::abs((double)p[1] - i / mask.cols)));
            }
        EXPECT_LE(worstPoint, 0.01) << "round " << round;
    }
}

TEST_P(WarpLens, no_motion_equals_OpenCV)
{
    const RollingShutterCamera camera = lensCamera(GetParam());
    const Matx33d newMatrices[] = {camera.cameraMatrix, Matx33d(700, 0, 330, 0, 690, 200, 0, 0, 1)};
    for (int i = 0; i < 2; i++)
    {
        WarpMapGenerator::Params params;
        params.newCameraMatrix = newMatrices[i];
        params.newSize = i ? Size(650, 391) : Size();
        const Size size = i ? params.newSize : camera.imageSize;
        AckermannMotion motion;
        for (int ok = 0; ok < 2; ok++)
        {
            // a moving camera that doesn't move takes the other way through the code
            motion.status = ok ? MOTION_OK : MOTION_NOT_SIGNIFICANT;
            Mat map1, map2, expected1, expected2;
            WarpMapGenerator::create(camera, params)->initRectifyMap(motion, map1, map2);
            if (GetParam() == FISHEYE_LENS)
                cv::fisheye::initUndistortRectifyMap(camera.cameraMatrix, camera.distCoeffs, noArray(), newMatrices[i],
                                                     size, CV_32FC1, expected1, expected2);
            else
                cv::initUndistortRectifyMap(camera.cameraMatrix, camera.distCoeffs, noArray(), newMatrices[i], size,
                                            CV_32FC1, expected1, expected2);
            EXPECT_LE(maxDifference(map1, expected1), 1e-3);
            EXPECT_LE(maxDifference(map2, expected2), 1e-3);
        }
    }
}

// Each coefficient alone, as what is skipped where others are 0 may be needed for it.
TEST_P(WarpLens, every_coefficient_alone_equals_OpenCV)
{
    const RollingShutterCamera whole = lensCamera(GetParam());
    for (size_t i = 0; i < whole.distCoeffs.size(); i++)
    {
        RollingShutterCamera camera = whole;
        camera.distCoeffs.assign(whole.distCoeffs.size(), 0.);
        camera.distCoeffs[i] = whole.distCoeffs[i];
        Mat map1, map2, expected1, expected2;
        WarpMapGenerator::create(camera)->initRectifyMap(AckermannMotion(), map1, map2);
        if (GetParam() == FISHEYE_LENS)
            cv::fisheye::initUndistortRectifyMap(camera.cameraMatrix, camera.distCoeffs, noArray(), camera.cameraMatrix,
                                                 camera.imageSize, CV_32FC1, expected1, expected2);
        else
            cv::initUndistortRectifyMap(camera.cameraMatrix, camera.distCoeffs, noArray(), camera.cameraMatrix,
                                        camera.imageSize, CV_32FC1, expected1, expected2);
        EXPECT_LE(maxDifference(map1, expected1), 1e-3) << i;
        EXPECT_LE(maxDifference(map2, expected2), 1e-3) << i;
    }
}

TEST_P(WarpLens, motion_without_status_OK_is_ignored)
{
    const RollingShutterCamera camera = lensCamera(GetParam());
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    AckermannMotion motion = exampleMotion(camera);
    Mat expected1, expected2, map1, map2;
    for (int distort = 0; distort < 2; distort++)
        for (int status = MOTION_NOT_SIGNIFICANT; status <= MOTION_NOT_OBSERVABLE; status++)
        {
            motion.status = status;
            if (distort)
            {
                generator->initDistortMap(AckermannMotion(), expected1, expected2);
                generator->initDistortMap(motion, map1, map2);
            }
            else
            {
                generator->initRectifyMap(AckermannMotion(), expected1, expected2);
                generator->initRectifyMap(motion, map1, map2);
            }
            EXPECT_EQ(0, maxDifference(expected1, map1));
            EXPECT_EQ(0, maxDifference(expected2, map2));
        }
}

TEST_P(WarpLens, absurd_motion_gives_no_NaN)
{
    RNG rng(5);
    const double magnitudes[] = {1, 10, 1e3, 1e9, 1e150};
    for (int round = 0; round < 60; round++)
    {
        RollingShutterCamera camera = lensCamera(GetParam());
        mountAtRandom(camera, rng);
        camera.scanDirection = rng.uniform(0, 4);
        camera.imageSize = Size(61, 37);
        const double magnitude = magnitudes[round % 5];
        AckermannMotion motion;
        motion.status = MOTION_OK;
        motion.alpha = rng.uniform(-1., 1.) * magnitude;
        motion.wallSlope = rng.uniform(-1., 1.) * magnitude;
        motion.wallOffset = rng.uniform(-1., 1.) * magnitude;
        motion.wallRatio = rng.uniform(-0.2, 2.);
        motion.roadSlope = rng.uniform(-1., 1.) * magnitude;
        motion.direction = rng.uniform(0, 2) ? 1 : -1;
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
        Mat map1, map2, mask, points(0, 2, CV_64F), moved;
        for (int i = 0; i < 50; i++)
        {
            const Point2d point = uniformPoint(rng, Point2d(-20, -20), Point2d(80, 60));
            points.push_back(Mat(Matx12d(point.x, point.y)));
        }
        for (int distort = 0; distort < 2; distort++)
        {
            if (distort)
            {
                generator->initDistortMap(motion, map1, map2, CV_32FC1, mask);
                generator->distortPoints(motion, points, moved);
            }
            else
            {
                generator->initRectifyMap(motion, map1, map2, CV_32FC1, mask);
                generator->correctPoints(motion, points, moved);
            }
            expectAddressable(map1);
            expectAddressable(map2);
            expectAddressable(moved);
            const Mat none = map1 == FAR_OUTSIDE;
            EXPECT_EQ(0, maxDifference(none, map2 == FAR_OUTSIDE));
            EXPECT_EQ(0, cv::countNonZero(mask & none));
        }
        EXPECT_EQ(generator->validRoi(motion), generator->validRoi(motion) & Rect(Point(), camera.imageSize));
        EXPECT_TRUE(cv::checkRange(Mat(generator->optimalNewCameraMatrix(motion, 0.5))));
    }
}

TEST_P(WarpLens, mask_tells_what_remap_shows)
{
    RNG rng(7);
    int hidden = 0;
    for (int round = 0; round < 4; round++)
    {
        RollingShutterCamera camera = lensCamera(GetParam());
        mountAtRandom(camera, rng);
        const AckermannMotion motion = randomMotion(camera, rng);
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
        for (int distort = 0; distort < 2; distort++)
        {
            Mat map1, map2, mask, shown;
            if (distort)
                generator->initDistortMap(motion, map1, map2, CV_32FC1, mask);
            else
                generator->initRectifyMap(motion, map1, map2, CV_32FC1, mask);
            ASSERT_EQ(CV_8UC1, mask.type());
            cv::remap(Mat(camera.imageSize, CV_8U, Scalar(200)), shown, map1, map2, INTER_LINEAR, BORDER_CONSTANT,
                      Scalar(0));
            // The mask is for places that are rounded to 1/32 pixel; OpenCV 5 blends the border in from the first bit.
            const int blended = CV_VERSION_MAJOR < 5 ? 0 : 2 * 200 / 64 + 1;
            EXPECT_EQ(0, cv::countNonZero((mask == 255) & (shown < 200 - blended)))
                << "round " << round << ", distort " << distort;
            EXPECT_EQ(0, cv::countNonZero((mask == 0) & (shown == 200)))
                << "round " << round << ", distort " << distort;
            EXPECT_EQ(mask.size().area(), cv::countNonZero((mask == 255) | (mask == 0)));
            // beyond the frame there is nothing, but for the pixel in which the border is blended
            EXPECT_EQ(0, cv::countNonZero(shown & (map1 <= -1))) << "round " << round << ", distort " << distort;
            hidden += cv::countNonZero(mask == 0);
        }
    }
    EXPECT_GT(hidden, 0);

    Mat map1, map2, mask;
    WarpMapGenerator::create(simulation::paperCamera())->initRectifyMap(AckermannMotion(), map1, map2, CV_32FC1, mask);
    EXPECT_EQ(mask.size().area(), cv::countNonZero(mask));
}

INSTANTIATE_TEST_CASE_P(RSAckermann, WarpLens, testing::Values(ALL_LENSES));

//////////////////////////////////////////////// where nothing is seen /////////////////////////////////////////////////

TEST(RSAckermann_Warp, walls_that_are_passed_show_nothing)
{
    // A wall across the road, which the camera reaches in the middle of the second half of its read-out.
    RollingShutterCamera camera = simulation::paperCamera();
    camera.referenceRow = 0;
    const double passedRow = 300;
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    for (int right = 0; right < 2; right++)
    {
        const AckermannMotion motion = motionThroughWall(camera, passedRow, right != 0);
        Mat map1, map2, mask;
        generator->initDistortMap(motion, map1, map2, CV_32FC1, mask);
        for (int y = 0; y < mask.rows; y++)
        {
            const int none = cv::countNonZero(map1.row(y) == FAR_OUTSIDE);
            EXPECT_EQ(y > passedRow ? mask.cols : 0, none) << "row " << y << ", right " << right;
        }
        EXPECT_EQ(mask.cols, cv::countNonZero(mask.row(0)));
        EXPECT_EQ(0, cv::countNonZero(mask.rowRange((int)passedRow + 1, mask.rows)));

        generator->initRectifyMap(motion, map1, map2, CV_32FC1, mask);
        double last;
        cv::minMaxLoc(map2, 0, &last);
        EXPECT_LE(last, passedRow) << "right " << right;

        // And so do points.
        const std::vector<Point2d> points = {Point2d(300, passedRow - 5), Point2d(300, passedRow + 5)};
        std::vector<Point2d> moved;
        std::vector<uchar> exists;
        generator->correctPoints(motion, points, moved, noArray(), exists);
        EXPECT_EQ(255, exists[0]) << "right " << right;
        EXPECT_EQ(0, exists[1]) << "right " << right;
    }
}

TEST(RSAckermann_Warp, rows_beyond_a_wall_beside_show_nothing)
{
    const double passedRow = 300;
    for (int right = 0; right < 2; right++)
    {
        RollingShutterCamera camera = simulation::paperCamera();
        const AckermannMotion motion = motionSideways(camera, passedRow, right != 0);
        Mat map1, map2, mask;
        WarpMapGenerator::create(camera)->initRectifyMap(motion, map1, map2, CV_32FC1, mask);
        double last;
        cv::minMaxLoc(map2, 0, &last, 0, 0, map2 != FAR_OUTSIDE);
        EXPECT_LE(last, passedRow + 0.01) << "right " << right;
        EXPECT_GE(last, passedRow - 10) << "right " << right;
    }
}

TEST(RSAckermann_Warp, nearest_plane_is_seen)
{
    // Where two planes meet their depths agree: the distort map is continuous there and follows the nearer one
    // elsewhere.
    const RollingShutterCamera camera = simulation::paperCamera();
    const AckermannMotion motion = exampleMotion(camera);
    AckermannMotion onlyLeft = motion;
    onlyLeft.wallRatio = onlyLeft.roadSlope = 0;
    AckermannMotion onlyRoad = motion;
    onlyRoad.wallSlope = onlyRoad.wallOffset = onlyRoad.wallRatio = 0;
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    Mat all[2], left[2], road[2];
    generator->initDistortMap(motion, all[0], all[1]);
    generator->initDistortMap(onlyLeft, left[0], left[1]);
    generator->initDistortMap(onlyRoad, road[0], road[1]);
    const Point onWall(5, 100), onRoad(320, 370);
    for (int k = 0; k < 2; k++)
    {
        EXPECT_EQ(all[k].at<float>(onWall), left[k].at<float>(onWall));
        EXPECT_EQ(all[k].at<float>(onRoad), road[k].at<float>(onRoad));
        EXPECT_NE(left[k].at<float>(onRoad), road[k].at<float>(onRoad));
    }
}

TEST(RSAckermann_Warp, lens_model_ends_where_it_turns_back)
{
    // r (1 - 0.5 r^2) grows up to r = sqrt(2 / 3); beyond it the polynomial would show the scene a second time.
    RollingShutterCamera camera = simulation::paperCamera();
    camera.cameraMatrix = Matx33d(200, 0, 319.5, 0, 200, 189.5, 0, 0, 1);
    camera.distCoeffs = std::vector<double>(4, 0.);
    camera.distCoeffs[0] = -0.5;
    Mat map1, map2, mask;
    WarpMapGenerator::create(camera)->initRectifyMap(AckermannMotion(), map1, map2, CV_32FC1, mask);
    const double limit = std::sqrt(2. / 3) * 200;
    for (int y = 0; y < mask.rows; y += 7)
        for (int x = 0; x < mask.cols; x += 7)
        {
            const double r = std::hypot(x - 319.5, y - 189.5);
            if (std::abs(r - limit) < 1)
                continue;
            EXPECT_EQ(r > limit, map1.at<float>(y, x) == FAR_OUTSIDE) << x << ", " << y;
            EXPECT_EQ(r < limit ? 255 : 0, mask.at<uchar>(y, x)) << x << ", " << y;
        }

    // Nor has a raw pixel beyond the largest distorted radius a ray.
    WarpMapGenerator::create(camera)->initDistortMap(AckermannMotion(), map1, map2, CV_32FC1, mask);
    const double rawLimit = limit * (1 - 1. / 3);
    for (int y = 0; y < mask.rows; y += 7)
        for (int x = 0; x < mask.cols; x += 7)
        {
            const double r = std::hypot(x - 319.5, y - 189.5);
            if (r > rawLimit + 1)
            {
                EXPECT_EQ(FAR_OUTSIDE, map1.at<float>(y, x)) << x << ", " << y;
            }
            else if (r < 0.9 * rawLimit)
            {
                EXPECT_EQ(255, mask.at<uchar>(y, x)) << x << ", " << y;
            }
        }
}

TEST(RSAckermann_Warp, pole_of_the_lens_model)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.distCoeffs = std::vector<double>(8, 0.);
    camera.distCoeffs[5] = -25; // 1 - 25 r^2 is 0 at r = 0.2
    Mat map1, map2, mask;
    AckermannMotion motion = exampleMotion(camera);
    for (int moving = 0; moving < 2; moving++)
    {
        motion.status = moving ? MOTION_OK : MOTION_NOT_SIGNIFICANT;
        WarpMapGenerator::create(camera)->initRectifyMap(motion, map1, map2, CV_32FC1, mask);
        expectAddressable(map1);
        expectAddressable(map2);
        EXPECT_EQ(FAR_OUTSIDE, map1.at<float>(0, 0));
        EXPECT_GT(cv::countNonZero(mask), 0);
    }
}

TEST(RSAckermann_Warp, new_camera)
{
    // A new camera of half the size shows every second pixel.
    const RollingShutterCamera camera = lensCamera(BROWN_8);
    const AckermannMotion motion = exampleMotion(camera);
    Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    Mat full[2], half[2], fullBack[2], halfBack[2];
    generator->initRectifyMap(motion, full[0], full[1]);
    generator->initDistortMap(motion, fullBack[0], fullBack[1]);
    WarpMapGenerator::Params params;
    const Matx33d& K = camera.cameraMatrix;
    params.newCameraMatrix = Matx33d(K(0, 0) / 2, 0, K(0, 2) / 2, 0, K(1, 1) / 2, K(1, 2) / 2, 0, 0, 1);
    params.newSize = Size(320, 190);
    generator->setParams(params);
    generator->initRectifyMap(motion, half[0], half[1]);
    generator->initDistortMap(motion, halfBack[0], halfBack[1]);
    ASSERT_EQ(params.newSize, half[0].size());
    ASSERT_EQ(camera.imageSize, halfBack[0].size());
    for (int k = 0; k < 2; k++)
    {
        for (int y = 0; y < 190; y += 13)
            for (int x = 0; x < 320; x += 13)
                EXPECT_NEAR(full[k].at<float>(2 * y, 2 * x), half[k].at<float>(y, x), 2e-3) << x << ", " << y;
        EXPECT_LE(maxDifference(fullBack[k], halfBack[k] * 2), 1e-3);
    }
}

/////////////////////////////////////////////// parameters and arguments ///////////////////////////////////////////////

TEST(RSAckermann_Warp, bad_arguments)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    EXPECT_THROW(WarpMapGenerator::create(RollingShutterCamera()), cv::Exception);
    EXPECT_THROW(generator->setCamera(RollingShutterCamera()), cv::Exception);
    EXPECT_EQ(camera.imageSize, generator->getCamera().imageSize);

    WarpMapGenerator::Params params;
    params.newCameraMatrix(0, 0) = 5;
    EXPECT_THROW(generator->setParams(params), cv::Exception);
    params = WarpMapGenerator::Params();
    params.newCameraMatrix = Matx33d(500, 0, NaN, 0, 500, 100, 0, 0, 1);
    EXPECT_THROW(generator->setParams(params), cv::Exception);
    params = WarpMapGenerator::Params();
    params.newSize = Size(100, 0);
    EXPECT_THROW(generator->setParams(params), cv::Exception);
    params = WarpMapGenerator::Params();
    params.maxIterations = 0;
    EXPECT_THROW(generator->setParams(params), cv::Exception);
    params = WarpMapGenerator::Params();
    params.tolerance = 0;
    EXPECT_THROW(generator->setParams(params), cv::Exception);
    params.tolerance = NaN;
    EXPECT_THROW(generator->setParams(params), cv::Exception);

    Mat map1, map2;
    AckermannMotion motion = exampleMotion(camera);
    double AckermannMotion::*const fields[] = {&AckermannMotion::alpha,           &AckermannMotion::wallSlope,
                                               &AckermannMotion::wallOffset,      &AckermannMotion::wallRatio,
                                               &AckermannMotion::roadSlope,       &AckermannMotion::rollCorrection,
                                               &AckermannMotion::pitchCorrection, &AckermannMotion::headingCorrection};
    for (size_t i = 0; i < sizeof(fields) / sizeof(fields[0]); i++)
    {
        AckermannMotion bad = motion;
        bad.*fields[i] = i % 2 ? NaN : std::numeric_limits<double>::infinity();
        EXPECT_THROW(generator->initRectifyMap(bad, map1, map2), cv::Exception) << i;
        EXPECT_THROW(generator->initDistortMap(bad, map1, map2), cv::Exception) << i;
    }
}

}} // namespace opencv_test::
