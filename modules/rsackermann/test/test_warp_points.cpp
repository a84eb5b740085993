// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_warp_cameras.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

//! Random pixels of an image, CV_64F with two columns.
Mat randomPixels(const Size& size, int count, RNG& rng)
{
    Mat points(count, 2, CV_64F);
    for (int i = 0; i < count; i++)
    {
        points.at<double>(i, 0) = rng.uniform(0., size.width - 1.);
        points.at<double>(i, 1) = rng.uniform(0., size.height - 1.);
    }
    return points;
}

Point2d pointOf(const Mat& points, int i)
{
    return Point2d(points.at<double>(i, 0), points.at<double>(i, 1));
}

typedef testing::TestWithParam<int> WarpPoints; // TestLens

TEST_P(WarpPoints, round_trips)
{
    RNG rng(21);
    for (int round = 0; round < 20; round++)
    {
        RollingShutterCamera camera = lensCamera(GetParam());
        mountAtRandom(camera, rng);
        camera.scanDirection = rng.uniform(0, 4);
        const AckermannMotion motion = randomMotion(camera, rng);
        WarpMapGenerator::Params params;
        if (round % 2)
            params.newCameraMatrix = Matx33d(600, 3, 290, 0, 640, 210, 0, 0, 1);
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera, params);
        const Mat raw = randomPixels(camera.imageSize, 200, rng);
        Mat depths(200, 1, CV_64F);
        rng.fill(depths, RNG::UNIFORM, 3, 50);
        for (int withDepth = 0; withDepth < 2; withDepth++)
        {
            const Mat d = withDepth ? depths : Mat();
            Mat global, back, mask, backMask;
            generator->correctPoints(motion, raw, global, d, mask);
            generator->distortPoints(motion, global, back, d, backMask);
            EXPECT_EQ(200, cv::countNonZero(mask)) << "round " << round;
            EXPECT_EQ(200, cv::countNonZero(backMask)) << "round " << round;
            EXPECT_LE(cvtest::norm(raw, back, NORM_INF), 1e-6) << "round " << round << ", depth " << withDepth;

            Mat again;
            generator->correctPoints(motion, back, again, d);
            EXPECT_LE(cvtest::norm(global, again, NORM_INF), 1e-6) << "round " << round << ", depth " << withDepth;
        }
    }
}

// Points of a grid and the pixels of the maps there, for cameras that look down or up and motions up to the fastest.
TEST(RSAckermann_WarpPoints, have_places_where_pixels_of_maps_have)
{
    const int step = 5;
    const double pitches[] = {-40, -20, 0, 20, 30, 40}, rolls[] = {0, 30},
                 motions[][4] = {{20, 15, 2.5, 3}, {40, 0, 2.5, 0}, {-20, -30, 2.5, 3}, {60, 60, 1, 2}};
    for (double pitch : pitches)
        for (double roll : rolls)
            for (const double* m : motions)
            {
                RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(640, 380), 816);
                camera.lineDelay = 0.03 / 380;
                camera.height = 1.2;
                camera.setRollPitch(roll * CV_PI / 180, pitch * CV_PI / 180);
                MetricMotion metric;
                metric.speed = m[0];
                metric.yawRate = m[1] * CV_PI / 180;
                metric.leftDistance = m[2];
                metric.rightDistance = m[3];
                const AckermannMotion motion = AckermannMotion::fromMetric(camera, metric);
                const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
                std::vector<Point2d> pixels;
                for (int y = 0; y < camera.imageSize.height; y += step)
                    for (int x = 0; x < camera.imageSize.width; x += step)
                        pixels.push_back(Point2d(x, y));
                for (int direction = 0; direction < 2; direction++)
                {
                    Mat map1, map2, places, mask;
                    if (direction == 0)
                    {
                        generator->initRectifyMap(motion, map1, map2, CV_32FC1);
                        generator->distortPoints(motion, pixels, places, noArray(), mask);
                    }
                    else
                    {
                        generator->initDistortMap(motion, map1, map2, CV_32FC1);
                        generator->correctPoints(motion, pixels, places, noArray(), mask);
                    }
                    int onlyPoints = 0, onlyPixels = 0;
                    for (size_t i = 0; i < pixels.size(); i++)
                    {
                        const bool hasPixel = map1.at<float>(Point(pixels[i])) != -16384,
                                   hasPoint = mask.at<uchar>(int(i)) != 0;
                        onlyPoints += hasPoint && !hasPixel;
                        onlyPixels += hasPixel && !hasPoint;
                    }
                    const std::string name = cv::format("pitch %g, roll %g, speed %g", pitch, roll, m[0]);
                    EXPECT_EQ(0, onlyPoints) << name << ", direction " << direction;
                    EXPECT_EQ(0, onlyPixels) << name << ", direction " << direction;
                }
            }
}

// Without a motion a depth means nothing, whatever values the motion has.
TEST(RSAckermann_WarpPoints, depths_without_a_motion)
{
    RNG rng(22);
    RollingShutterCamera camera = lensCamera(0);
    mountAtRandom(camera, rng);
    AckermannMotion motion = randomMotion(camera, rng);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const Mat pixels = randomPixels(camera.imageSize, 50, rng), depths(50, 1, CV_64F, Scalar(6));
    for (const int status : {MOTION_OK, MOTION_NOT_SIGNIFICANT, MOTION_NOT_OBSERVABLE})
    {
        motion.status = status;
        if (status != MOTION_OK) // no metres
            motion.wallDistance = camera.height = 0;
        generator->setCamera(camera);
        Mat with, without;
        generator->correctPoints(motion, pixels, with, depths);
        generator->correctPoints(motion, pixels, without);
        EXPECT_EQ(status == MOTION_OK, cvtest::norm(with, without, NORM_INF) > 1e-6) << status;
        generator->distortPoints(motion, pixels, with, depths);
        generator->distortPoints(motion, pixels, without);
        EXPECT_EQ(status == MOTION_OK, cvtest::norm(with, without, NORM_INF) > 1e-6) << status;
    }
}

// In each direction of the shutter, with rows that tilt in each way, and with another camera matrix.
TEST_P(WarpPoints, agree_with_the_simulator)
{
    RNG rng(22);
    for (int scan = SCAN_TOP_TO_BOTTOM; scan <= SCAN_RIGHT_TO_LEFT; scan++)
        for (const int tilt : {0, 1, 2}) // none, rates, a curve
            for (const bool isOtherMatrix : {false, true})
            {
                SCOPED_TRACE(testing::Message() << scan << " " << tilt << " " << isOtherMatrix);
                RollingShutterCamera camera = lensCamera(GetParam());
                mountAtRandom(camera, rng);
                camera.scanDirection = scan;
                AckermannMotion motion = motionFromMetric(camera, rng.uniform(-1., 1.), rng.uniform(-30., 30.), 2.5, 3,
                                                          camera.heading + rng.uniform(-0.05, 0.05));
                const double most = 30 * CV_PI / 180 * camera.secondsPerUnitTime();
                motion.pitchRate = tilt > 0 ? rng.uniform(-most, most) : 0;
                motion.rollRate = tilt > 0 ? rng.uniform(-most, most) : 0;
                if (tilt > 1)
                    addRotationCurve(motion, 7, rng);
                WarpMapGenerator::Params params;
                if (isOtherMatrix)
                    params.newCameraMatrix = Matx33d(600, 0, 290, 0, 640, 210, 0, 0, 1);
                const Matx33d matrix = isOtherMatrix ? params.newCameraMatrix : camera.cameraMatrix;
                const Simulator simulator = Simulator::fromMotion(camera, motion);
                const Mat raw = randomPixels(camera.imageSize, 30, rng);
                Mat global;
                WarpMapGenerator::create(camera, params)->correctPoints(motion, raw, global);
                for (int i = 0; i < raw.rows; i++)
                {
                    Vec3d P;
                    simulator.locate(pointOf(raw, i), simulator.surface(pointOf(raw, i)), P);
                    P = matrix * (camera.uprightRotation.t() * P);
                    EXPECT_LE(cv::norm(pointOf(global, i) - Point2d(P[0] / P[2], P[1] / P[2])), 1e-6) << i;
                }
            }
}

// Points anywhere in space, in metres.
TEST_P(WarpPoints, depths)
{
    RNG rng(23);
    for (int round = 0; round < 10; round++)
    {
        RollingShutterCamera camera = lensCamera(GetParam());
        mountAtRandom(camera, rng);
        const double yawRate = rng.uniform(-1., 1.), speed = rng.uniform(-30., 30.);
        AckermannMotion motion = motionFromMetric(camera, yawRate, speed, 2.5, 3, camera.heading);
        if (round % 2) // the speed from the road
            motion.wallDistance = 0;
        const Simulator simulator = Simulator::fromMetric(camera, yawRate, speed, 2.5, 3, camera.heading);
        const Matx33d& K = camera.cameraMatrix;

        Mat raw(0, 2, CV_64F), global(0, 2, CV_64F), depths(0, 1, CV_64F);
        while (raw.rows < 50)
        {
            const double depth = rng.uniform(1., 30.);
            const Point2d pixel = uniformPoint(rng, Point2d(0, 0), Point2d(640, 380));
            const Vec3d P = camera.uprightRotation * (K.inv() * Vec3d(pixel.x, pixel.y, 1)) * depth;
            Point2d seen;
            if (!simulator.project(P, seen))
                continue;
            raw.push_back(Mat(Matx12d(seen.x, seen.y)));
            global.push_back(Mat(Matx12d(pixel.x, pixel.y)));
            depths.push_back(depth);
        }
        WarpMapGenerator::Params params;
        if (round % 3 == 0)
            params.newCameraMatrix = Matx33d(600, 3, 290, 0, 640, 210, 0, 0, 1);
        for (int i = 0; i < global.rows && round % 3 == 0; i++)
        {
            const Vec3d p =
                params.newCameraMatrix * (K.inv() * Vec3d(global.at<double>(i, 0), global.at<double>(i, 1), 1));
            global.at<double>(i, 0) = p[0];
            global.at<double>(i, 1) = p[1];
        }
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera, params);
        Mat gotRaw, gotGlobal;
        generator->distortPoints(motion, global, gotRaw, depths);
        generator->correctPoints(motion, raw, gotGlobal, depths);
        EXPECT_LE(cvtest::norm(raw, gotRaw, NORM_INF), 1e-6) << "round " << round;
        EXPECT_LE(cvtest::norm(global, gotGlobal, NORM_INF), 1e-6) << "round " << round;
    }
}

TEST_P(WarpPoints, agree_with_the_maps)
{
    RNG rng(24);
    const RollingShutterCamera camera = lensCamera(GetParam());
    const AckermannMotion motion = randomMotion(camera, rng);
    WarpMapGenerator::Params params;
    params.newCameraMatrix = Matx33d(800, 0, 290, 0, 840, 210, 0, 0, 1);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera, params);
    Mat map, unused, pixels(0, 2, CV_64F), moved;
    for (int y = 0; y < 380; y += 19)
        for (int x = 0; x < 640; x += 20)
            pixels.push_back(Mat(Matx12d(x, y)));
    for (int distort = 0; distort < 2; distort++)
    {
        if (distort)
        {
            generator->initDistortMap(motion, map, unused, CV_32FC2);
            generator->correctPoints(motion, pixels, moved);
        }
        else
        {
            generator->initRectifyMap(motion, map, unused, CV_32FC2);
            generator->distortPoints(motion, pixels, moved);
        }
        for (int i = 0; i < pixels.rows; i++)
        {
            const Vec2f p = map.at<Vec2f>(cvRound(pixels.at<double>(i, 1)), cvRound(pixels.at<double>(i, 0)));
            EXPECT_LE(cv::norm(pointOf(moved, i) - Point2d(p[0], p[1])), 2e-3) << i;
        }
    }
}

TEST_P(WarpPoints, no_motion_equals_OpenCV)
{
    RNG rng(25);
    const RollingShutterCamera camera = lensCamera(GetParam());
    if (camera.distCoeffs.empty())
        return;
    const Mat raw = randomPixels(camera.imageSize, 100, rng);
    std::vector<Point2d> points = raw.reshape(2), expected;
    if (GetParam() == FISHEYE_LENS)
        cv::fisheye::undistortPoints(points, expected, camera.cameraMatrix, camera.distCoeffs, noArray(),
                                     camera.cameraMatrix);
    else
        cv::undistortPoints(points, expected, camera.cameraMatrix, camera.distCoeffs, noArray(), camera.cameraMatrix,
                            TermCriteria(TermCriteria::COUNT + TermCriteria::EPS, 100, 1e-12));
    Mat got;
    WarpMapGenerator::create(camera)->correctPoints(AckermannMotion(), raw, got);
    EXPECT_LE(cvtest::norm(got.reshape(2), Mat(expected), NORM_INF), 1e-6);
}

INSTANTIATE_TEST_CASE_P(RSAckermann, WarpPoints, testing::Values(ALL_LENSES));

// Rays are found up to the border of strongly distorted images.
TEST(RSAckermann_WarpPoints, strong_lenses)
{
    RollingShutterCamera barrel = simulation::paperCamera(), pincushion = barrel, fisheye = barrel;
    barrel.cameraMatrix = Matx33d(330, 0, 320, 0, 330, 190, 0, 0, 1);
    barrel.distCoeffs = {-0.36, 0.16, 1e-3, -1e-3};
    pincushion.cameraMatrix = Matx33d(500, 0, 320, 0, 500, 190, 0, 0, 1);
    pincushion.distCoeffs = {0.8, 0.3, -2e-3, 2e-3};
    fisheye.cameraMatrix = Matx33d(265, 0, 320, 0, 265, 190, 0, 0, 1); // 85 degrees in the corners
    fisheye.lensModel = LENS_FISHEYE;
    fisheye.distCoeffs = {-0.02, 0.01, -0.01, 0.002};
    const RollingShutterCamera cameras[] = {barrel, pincushion, fisheye};
    for (int i = 0; i < 3; i++)
    {
        const RollingShutterCamera& camera = cameras[i];
        const Matx33d& K = camera.cameraMatrix;
        Mat raw(0, 2, CV_64F), global, mask;
        for (int y = 0; y <= 379; y += 379 / 6)
            for (int x = 0; x <= 639; x += 639 / 9)
                raw.push_back(Mat(Matx12d(x, y)));
        WarpMapGenerator::create(camera)->correctPoints(AckermannMotion(), raw, global, noArray(), mask);
        EXPECT_EQ(raw.rows, cv::countNonZero(mask)) << "camera " << i;
        std::vector<Point3d> rays;
        for (int j = 0; j < raw.rows; j++)
            rays.push_back(
                Point3d((pointOf(global, j).x - K(0, 2)) / K(0, 0), (pointOf(global, j).y - K(1, 2)) / K(1, 1), 1));
        std::vector<Point2d> back;
        const Mat zero = Mat::zeros(3, 1, CV_64F);
        if (i == 2)
            cv::fisheye::projectPoints(rays, back, zero, zero, K, camera.distCoeffs);
        else
            cv::projectPoints(rays, zero, zero, K, camera.distCoeffs, back);
        EXPECT_LE(cvtest::norm(Mat(back).reshape(1), raw, NORM_INF), 1e-7) << "camera " << i;
    }
}

AckermannMotion exampleMotion(const RollingShutterCamera& camera)
{
    return motionFromMetric(camera, 0.6, 15, 2.5, 3, 0);
}

TEST(RSAckermann_WarpPoints, shapes_and_types)
{
    RNG rng(26);
    const RollingShutterCamera camera = lensCamera(BROWN_5);
    const AckermannMotion motion = exampleMotion(camera);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const Mat points = randomPixels(camera.imageSize, 30, rng);
    Mat expected, points32, got;
    generator->correctPoints(motion, points, expected);
    ASSERT_EQ(points.size(), expected.size());
    ASSERT_EQ(CV_64F, expected.type());

    generator->correctPoints(motion, points.reshape(2), got);
    ASSERT_EQ(CV_64FC2, got.type());
    ASSERT_EQ(Size(1, 30), got.size());
    EXPECT_EQ(0, cvtest::norm(expected, got.reshape(1), NORM_INF));

    generator->correctPoints(motion, points.reshape(2, 1), got);
    ASSERT_EQ(Size(30, 1), got.size());
    EXPECT_EQ(0, cvtest::norm(expected, got.reshape(1, 30), NORM_INF));

    points.convertTo(points32, CV_32F);
    generator->correctPoints(motion, points32, got);
    ASSERT_EQ(CV_32F, got.type());
    EXPECT_LE(cvtest::norm(expected, Mat(Mat_<double>(got)), NORM_INF), 2e-4);

    const std::vector<Point2f> pointVector = points32.reshape(2);
    std::vector<Point2f> gotVector;
    generator->correctPoints(motion, pointVector, gotVector);
    ASSERT_EQ(30u, gotVector.size());
    EXPECT_EQ(0, cvtest::norm(Mat(gotVector).reshape(1), got, NORM_INF));

    Mat wide(30, 5, CV_64F, Scalar(0)), part = wide.colRange(1, 3);
    points.copyTo(part);
    generator->correctPoints(motion, part, got);
    EXPECT_EQ(0, cvtest::norm(expected, got, NORM_INF));

    Mat inPlace = points.clone();
    generator->correctPoints(motion, inPlace, inPlace);
    EXPECT_EQ(0, cvtest::norm(expected, inPlace, NORM_INF));

    // depths of either type and direction
    Mat depths(30, 1, CV_64F, Scalar(7)), withDepths;
    generator->correctPoints(motion, points, withDepths, depths);
    EXPECT_GT(cvtest::norm(expected, withDepths, NORM_INF), 0.01);
    generator->correctPoints(motion, points, got, std::vector<float>(30, 7.f));
    EXPECT_EQ(0, cvtest::norm(withDepths, got, NORM_INF));

    Mat mask;
    generator->correctPoints(motion, Mat(), got, noArray(), mask);
    EXPECT_TRUE(got.empty());
    EXPECT_TRUE(mask.empty());
    generator->correctPoints(motion, std::vector<Point2f>(), gotVector);
    EXPECT_TRUE(gotVector.empty());
}

TEST(RSAckermann_WarpPoints, unknown_depths)
{
    RNG rng(27);
    const RollingShutterCamera camera = lensCamera(BROWN_5);
    const AckermannMotion motion = exampleMotion(camera);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const Mat points = randomPixels(camera.imageSize, 4, rng);
    const std::vector<double> depths = {NaN, 0, -3, std::numeric_limits<double>::infinity()};
    Mat expected, got, far, mask;
    generator->correctPoints(motion, points, expected);
    generator->correctPoints(motion, points, got, depths, mask);
    EXPECT_EQ(0, cvtest::norm(expected.rowRange(0, 3), got.rowRange(0, 3), NORM_INF));
    EXPECT_EQ(4, cv::countNonZero(mask));

    // at infinity only the rotation counts
    AckermannMotion rotation = motion;
    rotation.wallSlope = rotation.wallOffset = rotation.wallRatio = rotation.roadSlope = 0;
    generator->correctPoints(rotation, points, far);
    EXPECT_LE(cvtest::norm(far.row(3), got.row(3), NORM_INF), 1e-9);

    // and then no speed is asked for
    rotation.wallDistance = 0;
    EXPECT_NO_THROW(generator->correctPoints(rotation, points, got, std::vector<double>(4, 5.)));
    EXPECT_LE(cvtest::norm(far, got, NORM_INF), 1e-9);
}

TEST(RSAckermann_WarpPoints, points_without_a_place)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const AckermannMotion motion = exampleMotion(camera);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const std::vector<Point2d> points = {Point2d(NaN, 100), Point2d(100, NaN), Point2d(infinity, 3),
                                         Point2d(1e300, -1e300), Point2d(100, 100)};
    for (int distort = 0; distort < 2; distort++)
    {
        std::vector<Point2d> got;
        Mat mask;
        if (distort)
            generator->distortPoints(motion, points, got, noArray(), mask);
        else
            generator->correctPoints(motion, points, got, noArray(), mask);
        ASSERT_EQ(Size(1, 5), mask.size());
        for (int i = 0; i < 5; i++)
        {
            EXPECT_EQ(i < 4 ? 0 : 255, mask.at<uchar>(i)) << i;
            EXPECT_EQ(i < 4, got[i] == Point2d(-16384, -16384)) << i << got[i];
        }
    }
}

// Where cv::remap finds nothing there is no place, and just before it there is one. Of points and of maps the same is
// said.
TEST(RSAckermann_WarpPoints, places_at_the_limit_of_maps)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const std::vector<Point2d> points = {Point2d(32766, 100),  Point2d(32768, 100),  Point2d(100, 32766),
                                         Point2d(100, 32768),  Point2d(-32766, 100), Point2d(-32768, 100),
                                         Point2d(100, -32766), Point2d(100, -32768)};
    for (int distort = 0; distort < 2; distort++)
    {
        std::vector<Point2d> got;
        Mat mask;
        if (distort)
            generator->distortPoints(AckermannMotion(), points, got, noArray(), mask);
        else
            generator->correctPoints(AckermannMotion(), points, got, noArray(), mask);
        for (int i = 0; i < 8; i++)
        {
            const bool exists = i % 2 == 0;
            EXPECT_EQ(exists ? 255 : 0, mask.at<uchar>(i)) << points[i];
            EXPECT_LE(cv::norm(got[i] - (exists ? points[i] : Point2d(-16384, -16384))), 1e-6) << points[i];
        }
    }

    // The pixel in the middle of the global-shutter image is seen at 32766, the one below it at 32768 and so on.
    WarpMapGenerator::Params params;
    const Matx33d& K = camera.cameraMatrix;
    const double step = 2, middle = 190;
    params.newCameraMatrix =
        Matx33d(K(0, 0), 0, K(0, 2), 0, K(1, 1) / step, middle - (32766 - K(1, 2)) / step, 0, 0, 1);
    const Ptr<WarpMapGenerator> far = WarpMapGenerator::create(camera, params);
    Mat map1, map2;
    far->initRectifyMap(AckermannMotion(), map1, map2);
    for (int y = 185; y <= 195; y++)
    {
        const Mat pixel(Matx12d(100, y));
        Mat raw;
        far->distortPoints(AckermannMotion(), pixel, raw);
        const double expected = y <= middle ? 32766 + step * (y - middle) : -16384;
        EXPECT_NEAR(expected, raw.at<double>(0, 1), 1e-6) << y;
        EXPECT_NEAR(expected, map2.at<float>(y, 100), 1e-2) << y;
    }
}

// The pose of the row that sees a point explains where it is seen: what visual odometry asks for.
TEST(RSAckermann_WarpPoints, poses_of_rows)
{
    RNG rng(28);
    for (int round = 0; round < 20; round++)
    {
        RollingShutterCamera camera = lensCamera(BROWN_5);
        mountAtRandom(camera, rng);
        const double speed = rng.uniform(-30., 30.), metresPerUnit = std::abs(speed) * camera.secondsPerUnitTime();
        AckermannMotion motion = motionFromMetric(camera, rng.uniform(-1., 1.), speed, 2.5, 3, camera.heading);
        motion.pitchRate = rng.uniform(-0.02, 0.02);
        motion.rollRate = rng.uniform(-0.02, 0.02);
        if (round % 2)
            addRotationCurve(motion, 2 + round, rng);
        const Mat pixels = randomPixels(camera.imageSize, 20, rng);
        Mat depths(20, 1, CV_64F), raw, mask;
        rng.fill(depths, RNG::UNIFORM, 2, 30);
        WarpMapGenerator::create(camera)->distortPoints(motion, pixels, raw, depths, mask);
        for (int i = 0; i < 20; i++)
        {
            ASSERT_EQ(255, mask.at<uchar>(i));
            Matx33d R;
            Vec3d T;
            motion.pose(camera, camera.rowTime(pointOf(raw, i)), R, T);
            const Point2d pixel = pointOf(pixels, i);
            const Vec3d P = camera.cameraMatrix.inv() * Vec3d(pixel.x, pixel.y, 1) * depths.at<double>(i);
            const Vec3d seen = R.t() * (P - T * metresPerUnit);
            std::vector<Point2d> expected;
            const Mat zero = Mat::zeros(3, 1, CV_64F);
            cv::projectPoints(std::vector<Point3d>(1, Point3d(seen)), zero, zero, camera.cameraMatrix,
                              camera.distCoeffs, expected);
            EXPECT_LE(cv::norm(expected[0] - pointOf(raw, i)), 1e-6) << "round " << round << ", point " << i;
        }
    }
}

// A point nearer than the way that the camera moves up to its row is behind it then.
TEST(RSAckermann_WarpPoints, points_that_the_camera_passes)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.referenceRow = 0;
    const AckermannMotion motion = exampleMotion(camera);
    const double way = 15 * 380 * camera.lineDelay;
    const std::vector<Point2d> raw = {Point2d(320, 370), Point2d(320, 370)};
    const std::vector<double> depths = {0.5 * way, 2 * way};
    std::vector<Point2d> got;
    Mat mask;
    WarpMapGenerator::create(camera)->correctPoints(motion, raw, got, depths, mask);
    EXPECT_EQ(0, mask.at<uchar>(0));
    EXPECT_EQ(255, mask.at<uchar>(1));
}

TEST(RSAckermann_WarpPoints, bad_arguments)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    AckermannMotion motion = exampleMotion(camera);
    const Mat points(5, 2, CV_64F, Scalar(100));
    Mat got;
    EXPECT_THROW(generator->correctPoints(motion, Mat(5, 3, CV_64F, Scalar(1)), got), cv::Exception);
    EXPECT_THROW(generator->correctPoints(motion, Mat(5, 2, CV_32S, Scalar(1)), got), cv::Exception);
    EXPECT_THROW(generator->correctPoints(motion, points, got, Mat(4, 1, CV_64F, Scalar(1))), cv::Exception);
    EXPECT_THROW(generator->correctPoints(motion, points, got, Mat(5, 1, CV_32S, Scalar(1))), cv::Exception);
    motion.wallDistance = 0;
    motion.roadSlope = 0;
    EXPECT_THROW(generator->distortPoints(motion, points, got, Mat(5, 1, CV_64F, Scalar(1))), cv::Exception);
    motion.alpha = NaN;
    EXPECT_THROW(generator->distortPoints(motion, points, got), cv::Exception);
    motion.alpha = 0;
    motion.wallRatio = -3.5e306;
    EXPECT_THROW(generator->correctPoints(motion, points, got), cv::Exception);
}

}} // namespace opencv_test::
