// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"

namespace opencv_test { namespace {

//! A camera at a random tilt and heading.
RollingShutterCamera randomCamera(RNG& rng)
{
    RollingShutterCamera camera = simulation::paperCamera();
    const Point2d rollPitch = uniformPoint(rng, Point2d(-0.3, -0.3), Point2d(0.3, 0.3));
    camera.setRollPitch(rollPitch.x, rollPitch.y);
    camera.heading = rng.uniform(-CV_PI, CV_PI);
    return camera;
}

TEST(RSAckermann_Motion, default_is_at_rest)
{
    const AckermannMotion m;
    EXPECT_EQ(MOTION_NOT_SIGNIFICANT, m.status);
    EXPECT_EQ(MODEL_NONE, m.model);
    EXPECT_EQ(0, m.alpha);
    EXPECT_EQ(0, m.wallSlope);
    EXPECT_EQ(0, m.wallOffset);
    EXPECT_EQ(0, m.wallRatio);
    EXPECT_EQ(0, m.roadSlope);
    EXPECT_EQ(1, m.direction);
    EXPECT_EQ(0, m.delta());
}

// The paper's setting by hand: f = 816 px, line delay 0.4/30/380 s, left wall 2.5 m, right wall 3 m, camera at 1.2 m.
TEST(RSAckermann_Motion, fromMetric_forward_camera)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const double unit = 816 * 0.4 / 30 / 380;
    const AckermannMotion m = motionFromMetric(camera, 40 * degree, 20, 2.5, 3, 0.05);
    EXPECT_EQ(MOTION_OK, m.status);
    EXPECT_EQ(MODEL_4LA, m.model);
    EXPECT_NEAR(20 * degree * unit, m.alpha, 1e-15);
    EXPECT_NEAR(20 * unit / 2.5, std::hypot(m.wallSlope, m.wallOffset), 1e-15);
    EXPECT_NEAR(std::tan(0.05), m.delta(), 1e-15);
    EXPECT_GT(m.wallSlope, 0);
    EXPECT_NEAR(2.5 / 3, m.wallRatio, 1e-15);
    EXPECT_NEAR(20 * unit / 1.2, m.roadSlope, 1e-15);
    EXPECT_EQ(1, m.direction);
    EXPECT_EQ(2.5, m.wallDistance);

    const AckermannMotion reverse = motionFromMetric(camera, 40 * degree, -20, 2.5, 3, 0.05);
    EXPECT_NEAR(m.alpha, reverse.alpha, 1e-15);
    EXPECT_NEAR(-m.wallSlope, reverse.wallSlope, 1e-15);
    EXPECT_NEAR(-m.wallOffset, reverse.wallOffset, 1e-15);
    EXPECT_NEAR(m.wallRatio, reverse.wallRatio, 1e-15);
    EXPECT_NEAR(-m.roadSlope, reverse.roadSlope, 1e-15);
    EXPECT_EQ(-1, reverse.direction);
}

// A camera that looks to the right sees the right wall parallel to the image: B = 0, D = beta / distance.
TEST(RSAckermann_Motion, fromMetric_side_cameras)
{
    RollingShutterCamera camera = simulation::paperCamera();
    const double w = 10 * camera.secondsPerUnitTime() / 4;

    camera.heading = -CV_PI / 2;
    AckermannMotion m = motionFromMetric(camera, 0, 10, 0, 4, camera.heading);
    EXPECT_NEAR(0, m.wallSlope, 1e-15);
    EXPECT_NEAR(w, m.wallOffset, 1e-15);
    EXPECT_EQ(0, m.wallRatio);
    EXPECT_EQ(4, m.wallDistance);
    EXPECT_EQ(MODEL_3LA, m.model);
    EXPECT_EQ(0, m.delta());

    camera.heading = CV_PI / 2;
    m = motionFromMetric(camera, 0, 10, 4, 0, camera.heading);
    EXPECT_NEAR(0, m.wallSlope, 1e-15);
    EXPECT_NEAR(w, m.wallOffset, 1e-15);
    EXPECT_EQ(0, m.wallRatio);
}

TEST(RSAckermann_Motion, fromMetric_models)
{
    RollingShutterCamera camera = simulation::paperCamera();
    EXPECT_EQ(MODEL_1LA, motionFromMetric(camera, 0.5, 0, 2, 2, 0).model);
    EXPECT_EQ(MODEL_3LA, motionFromMetric(camera, 0, 10, 2, 2, 0).model);
    EXPECT_EQ(MODEL_4LA, motionFromMetric(camera, 0.5, 10, 2, 2, 0).model);
    EXPECT_EQ(MOTION_NOT_SIGNIFICANT, motionFromMetric(camera, 0, 0, 2, 2, 0).status);
    camera.height = 0;
    EXPECT_EQ(0, motionFromMetric(camera, 0.5, 10, 2, 2, 0).roadSlope);
}

// A translation is kept by what it does to walls or road: without either it would be lost, depths or not.
TEST(RSAckermann_Motion, fromMetric_of_a_speed_without_walls_and_height)
{
    RollingShutterCamera camera = simulation::paperCamera();
    EXPECT_NE(0, motionFromMetric(camera, 0.5, 10, 0, 0, 0).roadSlope);
    camera.height = 0;
    EXPECT_EQ(MODEL_1LA, motionFromMetric(camera, 0.5, 0, 0, 0, 0).model);
    EXPECT_EQ(MODEL_4LA, motionFromMetric(camera, 0.5, 10, 0, 2, 0).model);
    try
    {
        motionFromMetric(camera, 0.5, 10, 0, 0, 0);
        FAIL();
    }
    catch (const cv::Exception& e)
    {
        for (const char* word : {"metric.speed is 10", "camera.height", "metric.leftDistance", "metric.rightDistance"})
            EXPECT_NE(std::string::npos, e.err.find(word)) << e.err;
    }
}

TEST(RSAckermann_Motion, fromMetric_bad_arguments)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    EXPECT_THROW(motionFromMetric(camera, NaN, 10, 2, 2, 0), cv::Exception);
    EXPECT_THROW(motionFromMetric(camera, 0.5, infinity, 2, 2, 0), cv::Exception);
    EXPECT_THROW(motionFromMetric(camera, 0.5, 10, -2, 2, 0), cv::Exception);
    EXPECT_THROW(motionFromMetric(camera, 0.5, 10, 2, NaN, 0), cv::Exception);
    EXPECT_THROW(motionFromMetric(camera, 0.5, 10, 2, 2, infinity), cv::Exception);
    RollingShutterCamera untimed = camera;
    untimed.lineDelay = 0;
    EXPECT_THROW(motionFromMetric(untimed, 0.5, 10, 2, 2, 0), cv::Exception);
    EXPECT_THROW(motionFromMetric(RollingShutterCamera(), 0.5, 10, 2, 2, 0), cv::Exception);
}

TEST(RSAckermann_Motion, metric_round_trip)
{
    RNG& rng = theRNG();
    for (int i = 0; i < 1000; i++)
    {
        const RollingShutterCamera camera = randomCamera(rng);
        const double yawRate = rng.uniform(-1.5, 1.5), speed = rng.uniform(-40., 40.);
        const int walls = rng.uniform(1, 4);
        const double left = walls & 1 ? rng.uniform(1., 10.) : 0, right = walls & 2 ? rng.uniform(1., 10.) : 0;
        const AckermannMotion m = motionFromMetric(camera, yawRate, speed, left, right, rng.uniform(-CV_PI, CV_PI));
        double w = 0, v = 0;
        ASSERT_TRUE(m.yawRate(camera, w));
        ASSERT_NEAR(yawRate, w, 1e-12);
        ASSERT_TRUE(m.speed(camera, v));
        ASSERT_NEAR(speed, v, 1e-11);
    }
}

TEST(RSAckermann_Motion, speed_of_a_height_without_walls)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.height = 1.2;
    MetricMotion metric;
    for (const double speed : {11., -11.})
    {
        metric.speed = speed;
        AckermannMotion m = AckermannMotion::fromMetric(camera, metric);
        double got = 0;
        ASSERT_TRUE(m.speed(camera, got));
        EXPECT_NEAR(speed, got, 1e-12);
        RollingShutterCamera other = camera;
        other.height = 0;
        EXPECT_FALSE(m.speed(other, got));
        m.scale = SCALE_UNKNOWN;
        EXPECT_FALSE(m.speed(camera, got));
        EXPECT_EQ(0, got);
    }
}

TEST(RSAckermann_Motion, rows_that_pitch_and_roll_from_metric_values)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    MetricMotion metric;
    EXPECT_EQ(MOTION_NOT_SIGNIFICANT, AckermannMotion::fromMetric(camera, metric).status);
    metric.pitchRate = 0.3;
    metric.rollRate = -0.2;
    const AckermannMotion m = AckermannMotion::fromMetric(camera, metric);
    EXPECT_EQ(MOTION_OK, m.status);
    EXPECT_EQ(MODEL_1LA, m.model);
    EXPECT_EQ(0, m.alpha);
    // Of the camera at a row: the optical axis sinks with the pitch, the right sinks with the roll.
    const double time = 0.01;
    Matx33d R;
    Vec3d place;
    m.pose(camera, time, R, place);
    EXPECT_NEAR(0.3 * time * camera.secondsPerUnitTime(), (R * Vec3d(0, 0, 1))[1], 1e-7);
    EXPECT_NEAR(-0.2 * time * camera.secondsPerUnitTime(), (R * Vec3d(1, 0, 0))[1], 1e-7);
    for (double MetricMotion::*rate : {&MetricMotion::pitchRate, &MetricMotion::rollRate})
    {
        MetricMotion bad;
        bad.*rate = NaN;
        EXPECT_THROW(AckermannMotion::fromMetric(camera, bad), cv::Exception);
    }
}

// Against differences of the getters, for covariances of which no entry is special.
TEST(RSAckermann_Motion, metric_covariance)
{
    RNG rng(9);
    const RollingShutterCamera camera = simulation::paperCamera();
    for (int round = 0; round < 20; round++)
    {
        const double wallDirection = rng.uniform(-1., 1.), speed = rng.uniform(5., 30.) * (round % 2 ? 1 : -1),
                     yawRate = rng.uniform(-1., 1.);
        AckermannMotion m = motionFromMetric(camera, yawRate, speed, 2.5, 3, wallDirection);
        Matx44d root, J;
        for (int i = 0; i < 16; i++)
            root.val[i] = rng.uniform(-0.01, 0.01);
        m.covariance = root * root.t();
        double AckermannMotion::*const unknowns[] = {&AckermannMotion::alpha, &AckermannMotion::wallSlope,
                                                     &AckermannMotion::wallOffset, &AckermannMotion::wallRatio};
        for (int j = 0; j < 4; j++)
        {
            Vec4d at[2];
            const double h = 1e-6;
            for (int side = 0; side < 2; side++)
            {
                AckermannMotion other = m;
                other.*unknowns[j] += side ? h : -h;
                ASSERT_TRUE(other.yawRate(camera, at[side][0]) && other.speed(camera, at[side][1]));
                at[side][2] = other.delta();
                at[side][3] = other.wallRatio;
            }
            for (int i = 0; i < 4; i++)
                J(i, j) = (at[1][i] - at[0][i]) / (2 * h);
        }
        const Matx44d expected = J * m.covariance * J.t(), got = m.metricCovariance(camera);
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                EXPECT_NEAR(expected(i, j), got(i, j), 1e-5 * std::sqrt(expected(i, i) * expected(j, j)))
                    << i << " " << j;
    }
}

TEST(RSAckermann_Motion, metric_covariance_of_an_uncertain_line_delay)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.lineDelaySigma = 0.1 * camera.lineDelay;
    AckermannMotion m = motionFromMetric(camera, 0.5, 10, 2, 2, 0);
    Matx44d covariance = m.metricCovariance(camera);
    EXPECT_NEAR(0.05, std::sqrt(covariance(0, 0)), 1e-9);
    EXPECT_NEAR(1, std::sqrt(covariance(1, 1)), 1e-9);
    EXPECT_NEAR(0.05, covariance(0, 1), 1e-9);
    EXPECT_EQ(0, covariance(2, 2));
    m.scale = SCALE_SPEED;
    covariance = m.metricCovariance(camera);
    EXPECT_NEAR(0.05, std::sqrt(covariance(0, 0)), 1e-9);
    EXPECT_EQ(0, covariance(1, 1));
    m.covariance = 1e-6 * Matx44d::eye();
    m.speedSigma = 3;
    for (const int scale : {SCALE_SPEED, SCALE_ROAD})
    {
        m.scale = scale;
        covariance = m.metricCovariance(camera);
        EXPECT_EQ(9, covariance(1, 1));
        EXPECT_EQ(0, covariance(0, 1));
    }
}

TEST(RSAckermann_Motion, metric_values_are_unknown_without_scale)
{
    RollingShutterCamera camera = simulation::paperCamera();
    AckermannMotion m = motionFromMetric(camera, 0.5, 10, 2, 2, 0);
    camera.lineDelay = 0;
    double value = NaN;
    EXPECT_FALSE(m.yawRate(camera, value));
    EXPECT_EQ(value, value) << "NaN";
    value = NaN;
    EXPECT_FALSE(m.speed(camera, value));
    EXPECT_EQ(value, value) << "NaN";
}

// The planes of a motion give the depth of the points that the simulator's rays hit.
TEST(RSAckermann_Motion, depth_agrees_with_ray_casting)
{
    RNG& rng = theRNG();
    int seen[4] = {0, 0, 0, 0};
    for (int i = 0; i < 1000; i++)
    {
        const RollingShutterCamera camera = randomCamera(rng);
        const double speed = rng.uniform(1., 40.) * (rng.uniform(0, 2) ? 1 : -1);
        const double left = rng.uniform(1., 10.), right = rng.uniform(1., 10.);
        const AckermannMotion m = motionFromMetric(camera, 0.5, speed, left, right, camera.heading);
        const simulation::Simulator truth =
            simulation::Simulator::fromMetric(camera, 0.5, speed, left, right, camera.heading);
        const double x = rng.uniform(-0.6, 0.6), y = rng.uniform(-0.4, 0.4);
        const Vec3d ray(x, y, 1);
        const simulation::Surface plane = truth.street.first(Vec3d(), ray);
        const double depth = truth.street.distance(plane, Vec3d(), ray);
        const double w[] = {0, m.wallOffset - m.wallSlope * x, m.wallRatio * (m.wallSlope * x - m.wallOffset),
                            m.roadSlope * y};
        const double beta = speed * camera.secondsPerUnitTime();
        ASSERT_NEAR(beta / depth, w[plane], 1e-12 * std::abs(beta));
        for (int j = 0; j < 4; j++)
            ASSERT_LE(m.direction * w[j], m.direction * w[plane] + 1e-12)
                << "the nearest plane has the largest inverse depth";
        seen[plane]++;
    }
    for (int j = simulation::LEFT; j <= simulation::ROAD; j++)
        EXPECT_GT(seen[j], 50);
}

// The pose of a row maps a point seen at that time to the same point at the reference row.
TEST(RSAckermann_Motion, pose_agrees_with_simulation)
{
    RNG& rng = theRNG();
    for (int i = 0; i < 1000; i++)
    {
        const RollingShutterCamera camera = randomCamera(rng);
        const double yawRate = rng.uniform(-1.5, 1.5), speed = rng.uniform(1., 40.) * (rng.uniform(0, 2) ? 1 : -1);
        const AckermannMotion m = motionFromMetric(camera, yawRate, speed, 2.5, 3, 0.1);
        const simulation::Drive drive = simulation::Simulator::fromMetric(camera, yawRate, speed, 2.5, 3, 0.1).drive;
        const double beta = std::abs(drive.speed), t = rng.uniform(-0.3, 0.3);

        Matx33d R;
        Vec3d T;
        m.pose(camera, t, R, T);
        const double z = rng.uniform(3., 20.), y = rng.uniform(-2., 2.), x = rng.uniform(-5., 5.);
        const Vec3d P(x, y, z);
        const Vec3d now = camera.uprightRotation.t() * drive.toCamera(P, t), reference = camera.uprightRotation.t() * P;
        // lengths of a pose are those at which the scaled inverse depth beta / depth is 1
        ASSERT_LT(cv::norm(R * now + T * beta - reference), 1e-12);
        ASSERT_LT(cv::norm(R * R.t() - Matx33d::eye()), 1e-12);
    }
}

TEST(RSAckermann_Motion, pose_of_a_pure_rotation_has_no_translation)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    AckermannMotion m;
    m.alpha = 0.02;
    m.status = MOTION_OK;
    m.model = MODEL_1LA;
    Matx33d R;
    Vec3d T(1, 2, 3);
    m.pose(camera, 0.2, R, T);
    EXPECT_EQ(Vec3d(), T);
    // the car turns to the right: what the later camera sees ahead is to the right for the earlier one
    EXPECT_LT(cv::norm(R * Vec3d(0, 0, 1) - Vec3d(std::sin(0.008), 0, std::cos(0.008))), 1e-15);
    EXPECT_THROW(m.pose(camera, NaN, R, T), cv::Exception);
}

// A heading of +90 degrees: the car moves to the right of what the camera looks at.
TEST(RSAckermann_Motion, heading_sign)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.heading = CV_PI / 2;
    const AckermannMotion m = motionFromMetric(camera, 0, 10, 4, 0, camera.heading);
    Matx33d R;
    Vec3d T;
    m.pose(camera, 0.1, R, T);
    EXPECT_LT(cv::norm(T - Vec3d(0.1, 0, 0)), 1e-15);
}

TEST(RSAckermann_Motion, corrections_add_to_roll_and_pitch)
{
    RollingShutterCamera camera = simulation::paperCamera();
    AckermannMotion m;
    EXPECT_EQ(camera.uprightRotation, m.uprightRotation(camera));

    // first order: the corrected rotation is that of a camera with the corrected angles
    camera.setRollPitch(0.05, -0.08);
    m.rollCorrection = 1e-4;
    m.pitchCorrection = -2e-4;
    RollingShutterCamera corrected = camera;
    corrected.setRollPitch(0.05 + 1e-4, -0.08 - 2e-4);
    EXPECT_LT(cv::norm(m.uprightRotation(camera) * corrected.gravity() - Vec3d(0, 1, 0)), 0.1 * 2e-4);
}

TEST(RSAckermann_Motion, covariance_of_the_slowest_motion)
{
    AckermannMotion motion = exampleMotion();
    const double speeds[] = {1e-99, 8e-214, 2e-311}, variances[] = {1e-198, 1e-209, 1e-310};
    for (int i = 0; i < 3; i++)
    {
        motion.wallSlope = motion.wallOffset = speeds[i];
        motion.covariance = Matx44d::diag(Vec4d(1e-4, variances[i], variances[i], 1));
        EXPECT_TRUE(cv::checkRange(Mat(motion.metricCovariance(exampleCamera())))) << speeds[i];
    }
}

}} // namespace
