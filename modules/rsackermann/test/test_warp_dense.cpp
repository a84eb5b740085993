// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_warp_cameras.hpp"

// Maps are interpolated between few places. Here all their pixels are compared with points, which are solved one by one
// in double precision to 1e-9 pixel (test_warp_points.cpp compares those with the simulator).

namespace opencv_test { namespace {

typedef testing::TestWithParam<std::tuple<int, bool>> WarpDense; // TestLens, whether to distort

//! Motions up to the largest of a car, at any distance of walls and road at which the image is slower than the shutter;
//! if it is faster a point may be seen several times or never.
AckermannMotion anyMotion(const RollingShutterCamera& camera, RNG& rng)
{
    for (;;)
    {
        const double sign = rng.uniform(0, 4) == 0 ? -1 : 1, wallDirection = camera.heading + rng.uniform(-0.3, 0.3),
                     right = rng.uniform(1., 10.), left = rng.uniform(1., 10.),
                     speed = sign * rng.uniform(0., 200.) / 3.6, yawRate = rng.uniform(-90., 90.) * CV_PI / 180;
        const AckermannMotion motion = motionFromMetric(camera, yawRate, speed, left, right, wallDirection);
        if (std::max(0.5 * std::abs(motion.roadSlope),
                     std::hypot(motion.wallSlope, motion.wallOffset) * std::max(1., motion.wallRatio)) < 0.7)
            return motion;
    }
}

TEST_P(WarpDense, equals_points)
{
    const bool distort = std::get<1>(GetParam());
    RNG rng(77);
    double worst = 0;
    int compared = 0;
    for (int round = 0; round < 16; round++)
    {
        RollingShutterCamera camera = lensCamera(std::get<0>(GetParam()));
        mountAtRandom(camera, rng);
        camera.scanDirection = rng.uniform(0, 4);
        camera.height = rng.uniform(0.5, 3.);
        camera.lineDelay = rng.uniform(10e-6, 90e-6);
        AckermannMotion motion = anyMotion(camera, rng);
        RNG ofCurve(90 + round);
        if (round % 4 > 1) // some with more knots than a square can have
        {
            addRotationCurve(motion, round % 8 > 5 ? 200 : ofCurve.uniform(2, 18), ofCurve);
            motion.rotationCurve *= 0.5; // bent four times as much as by an engine
        }
        WarpMapGenerator::Params params;
        if (round % 2)
        {
            const double zoom = rng.uniform(0.3, 1.5);
            params.newCameraMatrix = Matx33d(zoom * 800, 2, 320, 0, zoom * 780, 180, 0, 0, 1);
        }
        const Size size = camera.imageSize;
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera, params);
        Mat map, unused, points, mask;
        if (distort)
            generator->initDistortMap(motion, map, unused, CV_32FC2);
        else
            generator->initRectifyMap(motion, map, unused, CV_32FC2);

        Mat pixels(0, 2, CV_64F);
        for (int y = round % 3; y < map.rows; y += 3)
            for (int x = round % 2; x < map.cols; x += 2)
                pixels.push_back(Mat(Matx12d(x, y)));
        if (distort)
            generator->correctPoints(motion, pixels, points, noArray(), mask);
        else
            generator->distortPoints(motion, pixels, points, noArray(), mask);
        for (int i = 0; i < pixels.rows; i++)
        {
            const Vec2f place = map.at<Vec2f>((int)pixels.at<double>(i, 1), (int)pixels.at<double>(i, 0));
            const Point2d point(points.at<double>(i, 0), points.at<double>(i, 1));
            if (!mask.at<uchar>(i) || !Rect_<double>(0, 0, size.width, size.height).contains(point))
                continue;
            const double error = std::max(std::abs(place[0] - point.x), std::abs(place[1] - point.y));
            if (!(error <= worst))
                worst = error;
            compared++;
        }
    }
    EXPECT_LE(worst, 5e-4);
    EXPECT_GE(compared, 200000);
}

INSTANTIATE_TEST_CASE_P(RSAckermann, WarpDense, testing::Combine(testing::Values(ALL_LENSES), testing::Bool()));

}} // namespace opencv_test::
