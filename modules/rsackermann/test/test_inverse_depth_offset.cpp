// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_inverse_depth_offset.hpp"
#include "test_warp_cameras.hpp"

// Scenes that deviate from their planes: how maps and points follow them, against the simulator.

namespace opencv_test { namespace {

using simulation::Simulator;

//! An offset of about a part of the inverse depth of the walls.
void addOffset(AckermannMotion& motion, double part, RNG& rng)
{
    const Size controls(rng.uniform(4, 14), rng.uniform(4, 9));
    motion.offsetArea = Rect2d(-0.5, -0.3, 1.1, 0.55);
    motion.inverseDepthOffset.create(controls, CV_64F);
    rng.fill(motion.inverseDepthOffset, RNG::NORMAL, 0, part * std::hypot(motion.wallSlope, motion.wallOffset));
}

//! The point that a pixel of the global-shutter camera shows; false if it would be behind or beyond infinity.
bool pointAt(const Simulator& simulator, const AckermannMotion& motion, const Point2d& pixel, Vec3d& P)
{
    const Vec3d b = bearingOf(simulator.camera, motion, pixel);
    if (!(b[2] > 0.05))
        return false;
    const simulation::Surface plane = simulator.street.first(Vec3d(), b);
    const double planes = plane == simulation::NOTHING ? 0 : 1 / simulator.street.distance(plane, Vec3d(), b),
                 nearness = planes + motion.direction * b[2] * offsetAt(motion, b[0] / b[2], b[1] / b[2]);
    P = b * (1 / nearness);
    return nearness > 1e-6;
}

typedef testing::TestWithParam<std::tuple<int, int>> OffsetWarp; // TestLens, ScanDirection

RollingShutterCamera randomCamera(const OffsetWarp::ParamType& param, RNG& rng)
{
    RollingShutterCamera camera = lensCamera(std::get<0>(param));
    mountAtRandom(camera, rng);
    camera.scanDirection = std::get<1>(param);
    return camera;
}

TEST_P(OffsetWarp, rectify_map_is_that_of_the_simulator)
{
    RNG rng(31);
    int compared = 0;
    double moved = 0;
    for (int round = 0; round < 6; round++)
    {
        const RollingShutterCamera camera = randomCamera(GetParam(), rng);
        AckermannMotion motion = randomMotion(camera, rng);
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
        Mat columns, rows, planeColumns, planeRows;
        generator->initRectifyMap(motion, planeColumns, planeRows);
        addOffset(motion, 0.15, rng);
        generator->initRectifyMap(motion, columns, rows);
        const Simulator simulator = Simulator::fromMotion(camera, motion);
        for (int i = 0; i < 60; i++)
        {
            const Point pixel = uniformPoint(rng, Point2d(0, 0), Point2d(columns.cols - 1, columns.rows - 1));
            Vec3d P;
            Point2d truth;
            if (!pointAt(simulator, motion, pixel, P) || !simulator.project(P, truth))
                continue;
            EXPECT_LE(cv::norm(Point2d(columns.at<float>(pixel), rows.at<float>(pixel)) - truth), 2e-3)
                << "pixel " << pixel << ", round " << round;
            moved = std::max(moved, std::abs(double(columns.at<float>(pixel)) - planeColumns.at<float>(pixel)));
            compared++;
        }
    }
    EXPECT_GE(compared, 150);
    EXPECT_GE(moved, 0.5);
}

TEST_P(OffsetWarp, points_and_distort_map_are_the_inverse)
{
    RNG rng(32);
    int seen = 0, inverse = 0;
    for (int round = 0; round < 4; round++)
    {
        const RollingShutterCamera camera = randomCamera(GetParam(), rng);
        AckermannMotion motion = randomMotion(camera, rng);
        addOffset(motion, 0.15, rng);
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
        const Simulator simulator = Simulator::fromMotion(camera, motion);
        std::vector<Point2d> pixels, truths, raw, back, atRaw;
        for (int i = 0; i < 60; i++)
        {
            const Point2d pixel =
                uniformPoint(rng, Point2d(0, 0), Point2d(camera.imageSize.width, camera.imageSize.height));
            Vec3d P;
            Point2d truth;
            if (!pointAt(simulator, motion, pixel, P) || !simulator.project(P, truth))
                continue;
            pixels.push_back(pixel);
            truths.push_back(truth);
        }
        if (pixels.empty())
            continue;
        std::vector<uchar> exists;
        generator->distortPoints(motion, pixels, raw, noArray(), exists);
        generator->correctPoints(motion, truths, back);
        Mat columns, rows;
        generator->initDistortMap(motion, columns, rows);
        std::vector<Point2d> whole;
        for (size_t i = 0; i < truths.size(); i++)
            whole.push_back(Point(truths[i]));
        generator->correctPoints(motion, whole, atRaw);
        for (size_t i = 0; i < pixels.size(); i++)
        {
            if (!exists[i])
                continue;
            EXPECT_LE(cv::norm(raw[i] - truths[i]), 1e-4) << "round " << round;
            seen++;
            // Where depth changes fast a raw pixel may show one of two points.
            if (cv::norm(back[i] - pixels[i]) > 1e-4)
                continue;
            EXPECT_LE(cv::norm(Point2d(columns.at<float>(whole[i]), rows.at<float>(whole[i])) - atRaw[i]), 1e-3);
            inverse++;
        }
    }
    EXPECT_GE(seen, 100);
    EXPECT_GE(inverse, 0.95 * seen);
}

INSTANTIATE_TEST_CASE_P(RSAckermann_Warp, OffsetWarp,
                        testing::Combine(testing::Values(ALL_LENSES),
                                         testing::Values(int(SCAN_TOP_TO_BOTTOM), int(SCAN_RIGHT_TO_LEFT))));

//! Largest distance in pixels of the places of a rectify map from those of single points.
double largestError(const RollingShutterCamera& camera, const AckermannMotion& motion,
                    const Matx33d& newCameraMatrix = Matx33d::zeros())
{
    WarpMapGenerator::Params params;
    params.tolerance = 1e-5;
    params.newCameraMatrix = newCameraMatrix;
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera, params);
    Mat columns, rows;
    generator->initRectifyMap(motion, columns, rows);
    std::vector<Point2d> pixels, exact;
    for (int i = 0; i < int(columns.total()); i++)
        pixels.push_back(Point(i % columns.cols, i / columns.cols));
    std::vector<uchar> exists;
    generator->distortPoints(motion, pixels, exact, noArray(), exists);
    double largest = 0;
    for (size_t i = 0; i < pixels.size(); i++)
        if (exists[i])
            largest = std::max(largest, cv::norm(exact[i] - Point2d(columns.at<float>(Point(pixels[i])),
                                                                    rows.at<float>(Point(pixels[i])))));
    return largest;
}

// Offsets as drives have them; maps as exact as without one.
TEST(RSAckermann_InverseDepthOffset, every_pixel_of_a_map_is_exact)
{
    RNG rng(40);
    for (int round = 0; round < 4; round++)
    {
        const RollingShutterCamera camera = lensCamera(round % 2 ? int(BROWN_5) : int(NO_LENS));
        AckermannMotion motion = motionFromMetric(camera, rng.uniform(-0.3, 0.3), rng.uniform(5., 20.), 3, 5, 0);
        addOffset(motion, 0.03, rng);
        motion.offsetArea = Rect2d(-0.5, -0.32, 1, 0.64);
        EXPECT_LT(largestError(camera, motion), 5e-4) << "round " << round;
    }
}

// What is between the places that are solved isn't overlooked.
TEST(RSAckermann_InverseDepthOffset, with_fine_cells)
{
    const RollingShutterCamera camera = lensCamera(NO_LENS);
    AckermannMotion motion = motionFromMetric(camera, 0.2, 10, 3, 5, 0);
    motion.inverseDepthOffset = Mat::zeros(160, 240, CV_64F);
    motion.inverseDepthOffset.at<double>(50, 77) = 0.05;
    motion.inverseDepthOffset.at<double>(103, 181) = -0.05;
    motion.offsetArea = Rect2d(-0.5, -0.32, 1, 0.64);
    EXPECT_LT(largestError(camera, motion), 5e-4);
}

// An image that shows more than the area of the offset.
TEST(RSAckermann_InverseDepthOffset, beyond_its_area)
{
    RNG rng(41);
    const RollingShutterCamera camera = lensCamera(NO_LENS);
    AckermannMotion motion = motionFromMetric(camera, 0.2, 10, 3, 5, 0);
    addOffset(motion, 0.03, rng);
    motion.offsetArea = Rect2d(-0.1, -0.05, 0.15, 0.12);
    EXPECT_LT(largestError(camera, motion, Matx33d(600, 0, 320, 0, 600, 190, 0, 0, 1)), 2e-3);
}

TEST(RSAckermann_InverseDepthOffset, of_a_camera_at_rest_does_nothing)
{
    RNG rng(42);
    const RollingShutterCamera camera = lensCamera(BROWN_5);
    AckermannMotion motion;
    motion.inverseDepthOffset.create(5, 6, CV_64F);
    rng.fill(motion.inverseDepthOffset, RNG::NORMAL, 0, 0.1);
    motion.offsetArea = Rect2d(-0.5, -0.32, 1, 0.64);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    Mat maps[2][4];
    for (int k = 0; k < 2; k++)
    {
        generator->initRectifyMap(k ? motion : AckermannMotion(), maps[k][0], maps[k][1]);
        generator->initDistortMap(k ? motion : AckermannMotion(), maps[k][2], maps[k][3]);
    }
    for (int i = 0; i < 4; i++)
        EXPECT_LE(cvtest::norm(maps[0][i], maps[1][i], NORM_INF), 2e-3) << i;
}

TEST(RSAckermann_InverseDepthOffset, of_nothing_is_none)
{
    RNG rng(33);
    const RollingShutterCamera camera = lensCamera(BROWN_5);
    AckermannMotion motion = randomMotion(camera, rng);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    Mat maps[2][4];
    for (int k = 0; k < 2; k++)
    {
        generator->initRectifyMap(motion, maps[k][0], maps[k][1]);
        generator->initDistortMap(motion, maps[k][2], maps[k][3]);
        addOffset(motion, 0, rng);
    }
    for (int i = 0; i < 4; i++)
        EXPECT_LE(cvtest::norm(maps[0][i], maps[1][i], NORM_INF), 1e-3) << i;
}

TEST(RSAckermann_InverseDepthOffset, of_any_size_gives_finite_maps)
{
    RNG rng(34);
    const RollingShutterCamera camera = lensCamera(BROWN_5);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    for (double part : {1., 1e2, 1e10, 1e28})
    {
        AckermannMotion motion = motionFromMetric(camera, 0.3, 15, 3, 4, 0);
        addOffset(motion, part, rng);
        Mat maps[4];
        generator->initRectifyMap(motion, maps[0], maps[1]);
        generator->initDistortMap(motion, maps[2], maps[3]);
        for (int i = 0; i < 4; i++)
            EXPECT_TRUE(cv::checkRange(maps[i], true, 0, -32768, 32768)) << part << ", map " << i;
        std::vector<Point2d> pixels, places[2];
        for (int i = 0; i < 100; i++)
            pixels.push_back(uniformPoint(rng, Point2d(-1e4, -1e4), Point2d(1e4, 1e4)));
        generator->distortPoints(motion, pixels, places[0]);
        generator->correctPoints(motion, pixels, places[1]);
        for (int i = 0; i < 2; i++)
            EXPECT_TRUE(cv::checkRange(Mat(places[i]), true, 0, -32768, 32768)) << part << ", points " << i;
    }
}

TEST(RSAckermann_InverseDepthOffset, bad_ones_are_refused)
{
    RNG rng(35);
    const RollingShutterCamera camera = lensCamera(NO_LENS);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    AckermannMotion good = randomMotion(camera, rng);
    addOffset(good, 0.1, rng);
    Mat map1, map2;
    const auto expectRefused = [&](const AckermannMotion& motion, const std::string& words) {
        try
        {
            generator->initRectifyMap(motion, map1, map2);
            ADD_FAILURE() << words;
        }
        catch (const cv::Exception& e)
        {
            EXPECT_EQ(Error::StsBadArg, e.code);
            EXPECT_NE(std::string::npos, e.err.find(words)) << e.err;
        }
    };
    AckermannMotion bad = good;
    bad.inverseDepthOffset = Mat::zeros(3, 9, CV_64F);
    expectRefused(bad,
                  "motion.inverseDepthOffset is a 3 x 9 matrix of type CV_64FC1; from 4 x 4 to 1024 x 1024 values");
    bad.inverseDepthOffset = Mat::zeros(9, 3, CV_64F);
    expectRefused(bad, "motion.inverseDepthOffset is a 9 x 3 matrix");
    bad.inverseDepthOffset = Mat::zeros(4, 1025, CV_64F);
    expectRefused(bad, "motion.inverseDepthOffset is a 4 x 1025 matrix");
    bad.inverseDepthOffset = Mat::zeros(5, 9, CV_32F);
    expectRefused(bad, "of type CV_32FC1");
    bad.inverseDepthOffset = good.inverseDepthOffset.clone();
    bad.inverseDepthOffset.at<double>(1, 2) = std::numeric_limits<double>::quiet_NaN();
    expectRefused(bad, "motion.inverseDepthOffset has values");
    bad = good;
    bad.offsetArea.width = 0;
    expectRefused(bad, "motion.offsetArea.width is 0");
    bad = good;
    bad.offsetArea.height = -1;
    expectRefused(bad, "motion.offsetArea.height is -1");
    bad = good;
    bad.offsetArea.x = std::numeric_limits<double>::infinity();
    expectRefused(bad, "motion.offsetArea.x is inf");
    bad = good;
    bad.offsetArea.y = std::numeric_limits<double>::quiet_NaN();
    expectRefused(bad, "motion.offsetArea.y is nan");
}

}} // namespace opencv_test::
