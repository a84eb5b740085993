// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_warp_cameras.hpp"

// Maps against the simulator, which finds raw pixels by bisection on the row and depths by casting rays.

namespace opencv_test { namespace {

using simulation::Simulator;

typedef testing::TestWithParam<std::tuple<int, int>> WarpReference; // TestLens, ScanDirection

//! The point in the scene that a pixel of the global-shutter camera shows; directions at infinity are a far point.
Vec3d pointAt(const Simulator& simulator, const Matx33d& newCameraMatrix, const Point2d& pixel)
{
    const Vec3d b = simulator.camera.uprightRotation * (newCameraMatrix.inv() * Vec3d(pixel.x, pixel.y, 1));
    const simulation::Surface plane = simulator.street.first(Vec3d(), b);
    return b * std::min(plane == simulation::NOTHING ? 1e9 : simulator.street.distance(plane, Vec3d(), b), 1e9);
}

TEST_P(WarpReference, rectify_map)
{
    RNG rng(4711);
    int compared = 0;
    for (int round = 0; round < 6; round++)
    {
        RollingShutterCamera camera = lensCamera(std::get<0>(GetParam()));
        mountAtRandom(camera, rng);
        camera.scanDirection = std::get<1>(GetParam());
        const AckermannMotion motion = randomMotion(camera, rng);
        WarpMapGenerator::Params params;
        if (round % 2)
        {
            params.newCameraMatrix = Matx33d(600, 3, 290, 0, 640, 210, 0, 0, 1);
            params.newSize = Size(601, 423);
        }
        const Matx33d K = round % 2 ? params.newCameraMatrix : camera.cameraMatrix;
        Mat columns, rows, mask;
        WarpMapGenerator::create(camera, params)->initRectifyMap(motion, columns, rows, CV_32FC1, mask);
        const Simulator simulator = Simulator::fromMotion(camera, motion);
        for (int i = 0; i < 60; i++)
        {
            const int row = rng.uniform(0, columns.rows), column = rng.uniform(0, columns.cols);
            const Point pixel(column, row);
            const Point2d got(columns.at<float>(pixel), rows.at<float>(pixel));
            Point2d truth;
            if (!simulator.project(pointAt(simulator, K, pixel), truth))
                continue;
            EXPECT_LE(cv::norm(got - truth), 2e-3) << "pixel " << pixel << ", round " << round;
            EXPECT_EQ(255, mask.at<uchar>(pixel)) << "pixel " << pixel << ", round " << round;
            compared++;
        }
    }
    EXPECT_GE(compared, 180);
}

TEST_P(WarpReference, distort_map)
{
    RNG rng(815);
    int seen[4] = {0};
    for (int round = 0; round < 12; round++)
    {
        RollingShutterCamera camera = lensCamera(std::get<0>(GetParam()));
        mountAtRandom(camera, rng);
        camera.scanDirection = std::get<1>(GetParam());
        const AckermannMotion motion = randomMotion(camera, rng);
        Mat columns, rows;
        WarpMapGenerator::create(camera)->initDistortMap(motion, columns, rows);
        const Simulator simulator = Simulator::fromMotion(camera, motion);
        const Matx33d& K = camera.cameraMatrix;
        for (int i = 0; i < 60; i++)
        {
            const int row = rng.uniform(0, columns.rows), column = rng.uniform(0, columns.cols);
            const Point pixel(column, row);
            const Point2d got(columns.at<float>(pixel), rows.at<float>(pixel));
            const simulation::Surface surface = simulator.surface(pixel);
            Vec3d P;
            simulator.locate(pixel, surface, P);
            P = camera.uprightRotation.t() * P;
            ASSERT_GT(P[2], 0);
            const Point2d truth(K(0, 0) * P[0] / P[2] + K(0, 2), K(1, 1) * P[1] / P[2] + K(1, 2));
            EXPECT_LE(cv::norm(got - truth), 1e-3)
                << "pixel " << pixel << ", surface " << surface << ", round " << round;
            seen[surface]++;
        }
    }
    for (int surface = simulation::LEFT; surface <= simulation::ROAD; surface++)
        EXPECT_GE(seen[surface], 15) << "surface " << surface;
}

// The corrections of roll, pitch and heading turn the camera further.
TEST_P(WarpReference, tilt_corrections)
{
    RollingShutterCamera camera = lensCamera(std::get<0>(GetParam()));
    camera.scanDirection = std::get<1>(GetParam());
    camera.setRollPitch(0.05, -0.03);
    RNG rng(3);
    AckermannMotion motion = randomMotion(camera, rng);
    motion.rollCorrection = 0.02;
    motion.pitchCorrection = 0.03;
    motion.headingCorrection = -0.3;
    RollingShutterCamera corrected = camera;
    corrected.uprightRotation = motion.uprightRotation(camera);
    corrected.heading = motion.heading(camera);
    Mat columns, rows;
    WarpMapGenerator::create(camera)->initRectifyMap(motion, columns, rows);
    const Simulator simulator = Simulator::fromMotion(corrected, motion);
    int compared = 0;
    for (int y = 3; y < columns.rows; y += 41)
        for (int x = 3; x < columns.cols; x += 41)
        {
            Point2d truth;
            if (!simulator.project(pointAt(simulator, camera.cameraMatrix, Point(x, y)), truth))
                continue;
            EXPECT_LE(cv::norm(Point2d(columns.at<float>(y, x), rows.at<float>(y, x)) - truth), 2e-3) << x << ", " << y;
            compared++;
        }
    EXPECT_GE(compared, 80);
}

INSTANTIATE_TEST_CASE_P(RSAckermann, WarpReference,
                        testing::Combine(testing::Values(ALL_LENSES),
                                         testing::Values(SCAN_TOP_TO_BOTTOM, SCAN_BOTTOM_TO_TOP, SCAN_LEFT_TO_RIGHT,
                                                         SCAN_RIGHT_TO_LEFT)));

}} // namespace opencv_test::
