// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"

#include "../src/calibration/calibration_frame.hpp"

namespace opencv_test { namespace {

using namespace cv::rsackermann;

//! A frame without evidence of a car that goes straight ahead between walls at inverse distances.
CalibrationFrame frameBetween(const RollingShutterCamera& camera, double left, double right)
{
    CalibrationFrame frame;
    frame.drive = 1;
    frame.before = 0;
    frame.time = frame.interval = 1 / 30.;
    frame.value.setZero();
    frame.value[SEQUENCE_SPEED] = 10;
    frame.value[SEQUENCE_LEFT] = left;
    frame.value[SEQUENCE_RIGHT] = right;
    frame.value[SEQUENCE_ROAD] = 1 / camera.height;
    for (int i = 0; i < SCENE_VALUES; i++)
    {
        frame.expected[i] = frame.value[i];
        frame.sigma[i] = 1;
    }
    return frame;
}

const ResidualSigmas USUAL = {1, 1, 1};

RollingShutterCamera straightCamera()
{
    RollingShutterCamera camera(Size(960, 540), Matx33d(700, 0, 479.5, 0, 700, 269.5, 0, 0, 1));
    camera.lineDelay = 0.025 / 540;
    camera.height = 1.4;
    return camera;
}

//! Whether a point that stays in its place counts.
bool counts(CalibrationFrame frame, const Point2d& pixel)
{
    const RollingShutterCamera camera = straightCamera();
    const PointPair pair = {pixel, pixel};
    addBearings(camera, std::vector<PointPair>(1, pair), frame.interval, frame.bearings);
    FrameProblem(camera, MountVector::Zero(), 1, USUAL).weigh(frame);
    return frame.pointWeights[0] != Matx22d::zeros();
}

TEST(RSAckermann_PrivateCalibration, points_at_the_foot_of_a_wall_do_not_count)
{
    for (const double speed : {10., -10.})
        for (const int side : {-1, 1})
        {
            SCOPED_TRACE(testing::Message() << speed << ", " << side);
            CalibrationFrame frame = frameBetween(straightCamera(), side < 0 ? 0.125 : 0, side > 0 ? 0.125 : 0);
            frame.value[SEQUENCE_SPEED] = speed;
            // The foot of a wall at 8 m is as far below the horizon as 1.4 m are of 8.
            const double x = 479.5 + 400 * side, foot = 269.5 + 1.4 / 8 * 400;
            // The tracker's window has eleven pixels of an image of half the size, and gradients one more on each side.
            for (const double part : {-1.25, -0.8, 0.8, 1.25})
                EXPECT_EQ(std::abs(part) > 1, counts(frame, Point2d(x, foot + 13 * part))) << part;
        }
}

TEST(RSAckermann_PrivateCalibration, far_points_above_the_horizon_count)
{
    const RollingShutterCamera camera = straightCamera();
    const CalibrationFrame withoutWalls = frameBetween(camera, 0, 0), street = frameBetween(camera, 0.1, 0.1);
    const Point2d vanishing(479.5, 269.5);
    for (const double x : {-20, 0, 20})
        for (const double y : {40, 100, 200})
        {
            EXPECT_TRUE(counts(withoutWalls, vanishing + Point2d(x, -y))) << x << " " << y;
            EXPECT_TRUE(counts(street, vanishing + Point2d(x, -y))) << x << " " << y;
        }
    EXPECT_FALSE(counts(street, vanishing + Point2d(10, -2)));
}

//! A vertical that leans, at a side, -1 or 1, of the image.
UprightSegment verticalAt(int side)
{
    const double x = 0.4 * side, y[] = {-0.3, 0.1};
    const UprightSegment vertical = {Vec3d(x - 0.05, y[0], 1), Vec3d(x + 0.05, y[1], 1), y[0], y[1], 0.4 * 700, 0, 0};
    return vertical;
}

UncertainResidual residualOf(const CalibrationFrame& frame)
{
    std::vector<UncertainResidual> slants;
    FrameProblem(straightCamera(), MountVector::Zero(), 1, USUAL).addSlantResiduals(frame, slants);
    return slants[0];
}

// By as much as it would lean otherwise if its wall were nearer there by 0.03/m, whichever wall it is, alone or not,
// and wherever the street leads.
TEST(RSAckermann_PrivateCalibration, depth_makes_verticals_uncertain)
{
    for (const int side : {-1, 1})
        for (const bool isAlone : {false, true})
            for (const double direction : {-0.25, 0., 0.25})
            {
                SCOPED_TRACE(testing::Message() << side << ", alone " << isAlone << ", " << direction);
                const double other = isAlone ? 0 : 0.1, h = 1e-4;
                CalibrationFrame frame = frameBetween(straightCamera(), other, other), farther = frame;
                frame.verticals.assign(1, verticalAt(side));
                frame.value[SEQUENCE_DIRECTION] = direction;
                const SequenceValue wall = side < 0 ? SEQUENCE_LEFT : SEQUENCE_RIGHT;
                frame.value[wall] = 0.125;
                const UncertainResidual residual = residualOf(frame);
                farther = frame;
                frame.value[wall] += h;
                farther.value[wall] -= h;
                const double byWall = (residualOf(frame).value - residualOf(farther).value) / (2 * h),
                             depth = side / (std::cos(direction) * 0.4 * side - std::sin(direction)); // at a metre
                EXPECT_NEAR(std::abs(byWall * 0.03 * depth), std::abs(residual.by), 1e-3);
                EXPECT_GT(std::abs(residual.by), 0.1);
                for (const double depths : {0., 1.})
                {
                    const ResidualSigmas sigmas = {1, 1, depths};
                    FrameProblem(straightCamera(), MountVector::Zero(), 1, sigmas).weigh(farther);
                    EXPECT_NEAR(1 / std::hypot(1, depths * residual.by), farther.slantWeights[0], 1e-3);
                }
            }
}

}} // namespace opencv_test::
