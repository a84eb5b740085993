// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_symmetry.hpp"
#include "test_drive_simulator.hpp"
#include "opencv2/rsackermann/calibration.hpp"

// Self-calibrations of cameras in each mode: the truth, what a mirror shows, and drives one after another.

namespace opencv_test { namespace {

using simulation::StreetDrive;

const double INTERVAL = 1. / 30;

struct Mode
{
    const char* name;
    double roll, pitch, heading, known; // degrees; the last one is the heading that is given
    int scan;
};

const Mode MODES[] = {{"forward", 1, -1, 1, 0, SCAN_TOP_TO_BOTTOM},
                      {"tilted", 5, -6, 4, 0, SCAN_TOP_TO_BOTTOM},
                      {"looks half right", 2, -3, -42, -45, SCAN_TOP_TO_BOTTOM},
                      {"from below", 2, 3, 2, 0, SCAN_BOTTOM_TO_TOP}};

RollingShutterCamera cameraOf(const Mode& mode)
{
    RollingShutterCamera camera(Size(960, 540), Matx33d(700, 0, 470, 0, 720, 280, 0, 0, 1));
    camera.scanDirection = mode.scan;
    camera.lineDelay = 0.025 / 540;
    camera.height = 1.4;
    camera.heading = mode.known * degree;
    return camera;
}

MountCalibration calibrate(const Mode& mode, const std::vector<StreetDrive::Frame>& frames, const Twin& twin)
{
    const RollingShutterCamera known = cameraOf(mode);
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(twin.of(known));
    for (const StreetDrive::Frame& f : frames)
        calibrator->addPoints(twin.ofPlaces(f.points, known.imageSize), twin.ofPlaces(f.segments, known.imageSize),
                              f.seconds);
    return calibrator->calibrate();
}

typedef testing::TestWithParam<int> CalibrationModes; // index of MODES

TEST_P(CalibrationModes, truth_and_mirror)
{
    const Mode& mode = MODES[GetParam()];
    SCOPED_TRACE(mode.name);
    RollingShutterCamera truth = cameraOf(mode);
    truth.heading = mode.heading * degree;
    StreetDrive street(truth, mode.roll * degree, mode.pitch * degree, StreetDrive::Options(), 7);
    std::vector<StreetDrive::Frame> frames;
    double roll = 0, pitch = 0;
    const int count = 60;
    for (int i = 0; i < count; i++)
    {
        frames.push_back(street.frame(i * INTERVAL, INTERVAL));
        roll += frames[i].roll / count;
        pitch += frames[i].pitch / count;
    }
    const Twin twin = MIRRORED_ON_ITS_HEAD;
    const MountCalibration c = calibrate(mode, frames, Twin()), m = calibrate(mode, frames, twin);
    EXPECT_NEAR(roll / degree, c.roll / degree, 0.1);
    EXPECT_NEAR(pitch / degree, c.pitch / degree, 0.1);
    EXPECT_NEAR(mode.heading, c.heading / degree, 0.2);
    EXPECT_LT(cv::norm(twin.of(c.camera).uprightRotation, m.camera.uprightRotation), 0.01 * degree);
    EXPECT_NEAR(CV_PI, std::abs(c.roll + m.roll), 0.01 * degree);
    EXPECT_NEAR(c.pitch / degree, m.pitch / degree, 0.01);
    EXPECT_NEAR(c.heading / degree, -m.heading / degree, 0.01);
    EXPECT_NEAR(c.lineDelay, m.lineDelay, 0.002 * c.lineDelay);
    EXPECT_NEAR(c.rollSigma, m.rollSigma, 0.02 * c.rollSigma);
    EXPECT_NEAR(c.headingSigma, m.headingSigma, 0.02 * c.headingSigma);
    EXPECT_NEAR(c.lineDelaySigma, m.lineDelaySigma, 0.02 * c.lineDelaySigma);
    EXPECT_EQ(c.frames, m.frames);
}

INSTANTIATE_TEST_CASE_P(RSAckermann, CalibrationModes, testing::Range(0, int(sizeof(MODES) / sizeof(*MODES))));

// Images that a conversion of the frame rate has left out show in speeds that go to and fro: the line delay is as
// uncertain as the times are.
TEST(RSAckermann_CalibrationModes, images_that_are_left_out)
{
    const Mode& mode = MODES[0];
    RollingShutterCamera truth = cameraOf(mode);
    truth.heading = mode.heading * degree;
    const int count = 60, of = 6; // one of them is left out
    double sigmas[2];
    for (const bool isConverted : {false, true})
        for (const bool isSpeedGiven : {false, true})
        {
            SCOPED_TRACE(testing::Message() << isConverted << isSpeedGiven);
            StreetDrive street(truth, mode.roll * degree, mode.pitch * degree, StreetDrive::Options(), 9);
            const Ptr<MountCalibrator> calibrator = MountCalibrator::create(cameraOf(mode));
            MotionPrior speed;
            speed.speedSigma = isSpeedGiven ? 0.1 : 0;
            int images = 0, passed = 1;
            for (int i = 0; i < count; i++, passed++)
            {
                if (isConverted && i % of == of - 1)
                    continue;
                const StreetDrive::Frame f = street.frame(i * INTERVAL, passed * INTERVAL);
                speed.speed = f.speed;
                const double interval = isConverted ? INTERVAL * of / (of - 1) : INTERVAL;
                calibrator->addPoints(images > 0 ? f.points : Mat(), f.segments, images * interval, speed);
                images++;
                passed = 0;
            }
            const MountCalibration c = calibrator->calibrate();
            RecordProperty("jitter", format("%.3f", c.intervalSigma));
            if (isConverted)
                EXPECT_GT(c.intervalSigma, 0.1);
            else
                EXPECT_LT(c.intervalSigma, 0.03);
            EXPECT_NEAR(truth.lineDelay, c.lineDelay, 2 * c.lineDelaySigma);
            sigmas[isConverted] = c.lineDelaySigma;
        }
    EXPECT_LT(sigmas[0], 0.05 * truth.lineDelay);
    EXPECT_GT(sigmas[1], 0.1 * truth.lineDelay);
}

// Each drive has its own clock of the gyro: what is found is that of the last one, and the frames of both count.
// Whatever line delay is given, it is the same.
TEST(RSAckermann_CalibrationModes, gyro_of_two_drives)
{
    const Mode& mode = MODES[0];
    RollingShutterCamera truth = cameraOf(mode), shorter = truth;
    truth.heading = mode.heading * degree;
    shorter.lineDelay *= 0.75;
    StreetDrive::Options options;
    options.yawRate = 1 * degree;
    options.tilt = 0.4 * degree;
    options.rowsTurn = true;
    options.sway = [](double deviation, RNG& rng) -> simulation::Sway {
        const simulation::Oscillation oscillation(deviation, 0.2, 0.6, rng);
        return [oscillation](double seconds) { return oscillation.at(seconds); };
    };
    const Ptr<MountCalibrator> calibrators[] = {MountCalibrator::create(cameraOf(mode)),
                                                MountCalibrator::create(shorter)};
    StreetDrive street(truth, mode.roll * degree, mode.pitch * degree, options, 8);
    const double delays[] = {0.015, -0.015};
    const int count = 40;
    for (int drive = 0; drive < 2; drive++)
    {
        Mat times, rates;
        const double begin = 3 * drive, end = begin + count * INTERVAL;
        for (double t = begin - 0.5; t < end + 0.5; t += 1 / 200.)
        {
            times.push_back(t + delays[drive]);
            rates.push_back(Mat(street.rateAt(t).t()));
        }
        for (const Ptr<MountCalibrator>& calibrator : calibrators)
            calibrator->addGyro(times, rates);
        for (int i = 0; i < count; i++)
        {
            const StreetDrive::Frame f = street.frame(begin + i * INTERVAL, INTERVAL);
            for (const Ptr<MountCalibrator>& calibrator : calibrators)
                calibrator->addPoints(f.points, f.segments, f.seconds);
        }
    }
    const MountCalibration c = calibrators[0]->calibrate(), other = calibrators[1]->calibrate();
    EXPECT_GT(c.gyroFrames, 2 * (count - 8));
    EXPECT_NEAR(delays[1], c.gyroDelay, 3 * c.gyroDelaySigma);
    EXPECT_NEAR(1, c.lineDelay / truth.lineDelay, 0.05);
    EXPECT_EQ(c.gyroFrames, other.gyroFrames);
    EXPECT_NEAR(c.gyroDelay, other.gyroDelay, 0.05 * c.gyroDelaySigma);
    EXPECT_NEAR(c.lineDelay, other.lineDelay, 0.001 * c.lineDelay);
    EXPECT_NEAR(c.lineDelaySigma, other.lineDelaySigma, 0.01 * c.lineDelaySigma);
}

}} // namespace opencv_test::
