// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"
#include "../src/single/displacement_field.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

const int COLUMNS = DisplacementField::COLUMNS, ROWS = DisplacementField::ROWS, POINTS = DisplacementField::POINTS;

//! Cameras with focal lengths that differ, for every direction of a row shutter, ahead and to both sides; the last ones
//! are wide, and tilted, or have lenses as well.
RollingShutterCamera makeCamera(int k)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.cameraMatrix(0, 0) *= 1.2;
    camera.scanDirection = k % 2;
    camera.heading = (k / 2 % 3 - 1) * 80 * degree;
    if (k >= 12)
    {
        camera.lensModel = LENS_FISHEYE;
        camera.distCoeffs = {0.02, -0.01, 0.002, 0};
        camera.cameraMatrix(0, 0) *= 0.6;
        camera.cameraMatrix(1, 1) *= 0.6;
    }
    if (k >= 6)
    {
        camera.cameraMatrix(0, 0) *= 0.5;
        camera.cameraMatrix(1, 1) *= 0.5;
        camera.setRollPitch(0.1, k % 2 ? 0.4 : -0.4);
    }
    return camera;
}

const int CAMERAS = 18;

//! A motion so small that squares don't count.
AckermannMotion smallMotion(const RollingShutterCamera& camera, int k)
{
    AckermannMotion m = motionFromMetric(camera, k % 3 == 1 ? 0 : -0.002,
                                         k % 3 == 2 ? 0
                                         : k % 2    ? -0.05
                                                    : 0.05,
                                         2.5, 3, camera.heading + 0.1);
    m.status = MOTION_OK;
    m.pitchRate = 3e-5 * (k % 3);
    m.rollRate = 5e-5 * (1 - k % 2);
    if (k > 2)
    {
        RNG rng(k);
        m.rotationCurve.create(5, 3, CV_64F);
        rng.fill(m.rotationCurve, RNG::UNIFORM, -1e-5, 1e-5);
    }
    return m;
}

Model modelOf(const AckermannMotion& m)
{
    Model model;
    model.direction = m.direction;
    model[P_ALPHA] = m.alpha;
    model[P_B] = m.wallSlope;
    model[P_D] = m.wallOffset;
    model[P_LAMBDA] = m.wallRatio;
    return model;
}

TEST(RSAckermann_DisplacementField, is_that_of_the_simulator)
{
    for (int c = 0; c < CAMERAS; c++)
        for (int k = 0; k < 6; k++)
        {
            const RollingShutterCamera camera = makeCamera(c);
            const AckermannMotion motion = smallMotion(camera, k);
            DisplacementField::Values values;
            DisplacementField(camera).displacement(modelOf(motion), motion.roadSlope, values);
            DisplacementField(camera).addTilt(RowTilt(camera, motion), values);
            const Simulator simulator = Simulator::fromMotion(camera, motion);
            double largest = 0;
            std::vector<double> errors;
            for (int i = 0; i < ROWS; i++)
                for (int j = 0; j < COLUMNS; j++)
                {
                    const Point2d raw((j + 0.5) / COLUMNS * camera.imageSize.width - 0.5,
                                      (i + 0.5) / ROWS * camera.imageSize.height - 0.5);
                    Point2d global;
                    ASSERT_TRUE(simulator.globalPixel(raw, global));
                    const int n = 2 * (i * COLUMNS + j);
                    largest = std::max(largest, cv::norm(global - raw));
                    errors.push_back(cv::norm(Point2d(values[n], values[n + 1]) - (global - raw)));
                }
            // In one place the line between two planes may be on the other side of the pixel.
            std::sort(errors.begin(), errors.end());
            EXPECT_LT(errors[errors.size() - 2], 0.01 * largest) << "camera " << c << ", motion " << k;
        }
}

TEST(RSAckermann_DisplacementField, variance_is_that_of_small_changes)
{
    RNG rng(5);
    for (int c = 0; c < CAMERAS; c++)
    {
        const RollingShutterCamera camera = makeCamera(c);
        const DisplacementField field(camera);
        const AckermannMotion motion = motionFromMetric(camera, -0.3, 20, 2.5, 3, camera.heading + 0.1);
        const Model model = modelOf(motion);
        Matx<double, PARAMETERS, PARAMETERS> root, covariance;
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                root(i, j) = rng.uniform(-1e-6, 1e-6);
        covariance = root * root.t();
        const double sigmaG = 2e-6;
        DisplacementField::Variances got;
        field.variance(model, motion.roadSlope, sigmaG * sigmaG, covariance, got);

        DisplacementField::Values at, moved;
        field.displacement(model, motion.roadSlope, at);
        DisplacementField::Variances expected;
        // The columns of the root are independent changes of one standard deviation.
        for (int j = 0; j < 5; j++)
        {
            Model other = model;
            for (int i = 0; i < 4 && j < 4; i++)
                other.value[i] += root(i, j);
            field.displacement(other, motion.roadSlope + (j == 4 ? sigmaG : 0), moved);
            for (int k = 0; k < POINTS; k++)
                expected[k] += std::pow(moved[2 * k] - at[2 * k], 2) + std::pow(moved[2 * k + 1] - at[2 * k + 1], 2);
        }
        for (int k = 0; k < POINTS; k++)
            EXPECT_NEAR(expected[k], got[k], 0.01 * expected[k] + 1e-15) << "camera " << c << ", point " << k;
    }
}

// Of rows that are tilted as well: each rate alone, and both.
TEST(RSAckermann_DisplacementField, variance_of_tilts_is_that_of_small_changes)
{
    for (int c = 0; c < CAMERAS; c++)
    {
        const RollingShutterCamera camera = makeCamera(c);
        const DisplacementField field(camera);
        for (const Vec2d& sigmas : {Vec2d(2e-4, 0), Vec2d(0, 3e-4), Vec2d(2e-4, 3e-4)}) // of pitch and roll
        {
            DisplacementField::Variances got = DisplacementField::Variances::all(1), expected = got;
            field.addTiltVariance(sigmas[0], sigmas[1], got);
            for (int axis = 0; axis < 2; axis++)
            {
                AckermannMotion tilted;
                (axis == 0 ? tilted.pitchRate : tilted.rollRate) = sigmas[axis];
                DisplacementField::Values moved;
                field.addTilt(RowTilt(camera, tilted), moved);
                for (int k = 0; k < POINTS; k++)
                    expected[k] += moved[2 * k] * moved[2 * k] + moved[2 * k + 1] * moved[2 * k + 1];
            }
            for (int k = 0; k < POINTS; k++)
                EXPECT_NEAR(expected[k], got[k], 1e-9 * expected[k]) << "camera " << c << ", point " << k;
        }
    }
}

TEST(RSAckermann_DisplacementField, mean_distance)
{
    DisplacementField::Values a, b;
    DisplacementField::Variances variance;
    for (int k = 0; k < POINTS; k++)
    {
        a[2 * k] = 3 + k;
        a[2 * k + 1] = 4;
        b[2 * k] = k;
    }
    EXPECT_NEAR(5, DisplacementField::meanDistance(a, b, variance), 1e-12);
    variance = DisplacementField::Variances::all(100);
    // Without a difference, the mean magnitude of a normal deviate.
    EXPECT_NEAR(10 * std::sqrt(2 / CV_PI), DisplacementField::meanDistance(a, a, variance), 1e-12);
    EXPECT_GT(DisplacementField::meanDistance(a, b, variance), DisplacementField::meanDistance(a, a, variance));
}

TEST(RSAckermann_DisplacementField, main_motion)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const DisplacementField field(camera);
    const double yawRates[] = {0, 0.6, 0, 0.6, 0.6, 0.004}, speeds[] = {0, 0, 20, 20, 0.02, 20};
    const int expected[] = {MODEL_NONE, MODEL_1LA, MODEL_3LA, MODEL_4LA, MODEL_1LA, MODEL_3LA};
    for (int k = 0; k < 6; k++)
    {
        const AckermannMotion motion = motionFromMetric(camera, yawRates[k], speeds[k], 2.5, 3, 0);
        EXPECT_EQ(expected[k], field.mainMotion(modelOf(motion), motion.roadSlope)) << k;
    }
}

// What is seen in one place counts as often there as it is seen: the mean displacement goes from that over the image to
// that of the place.
TEST(RSAckermann_DisplacementField, counts_where_something_is_seen)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    Model m;
    m[P_ALPHA] = 0.01;
    const auto mean = [&](const std::vector<Point2d>& seen) {
        DisplacementField::Values values;
        DisplacementField(camera, seen).displacement(m, 0, values);
        return DisplacementField::meanDistance(values, DisplacementField::Values(), DisplacementField::Variances());
    };
    // The corner of the image, but for the distance of the grid's outermost point from it.
    const Vec3d corner = camera.uprightRotation * (camera.cameraMatrix.inv() * Vec3d(1, 1, 1));
    const Point2d place(corner[0] / corner[2], corner[1] / corner[2]);
    const Point2d pixel(0.5 * camera.imageSize.width / DisplacementField::COLUMNS - 0.5,
                        0.5 * camera.imageSize.height / DisplacementField::ROWS - 0.5);
    const Vec3d point = camera.uprightRotation * (camera.cameraMatrix.inv() * Vec3d(pixel.x, pixel.y, 1));
    const double x = point[0] / point[2], y = point[1] / point[2], f = camera.cameraMatrix(0, 0),
                 t = camera.rowTime(pixel), there = f * std::abs(t) * 0.02 * std::hypot(1 + x * x, x * y);
    const double everywhere = mean(std::vector<Point2d>());
    for (int n = 1; n <= 1000; n *= 10)
    {
        const double points = DisplacementField::POINTS;
        EXPECT_NEAR((points * everywhere + n * there) / (points + n), mean(std::vector<Point2d>(n, place)),
                    1e-3 * there);
    }
}

}} // namespace
