// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_private_problem.hpp"
#include "test_lens_models.hpp"
#include "test_warp_cameras.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

AckermannEstimator::Params paramsWithWall(double distance)
{
    AckermannEstimator::Params params;
    params.wallDistance = distance;
    params.slantTolerance = 0;
    return params;
}

//! d x / d t of the image of a vertical line at the column x, by the simulator: the slope of its picture.
double slantOf(const Simulator& simulator, double x, double distance)
{
    const double t = 1e-4;
    const Vec3d P = Vec3d(x, 0, 1) * (distance / std::sqrt(1 + x * x));
    const Vec3d before = simulator.drive.toCamera(P, -t), after = simulator.drive.toCamera(P, t);
    return (after[0] / after[2] - before[0] / before[2]) / (2 * t);
}

// A vertical at the least distance, seen by a car as fast and turning as fast as it may, is what the gate just lets
// through.
TEST(RSAckermann_Candidates, largest_slant)
{
    const AckermannEstimator::Params params = paramsWithWall(2.5);
    for (int k = 0; k < 3; k++)
    {
        RollingShutterCamera camera = simulation::paperCamera();
        camera.heading = (k - 1) * 70 * degree;
        const MotionLimits limits(camera, params);
        for (int column = -6; column <= 6; column++)
        {
            const double x = 0.25 * column;
            double largest = 0;
            // A wall seen at the azimuth of x is nearest if it is square to the line of sight.
            for (int sign = 0; sign < 4; sign++)
                largest = std::max(
                    largest, std::abs(slantOf(Simulator::fromMetric(camera, (sign % 2 ? 1 : -1) * params.maxYawRate,
                                                                    (sign / 2 ? 1 : -1) * params.maxSpeed, 2.5, 0, 0),
                                              x, 2.5)));
            EXPECT_NEAR(largest, limits.maxSlant(x, camera.heading), 1e-5) << k << " " << column;
        }
    }
}

TEST(RSAckermann_Candidates, limits)
{
    RollingShutterCamera camera = simulation::paperCamera();
    const AckermannEstimator::Params params = paramsWithWall(2.5);
    const double unit = camera.secondsPerUnitTime();
    const MotionLimits limits(camera, params);
    EXPECT_TRUE(limits.areMetric);
    EXPECT_NEAR(params.maxYawRate * unit / 2, limits.maxAlpha, 1e-12);
    EXPECT_NEAR(params.maxSpeed * unit / 2.5, limits.maxScaledSpeed, 1e-12);
    EXPECT_NEAR(6 * params.maxSlant, limits.maxRightScaledSpeed, 1e-12);
    EXPECT_FALSE(MotionLimits(camera, AckermannEstimator::Params()).areMetric);
    camera.lineDelay = 0;
    EXPECT_NEAR(params.maxSlant / 2, MotionLimits(camera, params).maxAlpha, 1e-12);

    Model m;
    EXPECT_TRUE(limits.allow(m));
    m[P_ALPHA] = 1.01 * limits.maxAlpha;
    EXPECT_FALSE(limits.allow(m));
    m[P_ALPHA] = -0.99 * limits.maxAlpha;
    m[P_B] = 0.6 * limits.maxScaledSpeed;
    m[P_D] = 0.79 * limits.maxScaledSpeed;
    EXPECT_TRUE(limits.allow(m));
    m[P_LAMBDA] = 1.02 * limits.maxRightScaledSpeed / limits.maxScaledSpeed;
    EXPECT_FALSE(limits.allow(m)); // too fast for the right wall
    m[P_LAMBDA] = 0.98 * limits.maxRightScaledSpeed / limits.maxScaledSpeed;
    EXPECT_TRUE(limits.allow(m));
    m[P_LAMBDA] = 0;
    m[P_D] = 0.81 * limits.maxScaledSpeed;
    EXPECT_FALSE(limits.allow(m));
}

TEST(RSAckermann_Candidates, sorts_segments)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.cameraMatrix(0, 0) *= 1.2;
    AckermannEstimator::Params params;
    params.maxSlant = 0.2;
    params.slantTolerance = 0.05;
    camera.lineDelay = 0; // the largest slant alone counts
    // A hundred rows high each, at the principal point; columns are 1.2 times as wide as rows are high.
    const double x = camera.cameraMatrix(0, 2), ends[] = {0, 19, 23, 25, 35};
    Mat segments(6, 4, CV_64F);
    for (int i = 0; i < 5; i++)
        Mat(Vec4d(x - 0.6 * ends[i], 140, x + 0.6 * ends[i], 240)).reshape(1, 1).copyTo(segments.row(i));
    Mat(Vec4d(x, 140, x, 160)).reshape(1, 1).copyTo(segments.row(5)); // too short
    std::vector<UprightSegment> verticals, others;
    selectCandidates(segments, camera, params, verticals, others);
    std::vector<int> indices;
    for (size_t i = 0; i < verticals.size(); i++)
        indices.push_back(verticals[i].index);
    std::sort(indices.begin(), indices.end());
    EXPECT_EQ(std::vector<int>({0, 1}), indices);
    ASSERT_EQ(3u, others.size());
    for (int i = 0; i < 3; i++)
        EXPECT_EQ(2 + i, others[i].index);
    EXPECT_NEAR(0.19 * 100 / 816.,
                std::abs(verticals[0].u[0] - verticals[0].v[0]) + std::abs(verticals[1].u[0] - verticals[1].v[0]),
                1e-9);
    EXPECT_NEAR(100 / 816., verticals[0].timeV - verticals[0].timeU, 1e-9);
}

// With the distance of the wall a fast car may make a vertical lean by more than the usual limit.
TEST(RSAckermann_Candidates, what_a_near_wall_allows)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.heading = CV_PI / 2; // looks at the wall
    AckermannEstimator::Params near = paramsWithWall(0.5), usual = near;
    near.maxSpeed = 200;
    usual.wallDistance = 0;
    const double slant = 0.9 * MotionLimits(camera, near).maxSlant(0, camera.heading);
    ASSERT_GT(slant, 1.1 * usual.maxSlant);
    const double x = camera.cameraMatrix(0, 2), dx = slant * 50 * camera.cameraMatrix(0, 0) / camera.cameraMatrix(1, 1);
    const Mat segment = Mat(Vec4d(x - dx, 140, x + dx, 240)).reshape(1, 1);
    std::vector<UprightSegment> verticals, others;
    selectCandidates(segment, camera, near, verticals, others);
    EXPECT_EQ(1u, verticals.size());
    selectCandidates(segment, camera, usual, verticals, others);
    EXPECT_EQ(0u, verticals.size());
}

// How far the image of a straight segment of the raw image is from its chord, in pixels, by OpenCV's inverse of the
// lens.
TEST(RSAckermann_Candidates, sagitta_of_each_lens)
{
    for (const int lens : {ALL_LENSES})
    {
        SCOPED_TRACE(lens);
        const RollingShutterCamera camera = lensCamera(lens);
        const Vec4d segment(70, 20, 75, 350);
        const std::vector<Point2d> raw = {Point2d(segment[0], segment[1]), Point2d(segment[2], segment[3]),
                                          Point2d((segment[0] + segment[2]) / 2, (segment[1] + segment[3]) / 2)};
        std::vector<Point2d> p;
        if (lens == FISHEYE_LENS)
            cv::fisheye::undistortPoints(raw, p, camera.cameraMatrix, camera.distCoeffs);
        else
            cv::undistortPoints(raw, p, camera.cameraMatrix, camera.distCoeffs, noArray(), noArray(),
                                TermCriteria(TermCriteria::COUNT + TermCriteria::EPS, 100, 1e-12));
        std::vector<UprightSegment> verticals, others;
        selectCandidates(Mat(segment.t()), camera, AckermannEstimator::Params(), verticals, others);
        ASSERT_EQ(1u, verticals.size());
        const double expected = camera.cameraMatrix(0, 0) * cv::norm(p[2] - 0.5 * (p[0] + p[1]));
        EXPECT_EQ(lens != NO_LENS, expected > 1) << expected;
        EXPECT_NEAR(expected, verticals[0].sagitta, 1e-3);
    }
}

// Wherever they are in the image, of whatever shape it is, but not where a part of them is beyond it.
TEST(RSAckermann_Candidates, all_of_the_image_and_nothing_else)
{
    for (const Size& size : {Size(640, 380), Size(380, 640)})
    {
        const RollingShutterCamera camera = RollingShutterCamera::fromFocal(size, 816);
        Mat segments(0, 4, CV_64F);
        std::vector<int> expected;
        for (int x = -20; x < size.width + 20; x += 20)
            for (int y = -60; y < size.height + 20; y += 20)
            {
                if (x >= 0 && x < size.width && y >= 0 && y + 50 < size.height)
                    expected.push_back(segments.rows);
                segments.push_back(Mat(Vec4d(x, y, x, y + 50)).reshape(1, 1));
            }
        std::vector<UprightSegment> verticals, others;
        selectCandidates(segments, camera, AckermannEstimator::Params(), verticals, others);
        std::vector<int> indices;
        for (const UprightSegment& s : verticals)
            indices.push_back(s.index);
        std::sort(indices.begin(), indices.end());
        EXPECT_EQ(expected, indices) << size;
        EXPECT_TRUE(others.empty()) << size;
    }
}

// If speed and wall say that nothing leans much, what leans more is no candidate, but nearly vertical all the same.
TEST(RSAckermann_Candidates, what_is_nearly_vertical_is_neither)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    AckermannEstimator::Params params = paramsWithWall(50);
    params.maxYawRate = 0.1;
    params.slantTolerance = 0.02;
    const double x = camera.cameraMatrix(0, 2),
                 steepest = MotionLimits(camera, params).maxSlant(0, 0) + params.slantTolerance;
    ASSERT_LT(steepest, 0.1);
    const double slants[] = {0.9 * steepest, 1.1 * steepest, 0.9 * params.maxSlant, 1.1 * params.maxSlant};
    Mat segments(4, 4, CV_64F);
    for (int i = 0; i < 4; i++)
        Mat(Vec4d(x - 50 * slants[i], 140, x + 50 * slants[i], 240)).reshape(1, 1).copyTo(segments.row(i));
    std::vector<UprightSegment> verticals, others;
    selectCandidates(segments, camera, params, verticals, others);
    ASSERT_EQ(1u, verticals.size());
    EXPECT_EQ(0, verticals[0].index);
    ASSERT_EQ(1u, others.size());
    EXPECT_EQ(3, others[0].index);
}

}} // namespace
