// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "opencv2/rsackermann/calibration.hpp"
#include "test_drive_simulator.hpp"

// The line delay of a camera that shakes, by a gyro (doc/theory.md, "Self-calibration").

namespace opencv_test { namespace {

using simulation::StreetDrive;

const int FRAMES = 60;
const double INTERVAL = 1. / 30;

RollingShutterCamera camera(double readOut)
{
    RollingShutterCamera c(Size(960, 540), Matx33d(700, 0, 470, 0, 720, 280, 0, 0, 1));
    c.setRollPitch(1.2 * degree, -0.8 * degree);
    c.heading = 1.5 * degree;
    c.lineDelay = readOut / 540;
    c.height = 1.4;
    return c;
}

//! A camera on a holder that shakes, in a car that hardly bends. @param shortest, longest periods in seconds.
StreetDrive::Options shaking(double size, double yawRate = 1 * degree, double shortest = 0.2, double longest = 0.6)
{
    StreetDrive::Options options;
    options.yawRate = yawRate;
    options.tilt = size;
    options.rowsTurn = true;
    options.sway = [=](double deviation, RNG& rng) -> simulation::Sway {
        const simulation::Oscillation oscillation(deviation, shortest, longest, rng);
        return [oscillation](double seconds) { return oscillation.at(seconds); };
    };
    return options;
}

struct Gyro
{
    double delay;
    Mat times, rates;

    //! @param noise_ of a rate, deg/s.
    Gyro(const StreetDrive& street, double delay_, RNG& rng, double noise_ = 0.1) : delay(delay_)
    {
        const Vec3d bias(0.3 * degree, -0.2 * degree, 0.1 * degree);
        for (double t = -0.5; t < FRAMES * INTERVAL + 0.5; t += 1 / 200.)
        {
            const Vec3d noise(rng.gaussian(noise_), rng.gaussian(noise_), rng.gaussian(noise_)),
                rate = street.rateAt(t) + bias + noise * degree;
            times.push_back(t + delay);
            rates.push_back(Mat(rate.t()));
        }
    }
};

//! @param focalScale what is given over the true focal length.
RollingShutterCamera given(const RollingShutterCamera& truth, double delayRatio, double focalScale = 1)
{
    RollingShutterCamera c = truth;
    c.lineDelay *= delayRatio;
    c.cameraMatrix(0, 0) *= focalScale;
    c.cameraMatrix(1, 1) *= focalScale;
    return c;
}

//! @param began seconds of all clocks at the first frame.
MountCalibration calibrate(const RollingShutterCamera& known, StreetDrive street, const Gyro* gyro, double began = 0)
{
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(known);
    if (gyro)
        calibrator->addGyro(Mat(gyro->times + began), gyro->rates);
    for (int i = 0; i < FRAMES; i++)
    {
        const StreetDrive::Frame f = street.frame(i * INTERVAL, INTERVAL);
        calibrator->addPoints(f.points, f.segments, f.seconds + began);
    }
    return calibrator->calibrate();
}

// Without bends, from 30 % too small to 30 % too large, or none at all; with the clock and the focal length. The sigmas
// are those of the errors.
TEST(RSAckermann_CalibrationWithGyro, line_delay_clock_and_focal_length)
{
    const double ratios[] = {1, 0.7, 1.3, 0};
    const int drives = 12;
    int within[3] = {0, 0, 0};
    for (int i = 0; i < drives; i++)
    {
        SCOPED_TRACE(i);
        RNG rng(500 + i);
        const RollingShutterCamera truth = camera(rng.uniform(0.015, 0.03));
        const StreetDrive street(truth, 1.2 * degree, -0.8 * degree, shaking(0.4 * degree), 60 + i);
        const double focalScale = 1 + rng.gaussian(0.02);
        const Gyro gyro(street, i % 3 == 2 ? 0.7 : rng.gaussian(0.01), rng);
        const MountCalibration c = calibrate(given(truth, ratios[i % 4], focalScale), street, &gyro);
        EXPECT_GT(c.gyroFrames, FRAMES * 3 / 4);
        ASSERT_TRUE(c.lineDelayObserved);
        EXPECT_EQ(c.lineDelay, c.camera.lineDelay);
        EXPECT_NEAR(1, c.lineDelay / truth.lineDelay, 0.03);
        EXPECT_LT(c.lineDelaySigma, 0.03 * truth.lineDelay);
        EXPECT_NEAR(gyro.delay, c.gyroDelay, 0.003);
        EXPECT_LT(c.gyroDelaySigma, 0.002);
        EXPECT_LT(c.focalScaleSigma, 0.01);
        within[0] += std::abs(c.lineDelay - truth.lineDelay) < 2 * c.lineDelaySigma;
        within[1] += std::abs(c.gyroDelay - gyro.delay) < 2 * c.gyroDelaySigma;
        within[2] += std::abs(c.focalScale - 1 / focalScale) < 2 * c.focalScaleSigma;
    }
    for (int k = 0; k < 3; k++)
        EXPECT_GE(within[k], drives - 2) << k;
}

// The rows of line delays that are tried may turn for longer than those of the given one.
TEST(RSAckermann_CalibrationWithGyro, line_delay_that_was_far_off)
{
    for (const double ratio : {0.35, 2.})
    {
        RNG rng(600);
        const RollingShutterCamera truth = camera(0.025);
        const StreetDrive street(truth, 1.2 * degree, -0.8 * degree, shaking(0.4 * degree), 80);
        const Gyro gyro(street, 0.005, rng);
        const MountCalibration c = calibrate(given(truth, ratio), street, &gyro);
        ASSERT_TRUE(c.lineDelayObserved) << ratio;
        EXPECT_NEAR(1, c.lineDelay / truth.lineDelay, 0.03) << ratio;
    }
}

// Nothing is left of a focal length that isn't exact.
TEST(RSAckermann_CalibrationWithGyro, focal_length_that_is_not_exact)
{
    const double wrong[] = {0.94, 1.08};
    for (int i = 0; i < 2; i++)
    {
        SCOPED_TRACE(i);
        RNG rng(700 + i);
        const RollingShutterCamera truth = camera(0.025);
        const StreetDrive street(truth, 0, 0, shaking(0.4 * degree), 90 + i);
        RollingShutterCamera approximate = given(truth, 0.8, wrong[i]);
        const Gyro gyro(street, 0, rng);
        EXPECT_EQ(approximate.cameraMatrix, calibrate(approximate, street, &gyro).camera.cameraMatrix); // exact
        approximate.focalSigma = 0.06 * approximate.cameraMatrix(0, 0);
        const MountCalibration c = calibrate(approximate, street, &gyro);
        ASSERT_TRUE(c.lineDelayObserved);
        EXPECT_NEAR(1, c.lineDelay / truth.lineDelay, 0.03);
        EXPECT_NEAR(truth.lineDelay, c.lineDelay, 3 * c.lineDelaySigma);
        // The gyro's scale is known to 3 %, the focal length was known to 6 %.
        EXPECT_NEAR(1, c.camera.cameraMatrix(0, 0) / truth.cameraMatrix(0, 0), 0.03);
        EXPECT_NEAR(0.027, c.camera.focalSigma / c.camera.cameraMatrix(0, 0), 0.004);
        EXPECT_NEAR(1, c.focalScale * wrong[i], 0.02);
    }
}

// A gyro that a longer focal length contradicts still shows the true one.
TEST(RSAckermann_CalibrationWithGyro, focal_length_that_is_too_long)
{
    RNG rng(750);
    const RollingShutterCamera truth = camera(0.025);
    const StreetDrive street(truth, 0, 0, shaking(0.4 * degree), 95);
    const Gyro gyro(street, 0, rng);
    for (const double sigma : {0., 0.01})
    {
        RollingShutterCamera approximate = given(truth, 1, 1.09);
        approximate.focalSigma = sigma * approximate.cameraMatrix(0, 0);
        const MountCalibration c = calibrate(approximate, street, &gyro);
        EXPECT_GT(c.gyroFrames, FRAMES / 2);
        EXPECT_NEAR(1 / 1.09, c.focalScale, 0.02);
        EXPECT_LT(c.focalScaleSigma, 0.02);
    }
}

// Aside a wrong focal length makes turns seem larger where it makes them smaller ahead.
TEST(RSAckermann_CalibrationWithGyro, focal_length_of_cameras_that_look_aside)
{
    for (const double heading : {90 * degree, -60 * degree, CV_PI})
        for (const double wrong : {0.9, 1.1})
        {
            SCOPED_TRACE(testing::Message() << heading / degree << " " << wrong);
            RNG rng(800);
            RollingShutterCamera truth = camera(0.025);
            truth.heading = heading;
            const StreetDrive street(truth, 0, 0, shaking(0.05 * degree, 10 * degree), 100);
            RollingShutterCamera approximate = given(truth, 1, wrong);
            approximate.focalSigma = 0.1 * approximate.cameraMatrix(0, 0);
            const Gyro gyro(street, 0, rng);
            const MountCalibration c = calibrate(approximate, street, &gyro);
            EXPECT_GT(c.gyroFrames, FRAMES / 2);
            EXPECT_NEAR(1 / wrong, c.focalScale, 3 * c.focalScaleSigma);
            EXPECT_NEAR(truth.cameraMatrix(0, 0), c.camera.cameraMatrix(0, 0), 2 * c.camera.focalSigma);
            EXPECT_LE(c.camera.focalSigma, approximate.focalSigma);
        }
}

// The car's own turning counts once.
TEST(RSAckermann_CalibrationWithGyro, bends)
{
    for (int i = 0; i < 3; i++)
    {
        RNG rng(600 + i);
        const RollingShutterCamera truth = camera(0.025);
        const StreetDrive street(truth, 1.2 * degree, -0.8 * degree, shaking(0.1 * degree, 15 * degree), 70 + i);
        const Gyro gyro(street, 0, rng);
        const MountCalibration c = calibrate(given(truth, 0.8), street, &gyro);
        EXPECT_NEAR(1, c.lineDelay / truth.lineDelay, 0.03) << i;
        EXPECT_NEAR(truth.heading / degree, c.heading / degree, 0.1) << i;
    }
}

// Of an engine that turns each row otherwise: a clock that is a millisecond late would show another part of it.
TEST(RSAckermann_CalibrationWithGyro, clock_while_an_engine_shakes)
{
    for (int i = 0; i < 3; i++)
    {
        RNG rng(640 + i);
        const RollingShutterCamera truth = camera(0.025);
        const StreetDrive street(truth, 1.2 * degree, -0.8 * degree, shaking(0.05 * degree, 10 * degree, 0.025, 0.05),
                                 85 + i);
        const Gyro gyro(street, 0, rng);
        const MountCalibration c = calibrate(given(truth, 0.8), street, &gyro);
        EXPECT_NEAR(truth.lineDelay, c.lineDelay, 3 * c.lineDelaySigma) << i;
        EXPECT_NEAR(0, c.gyroDelay, 3 * c.gyroDelaySigma) << i;
    }
}

// Where nothing shakes the noise of a cheap gyro doesn't make the line delay shorter.
TEST(RSAckermann_CalibrationWithGyro, noise_turns_no_rows)
{
    for (int i = 0; i < 3; i++)
    {
        RNG rng(620 + i);
        const RollingShutterCamera truth = camera(0.025);
        const StreetDrive street(truth, 1.2 * degree, -0.8 * degree, shaking(0, 25 * degree), 80 + i);
        const Gyro gyro(street, 0, rng, 1);
        const MountCalibration c = calibrate(given(truth, 0.8), street, &gyro);
        EXPECT_NEAR(truth.lineDelay, c.lineDelay, 3 * c.lineDelaySigma) << i;
        EXPECT_NEAR(1, c.lineDelay / truth.lineDelay, 0.03) << i;
    }
}

// Of a phone that somebody has put on a dashboard, in an uneven street with many wrong points. What is assumed of
// cars doesn't hold back how it shakes.
TEST(RSAckermann_CalibrationWithGyro, unknown_mount_among_wrong_points)
{
    for (int i = 0; i < 4; i++)
    {
        SCOPED_TRACE(i);
        RNG rng(700 + i);
        RollingShutterCamera truth = camera(0.03), known = given(truth, 0.8);
        known.setRollPitch(0, 0);
        known.heading = 0;
        truth.setRollPitch(2 * degree, -2 * degree);
        truth.heading = (i % 2 ? 4 : -4) * degree;
        StreetDrive::Options options = shaking(0.4 * degree);
        options.unevenness = 0.03;
        options.outliers = 0.4;
        options.segments = 0;
        const StreetDrive street(truth, 2 * degree, -2 * degree, options, 90 + i);
        const Gyro gyro(street, 0, rng);
        const MountCalibration c = calibrate(known, street, &gyro);
        EXPECT_GT(c.gyroFrames, FRAMES * 3 / 4);
        ASSERT_TRUE(c.lineDelayObserved);
        EXPECT_NEAR(1, c.lineDelay / truth.lineDelay, 0.03);
        ASSERT_TRUE(c.headingObserved);
        EXPECT_NEAR(truth.heading / degree, c.heading / degree, 0.5);
        EXPECT_NEAR(1, c.focalScale, 2 * c.focalScaleSigma);
    }
}

// The turns that are compared with the gyro are about the axes of the camera as it is found.
TEST(RSAckermann_CalibrationWithGyro, from_another_mount)
{
    const RollingShutterCamera truth = camera(0.03);
    const StreetDrive street(truth, 1.2 * degree, -0.8 * degree, shaking(0.4 * degree), 95);
    RNG rng(96);
    const Gyro gyro(street, 0, rng);
    const MountCalibration expected = calibrate(truth, street, &gyro);
    for (double sign = -1; sign <= 1; sign += 2)
    {
        RollingShutterCamera known = truth;
        known.setRollPitch((1.2 + 2 * sign) * degree, (-0.8 + 2 * sign) * degree);
        const MountCalibration c = calibrate(known, street, &gyro);
        EXPECT_NEAR(expected.lineDelay, c.lineDelay, 0.5 * c.lineDelaySigma) << sign;
    }
}

// Of which a double has a quarter of a microsecond.
TEST(RSAckermann_CalibrationWithGyro, clocks_that_began_in_1970)
{
    const RollingShutterCamera truth = camera(0.025);
    const StreetDrive street(truth, 0, 0, shaking(0.4 * degree), 83);
    RNG rng(84);
    const Gyro gyro(street, 0.01, rng);
    const MountCalibration now = calibrate(given(truth, 0.7), street, &gyro),
                           later = calibrate(given(truth, 0.7), street, &gyro, 1.7e9);
    EXPECT_NEAR(1, later.lineDelay / now.lineDelay, 1e-3);
    EXPECT_NEAR(1, later.lineDelaySigma / now.lineDelaySigma, 0.05);
    EXPECT_NEAR(now.gyroDelay, later.gyroDelay, 1e-4);
}

// A gyro of another drive isn't used, and neither is one that was removed.
TEST(RSAckermann_CalibrationWithGyro, that_is_wrong_changes_nothing)
{
    const RollingShutterCamera truth = camera(0.025);
    const StreetDrive street(truth, 0, 0, shaking(0.4 * degree), 80), other(truth, 0, 0, shaking(0.4 * degree), 81);
    const MountCalibration without = calibrate(given(truth, 0.7), street, 0);
    EXPECT_EQ(0, without.gyroFrames);
    EXPECT_EQ(0, without.gyroDelaySigma);
    EXPECT_EQ(0, without.focalScaleSigma);
    EXPECT_EQ(1, without.focalScale);
    RNG rng(82);
    Gyro gyro(other, 0, rng);
    const MountCalibration with = calibrate(given(truth, 0.7), street, &gyro);
    EXPECT_LE(with.gyroFrames, 3);
    EXPECT_NEAR(without.lineDelay, with.lineDelay, 0.01 * truth.lineDelay);
    gyro = Gyro(street, 0, rng);
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(given(truth, 0.7));
    calibrator->addGyro(gyro.times, gyro.rates);
    calibrator->clearGyro();
    StreetDrive again = street;
    for (int i = 0; i < FRAMES; i++)
    {
        const StreetDrive::Frame f = again.frame(i * INTERVAL, INTERVAL);
        calibrator->addPoints(f.points, f.segments, f.seconds);
    }
    EXPECT_EQ(without.lineDelay, calibrator->calibrate().lineDelay);
    EXPECT_EQ(0, calibrator->calibrate().gyroFrames);
}

// Whenever its clock began.
TEST(RSAckermann_CalibrationWithGyro, bad_samples_throw)
{
    for (const double began : {0., 1.6e9})
    {
        SCOPED_TRACE(began);
        const Ptr<MountCalibrator> calibrator = MountCalibrator::create(camera(0.025));
        const Mat times = (Mat_<double>(3, 1) << began, began + 0.01, began + 0.02), rates(3, 3, CV_64F, Scalar(0));
        EXPECT_THROW(calibrator->addGyro(times, rates.colRange(0, 2)), cv::Exception);
        EXPECT_THROW(calibrator->addGyro(times, Mat(3, 3, CV_32F, Scalar(0))), cv::Exception);
        calibrator->addGyro(times, rates);
        EXPECT_THROW(calibrator->addGyro(times, rates), cv::Exception); // not after those
        EXPECT_NO_THROW(calibrator->addGyro(times + 0.03, rates));
        calibrator->clearGyro();
        EXPECT_NO_THROW(calibrator->addGyro(times, rates));
        calibrator->clear();
        EXPECT_NO_THROW(calibrator->addGyro(times, rates));
    }
}

}} // namespace opencv_test
