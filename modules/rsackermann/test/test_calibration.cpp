// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "opencv2/rsackermann/calibration.hpp"
#include "test_drive_simulator.hpp"

namespace opencv_test { namespace {

using simulation::StreetDrive;

const double ROLL = 1.2 * degree, PITCH = -0.8 * degree, HEADING = 1.5 * degree; // of the true mount

//! The camera as known before: upright and looking ahead, and a line delay.
RollingShutterCamera guess(int scan = SCAN_TOP_TO_BOTTOM)
{
    RollingShutterCamera camera(Size(960, 540), Matx33d(700, 0, 470, 0, 720, 280, 0, 0, 1));
    camera.scanDirection = scan;
    camera.lineDelay = 0.025 / 540;
    camera.height = 1.4;
    return camera;
}

RollingShutterCamera mounted(double delayRatio, int scan = SCAN_TOP_TO_BOTTOM)
{
    RollingShutterCamera camera = guess(scan);
    camera.heading = HEADING;
    camera.lineDelay *= delayRatio;
    return camera;
}

MotionPrior logOf(const StreetDrive::Frame& frame, RNG& rng)
{
    MotionPrior prior;
    prior.yawRateSigma = 0.5 * degree;
    prior.yawRate = frame.yawRate + rng.gaussian(prior.yawRateSigma);
    prior.speedSigma = 0.3;
    prior.speed = frame.speed + rng.gaussian(prior.speedSigma);
    return prior;
}

//! Adds frames of a drive; @return how many are used.
int drive(MountCalibrator& calibrator, StreetDrive street, int frames, bool isLogged, int seed = 0)
{
    RNG rng(seed);
    int used = 0;
    for (int i = 0; i < frames; i++)
    {
        const StreetDrive::Frame f = street.frame(i / 30., 1 / 30.);
        used += calibrator.addPoints(f.points, f.segments, f.seconds, isLogged ? logOf(f, rng) : MotionPrior());
    }
    return used;
}

//! Everything is shown, and found.
void expectNear(const RollingShutterCamera& truth, const MountCalibration& c, int i)
{
    EXPECT_TRUE(c.rollObserved && c.pitchObserved && c.headingObserved && c.lineDelayObserved) << i;
    EXPECT_NEAR(ROLL / degree, c.roll / degree, 0.05) << i;
    EXPECT_NEAR(PITCH / degree, c.pitch / degree, 0.05) << i;
    EXPECT_NEAR(HEADING / degree, c.heading / degree, 0.05) << i;
    EXPECT_NEAR(1, c.lineDelay / truth.lineDelay, 0.03) << i;
}

typedef testing::TestWithParam<int> CalibrationScans;

TEST_P(CalibrationScans, mount_and_line_delay_are_found)
{
    applyTestTag(CV_TEST_TAG_LONG);
    const bool logged[] = {true, false};
    for (int l = 0; l < 2; l++)
        for (int i = 0; i < 3; i++)
        {
            const RollingShutterCamera truth = mounted(i % 2 ? 1.3 : 0.7, GetParam());
            const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess(GetParam()));
            EXPECT_GT(drive(*calibrator, StreetDrive(truth, ROLL, PITCH, StreetDrive::Options(), i), 300, logged[l]),
                      250);
            expectNear(truth, calibrator->calibrate(), i);
        }
}

INSTANTIATE_TEST_CASE_P(RSAckermann_Calibration, CalibrationScans,
                        testing::Values(int(SCAN_TOP_TO_BOTTOM), int(SCAN_BOTTOM_TO_TOP)));

//! Drives that have logs.
void expectFound(const StreetDrive::Options& options, int drives, int seed)
{
    for (int i = 0; i < drives; i++)
    {
        const RollingShutterCamera truth = mounted(i % 2 ? 1.3 : 0.7);
        const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess());
        drive(*calibrator, StreetDrive(truth, ROLL, PITCH, options, seed + i), 300, true, i);
        expectNear(truth, calibrator->calibrate(), i);
    }
}

// What a wrong focal length does to mount and line delay is in their standard deviations.
TEST(RSAckermann_Calibration, focal_length_that_is_not_exact)
{
    applyTestTag(CV_TEST_TAG_LONG);
    const double wrong[] = {0.9, 1.07};
    for (int i = 0; i < 2; i++)
    {
        SCOPED_TRACE(i);
        const RollingShutterCamera truth = mounted(1);
        RollingShutterCamera approximate = guess();
        approximate.cameraMatrix(0, 0) *= wrong[i];
        approximate.cameraMatrix(1, 1) *= wrong[i];
        const auto calibrate = [&](double focalSigma) {
            approximate.focalSigma = focalSigma;
            const Ptr<MountCalibrator> calibrator = MountCalibrator::create(approximate);
            drive(*calibrator, StreetDrive(truth, ROLL, PITCH, StreetDrive::Options(), 50 + i), 120, true, i);
            return calibrator->calibrate();
        };
        const MountCalibration exact = calibrate(0), c = calibrate(0.07 * approximate.cameraMatrix(0, 0));
        RecordProperty(format("drive_%d", i),
                       format("line delay %.3f +- %.3f (%.3f), pitch %.3f +- %.3f (%.3f), heading %.3f +- %.3f (%.3f)",
                              c.lineDelay / truth.lineDelay, c.lineDelaySigma / truth.lineDelay,
                              exact.lineDelaySigma / truth.lineDelay, c.pitch / degree, c.pitchSigma / degree,
                              exact.pitchSigma / degree, c.heading / degree, c.headingSigma / degree,
                              exact.headingSigma / degree));
        ASSERT_TRUE(c.lineDelayObserved);
        EXPECT_EQ(approximate.cameraMatrix, c.camera.cameraMatrix);
        EXPECT_DOUBLE_EQ(approximate.focalSigma, c.camera.focalSigma);
        EXPECT_EQ(exact.lineDelay, c.lineDelay);
        EXPECT_NEAR(truth.lineDelay, c.lineDelay, 2 * c.lineDelaySigma);
        EXPECT_NEAR(ROLL, c.roll, 2 * c.rollSigma);
        EXPECT_NEAR(PITCH, c.pitch, 2 * c.pitchSigma);
        EXPECT_NEAR(HEADING, c.heading, 2 * c.headingSigma);
        EXPECT_GT(c.lineDelaySigma, 1.5 * exact.lineDelaySigma);
    }
}

TEST(RSAckermann_Calibration, scene_is_uneven)
{
    applyTestTag(CV_TEST_TAG_LONG);
    StreetDrive::Options options;
    options.unevenness = 0.03;
    expectFound(options, 4, 20);
}

// In a bend to one side a camera at the windscreen moves as one that looks elsewhere: less is known of its heading.
TEST(RSAckermann_Calibration, camera_ahead_of_the_axle)
{
    const RollingShutterCamera truth = mounted(1);
    for (const double bend : {-0.2, 0.2})
        for (const double lever : {0., 1.2})
        {
            StreetDrive::Options options;
            options.bend = bend;
            options.yawRate = 0.03;
            options.lever = lever;
            const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess());
            drive(*calibrator, StreetDrive(truth, ROLL, PITCH, options, 60), 100, true);
            const MountCalibration c = calibrator->calibrate();
            SCOPED_TRACE(testing::Message() << bend << " " << lever);
            EXPECT_NEAR(HEADING, c.heading, 2 * c.headingSigma);
            EXPECT_GT(c.headingSigma, 0.3 * degree);
            EXPECT_NEAR(PITCH, c.pitch, 3 * c.pitchSigma);
        }
    // Bends to both sides tell them apart.
    StreetDrive::Options options;
    options.lever = 1.2;
    expectFound(options, 2, 71);
}

// Points show means between frames, what is given is of their instants: in bends that begin they differ.
TEST(RSAckermann_Calibration, exact_values_of_instants_are_not_contradicted)
{
    StreetDrive::Options options;
    options.yawRate = 20 * degree;
    const double interval = 1 / 15.;
    int contradicted = 0, used = 0;
    for (int seed = 0; seed < 3; seed++)
    {
        StreetDrive street(mounted(1), ROLL, PITCH, options, 80 + seed);
        const Ptr<MountCalibrator> calibrator = MountCalibrator::create(mounted(1));
        for (int i = 0; i < 60; i++)
        {
            const StreetDrive::Frame f = street.frame(i * interval, interval);
            MotionPrior prior;
            prior.yawRate = f.yawRate;
            prior.speed = f.speed;
            prior.yawRateSigma = 0.1 * degree;
            prior.speedSigma = 0.1;
            used += calibrator->addPoints(f.points, f.segments, f.seconds, prior);
        }
        const MountCalibration c = calibrator->calibrate();
        contradicted += c.contradictedFrames;
        EXPECT_NEAR(HEADING, c.heading, 3 * c.headingSigma) << seed;
        EXPECT_NEAR(1, c.lineDelay / mounted(1).lineDelay, 0.03) << seed;
    }
    EXPECT_LT(contradicted, 0.03 * used);
}

TEST(RSAckermann_Calibration, points_at_the_feet_of_walls)
{
    StreetDrive::Options options;
    options.feet = 40;
    expectFound(options, 2, 31);
}

TEST(RSAckermann_Calibration, mount_is_the_mean_of_the_drive)
{
    const int frames = 120, drives = 8;
    double squares[2] = {0};
    StreetDrive::Options options;
    options.tilt = 0.5 * degree;
    for (int i = 0; i < drives; i++)
    {
        const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess());
        StreetDrive street(mounted(1.2), ROLL, PITCH, options, 40 + i);
        double roll = 0, pitch = 0;
        for (int k = 0; k < frames; k++)
        {
            const StreetDrive::Frame f = street.frame(k / 30., 1 / 30.);
            calibrator->addPoints(f.points, f.segments, f.seconds);
            roll += f.roll / frames;
            pitch += f.pitch / frames;
        }
        const MountCalibration c = calibrator->calibrate();
        squares[0] += (c.roll - roll) * (c.roll - roll) / drives;
        squares[1] += (c.pitch - pitch) * (c.pitch - pitch) / drives;
    }
    for (double square : squares)
        EXPECT_LT(std::sqrt(square), 0.016 * degree);
}

// That of a straight drive isn't known, and the pitch that is found follows it.
TEST(RSAckermann_Calibration, sigma_of_the_pitch_has_that_of_the_line_delay)
{
    StreetDrive::Options options;
    options.yawRate = options.tilt = 0;
    const RollingShutterCamera truth = mounted(1.2);
    RollingShutterCamera given = guess();
    given.lineDelay = truth.lineDelay;
    given.lineDelaySigma = 0.001 * given.lineDelay;
    double squares[2] = {0};
    for (int i = 0; i < 6; i++)
    {
        MountCalibration found[2];
        for (int k = 0; k < 2; k++)
        {
            const Ptr<MountCalibrator> calibrator = MountCalibrator::create(k ? given : guess());
            drive(*calibrator, StreetDrive(truth, ROLL, PITCH, options, i), 60, false);
            found[k] = calibrator->calibrate();
            squares[k] += found[k].pitchSigma * found[k].pitchSigma;
        }
        EXPECT_NEAR(found[1].pitch, found[0].pitch, 2 * found[0].pitchSigma) << i;
    }
    EXPECT_GT(std::sqrt(squares[0] / squares[1]), 1.4);
}

TEST(RSAckermann_Calibration, few_frames)
{
    const double known = MountCalibrator::Params().tiltSigma, sway = MountCalibrator::Params().suspensionSigma;
    for (int frames = 1; frames <= 12; frames++)
    {
        const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess());
        ASSERT_EQ(frames - 1,
                  drive(*calibrator, StreetDrive(mounted(1), ROLL, PITCH, StreetDrive::Options(), 8), frames, true));
        const MountCalibration c = calibrator->calibrate();
        EXPECT_EQ(frames - 1, c.frames);
        if (c.frames < 5)
        {
            EXPECT_FALSE(c.rollObserved || c.pitchObserved || c.headingObserved || c.lineDelayObserved) << frames;
            EXPECT_NEAR(0, c.roll, 1e-12);
            EXPECT_NEAR(known, c.rollSigma, 1e-12);
            continue;
        }
        EXPECT_NEAR(ROLL, c.roll, 2 * c.rollSigma) << frames;
        EXPECT_NEAR(PITCH, c.pitch, 2 * c.pitchSigma) << frames;
        EXPECT_NEAR(HEADING, c.heading, 2 * c.headingSigma) << frames;
        EXPECT_GT(c.rollSigma, 0.1 * sway) << frames;
        EXPECT_LT(c.rollSigma, known) << frames;
        EXPECT_NEAR(guess().lineDelay, c.lineDelay, 2 * c.lineDelaySigma) << frames;
        if (c.lineDelayObserved)
        {
            EXPECT_LT(c.lineDelaySigma, 0.5 * 0.3 * c.lineDelay) << frames;
        }
    }
}

// Whether a frame shows its own pitch or is thought to have that of the mount, the same points tell it, and err.
TEST(RSAckermann_Calibration, sigma_of_the_pitch_does_not_depend_on_the_suspension)
{
    StreetDrive::Options options;
    options.tilt = 0;
    options.points = 40;
    options.segments = 10;
    options.endNoise = 2;
    options.noise = 1;
    double squares[2] = {0};
    const double suspension[] = {0.001 * degree, 0.1 * degree}; // of the latter frames follow the mount by two thirds
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++)
        {
            MountCalibrator::Params params;
            params.suspensionSigma = suspension[k];
            const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess(), params);
            drive(*calibrator, StreetDrive(mounted(1), ROLL, PITCH, options, i), 150, true);
            const double sigma = calibrator->calibrate().pitchSigma;
            squares[k] += sigma * sigma;
        }
    EXPECT_NEAR(1, std::sqrt(squares[1] / squares[0]), 0.2);
}

TEST(RSAckermann_Calibration, sigmas_cover_the_errors)
{
    applyTestTag(CV_TEST_TAG_LONG);
    int within = 0;
    const int drives = 20, values = 4;
    double errorSum[values] = {0}, sigmaSum[values] = {0}; // of squares
    for (int i = 0; i < drives; i++)
    {
        const RollingShutterCamera truth = mounted(i % 2 ? 1.2 : 0.8);
        const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess());
        StreetDrive::Options options;
        options.points = 100;
        options.segments = 25;
        options.sway = simulation::onSprings;
        drive(*calibrator, StreetDrive(truth, ROLL, PITCH, options, 100 + i), 90, true, i);
        const MountCalibration c = calibrator->calibrate();
        const double errors[] = {c.roll - ROLL, c.pitch - PITCH, c.heading - HEADING, c.lineDelay - truth.lineDelay};
        const double sigmas[] = {c.rollSigma, c.pitchSigma, c.headingSigma, c.lineDelaySigma};
        for (int k = 0; k < values; k++)
        {
            within += std::abs(errors[k]) <= 2 * sigmas[k];
            errorSum[k] += errors[k] * errors[k];
            sigmaSum[k] += sigmas[k] * sigmas[k];
        }
    }
    EXPECT_GE(within, 0.9 * drives * values);
    // Over 100 drives the angles' sigmas are 3 times their errors, since 3 s tell little of what wanders slowly, and
    // those of the line delay 1.5 times.
    const double most[values] = {4.5, 4.5, 4.5, 2.3};
    for (int k = 0; k < values; k++)
        EXPECT_LT(std::sqrt(sigmaSum[k] / errorSum[k]), most[k]) << "value " << k;
}

//! Adds a drive that is seen twice, with times that begin again after some seconds.
MountCalibration calibrateTwice(double later)
{
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess());
    StreetDrive::Options options;
    options.points = 100;
    options.segments = 25;
    for (int pass = 0; pass < 2; pass++)
    {
        StreetDrive street(mounted(1.2), ROLL, PITCH, options, pass);
        for (int i = 0; i < 60; i++)
        {
            const StreetDrive::Frame f = street.frame(i / 30., 1 / 30.);
            calibrator->addPoints(i > 0 ? f.points : Mat(), f.segments, f.seconds + pass * later);
        }
    }
    return calibrator->calibrate();
}

TEST(RSAckermann_Calibration, another_drive_may_have_the_same_times)
{
    const MountCalibration far = calibrateTwice(1000);
    // The second drive begins at the last frame of the first one and within it.
    for (const double later : {0., 58 / 30., 59 / 30. - 1e-5, 59 / 30., 0.5, -1.})
    {
        const MountCalibration c = calibrateTwice(later);
        EXPECT_TRUE(c.rollObserved && c.pitchObserved && c.headingObserved) << later;
        EXPECT_NEAR(far.roll, c.roll, 1e-3 * degree) << later;
        EXPECT_NEAR(far.pitch, c.pitch, 1e-3 * degree) << later;
        EXPECT_NEAR(far.rollSigma, c.rollSigma, 0.1 * far.rollSigma) << later;
    }
}

TEST(RSAckermann_Calibration, told_sigma_of_the_line_delay_counts)
{
    RollingShutterCamera camera = guess();
    camera.lineDelay *= 1.2;
    camera.lineDelaySigma = 0.001 * camera.lineDelay;
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(camera);
    drive(*calibrator, StreetDrive(mounted(1.2), ROLL, PITCH, StreetDrive::Options(), 3), 90, true);
    const MountCalibration kept = calibrator->calibrate();
    EXPECT_FALSE(kept.lineDelayObserved);
    EXPECT_EQ(camera.lineDelay, kept.lineDelay);
    EXPECT_NEAR(camera.lineDelaySigma, kept.lineDelaySigma, 1e-9 * camera.lineDelaySigma);
    EXPECT_EQ(camera.lineDelaySigma, kept.camera.lineDelaySigma);

    camera.lineDelaySigma = 0;
    calibrator->setCamera(camera);
    drive(*calibrator, StreetDrive(mounted(1.2), ROLL, PITCH, StreetDrive::Options(), 3), 90, true);
    const MountCalibration found = calibrator->calibrate();
    EXPECT_TRUE(found.lineDelayObserved);
    EXPECT_GT(found.lineDelaySigma, 0);
    EXPECT_EQ(found.lineDelaySigma, found.camera.lineDelaySigma);
}

TEST(RSAckermann_Calibration, straight_drive_does_not_tell_the_line_delay)
{
    StreetDrive::Options options;
    options.yawRate = 0;
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess());
    drive(*calibrator, StreetDrive(mounted(0.7), ROLL, PITCH, options, 1), 150, true);
    const MountCalibration c = calibrator->calibrate();
    EXPECT_FALSE(c.lineDelayObserved);
    EXPECT_EQ(guess().lineDelay, c.lineDelay);
    EXPECT_NEAR(0.3 * c.lineDelay, c.lineDelaySigma, 1e-9);
    EXPECT_TRUE(c.rollObserved && c.pitchObserved && c.headingObserved);
    EXPECT_NEAR(ROLL, c.roll, 0.15 * degree);
    EXPECT_NEAR(HEADING, c.heading, 0.2 * degree);
}

// What the drive doesn't show of the line delay is as uncertain as before: as the camera says, or the parameters.
TEST(RSAckermann_Calibration, sigma_of_a_line_delay_that_is_not_observed)
{
    StreetDrive::Options options;
    options.yawRate = 0;
    for (const double told : {0., 2e-6})
    {
        SCOPED_TRACE(told);
        RollingShutterCamera camera = guess();
        camera.lineDelaySigma = told;
        MountCalibrator::Params params;
        params.lineDelaySigma = 0.2;
        const Ptr<MountCalibrator> calibrator = MountCalibrator::create(camera, params);
        drive(*calibrator, StreetDrive(mounted(0.9), ROLL, PITCH, options, 1), 20, true);
        const MountCalibration c = calibrator->calibrate();
        EXPECT_GT(c.frames, 10);
        EXPECT_FALSE(c.lineDelayObserved);
        EXPECT_EQ(camera.lineDelay, c.lineDelay);
        EXPECT_NEAR(told > 0 ? told : 0.2 * c.lineDelay, c.lineDelaySigma, 1e-12);
        EXPECT_EQ(told, c.camera.lineDelaySigma);
    }
}

// The mount's angles go with the line delay that is kept, and are as uncertain as the difference to that of the best
// fit.
TEST(RSAckermann_Calibration, angles_go_with_a_line_delay_that_is_not_observed)
{
    StreetDrive::Options options;
    options.yawRate = 0;
    RollingShutterCamera camera = guess();
    camera.lineDelay *= 1.2;
    MountCalibration results[2];
    for (int exact = 0; exact < 2; exact++)
    {
        if (exact)
            camera.lineDelaySigma = 1e-6 * camera.lineDelay;
        const Ptr<MountCalibrator> calibrator = MountCalibrator::create(camera);
        drive(*calibrator, StreetDrive(mounted(0.7), ROLL, PITCH, options, 1), 60, true);
        results[exact] = calibrator->calibrate();
        EXPECT_FALSE(results[exact].lineDelayObserved) << exact;
    }
    const MountCalibration &c = results[0], &known = results[1];
    EXPECT_NEAR(known.roll, c.roll, 0.01 * degree);
    EXPECT_NEAR(known.pitch, c.pitch, 0.01 * degree);
    EXPECT_GT(c.pitchSigma, known.pitchSigma);
    EXPECT_NEAR(PITCH, c.pitch, 2 * c.pitchSigma);
}

// What is seen of the car itself stands still.
TEST(RSAckermann_Calibration, own_bonnet_is_left_out)
{
    const RollingShutterCamera truth = mounted(1.2);
    StreetDrive street(truth, ROLL, PITCH, StreetDrive::Options(), 3);
    const Ptr<MountCalibrator> calibrators[] = {MountCalibrator::create(guess()), MountCalibrator::create(guess())};
    RNG rng(4);
    for (int i = 0; i < 100; i++)
    {
        const StreetDrive::Frame f = street.frame(i / 30., 1 / 30.);
        const MotionPrior log = logOf(f, rng);
        Mat points = f.points.clone();
        for (int k = 0; k < 80; k++)
        {
            const Point2d own = uniformPoint(rng, Point2d(200, 450), Point2d(760, 539)),
                          before = own + gaussianPoint(rng, 0.1);
            if (before.y < 539)
                points.push_back(Mat(Matx14d(before.x, before.y, own.x, own.y)));
        }
        calibrators[0]->addPoints(f.points, f.segments, f.seconds, log);
        EXPECT_EQ(i > 0, calibrators[1]->addPoints(points, f.segments, f.seconds, log)) << i;
    }
    const MountCalibration without = calibrators[0]->calibrate(), with = calibrators[1]->calibrate();
    EXPECT_NEAR(without.roll, with.roll, 0.02 * degree);
    EXPECT_NEAR(without.pitch, with.pitch, 0.02 * degree);
    EXPECT_NEAR(without.heading, with.heading, 0.02 * degree);
    EXPECT_NEAR(without.lineDelay, with.lineDelay, 0.005 * with.lineDelay);
}

TEST(RSAckermann_Calibration, unknown_line_delay)
{
    RollingShutterCamera camera = guess();
    camera.lineDelay = 0;
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(camera);
    EXPECT_EQ(0, calibrator->calibrate().lineDelay);
    const RollingShutterCamera truth = mounted(0.9);
    drive(*calibrator, StreetDrive(truth, ROLL, PITCH, StreetDrive::Options(), 2), 200, true);
    const MountCalibration c = calibrator->calibrate();
    EXPECT_TRUE(c.lineDelayObserved);
    EXPECT_NEAR(truth.lineDelay, c.lineDelay, 0.05 * truth.lineDelay);
    EXPECT_EQ(c.lineDelay, c.camera.lineDelay);
}

TEST(RSAckermann_Calibration, frames_are_kept_evenly)
{
    MountCalibrator::Params params;
    params.maxFrames = 100;
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess(), params);
    StreetDrive::Options options;
    options.points = 80;
    options.segments = 25;
    const int used = drive(*calibrator, StreetDrive(mounted(1), ROLL, PITCH, options, 3), 300, true), run = 10;
    EXPECT_GT(used, 250);
    int kept = used;
    for (int stride = 2; kept > params.maxFrames; stride *= 2)
    {
        kept = 0;
        for (int i = 0; i < used; i++)
            kept += i / run % stride == 0;
    }
    const MountCalibration c = calibrator->calibrate();
    EXPECT_EQ(kept, c.frames);
    EXPECT_NEAR(ROLL, c.roll, 0.2 * degree);
    EXPECT_NEAR(HEADING, c.heading, 0.2 * degree);
    // A drive that begins anew is a short one.
    calibrator->clear();
    const int added = drive(*calibrator, StreetDrive(mounted(1), ROLL, PITCH, options, 3), 30, true);
    EXPECT_EQ(added, calibrator->calibrate().frames);
}

// Of a log whose signs are wrong, and of whatever comes after it.
TEST(RSAckermann_Calibration, contrary_and_contradicted_frames_are_those_of_the_drive)
{
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess());
    const auto add = [&](int sign) {
        StreetDrive street(mounted(1), ROLL, PITCH, StreetDrive::Options(), 2);
        RNG rng(1);
        for (int i = 0; i < 40; i++)
        {
            const StreetDrive::Frame f = street.frame(i / 30., 1 / 30.);
            MotionPrior log = logOf(f, rng);
            log.speed *= sign;
            calibrator->addPoints(f.points, f.segments, f.seconds, log);
        }
        return calibrator->calibrate();
    };
    const std::function<void()> beginnings[] = {[&] { calibrator->clear(); },
                                                [&] { calibrator->setParams(calibrator->getParams()); }};
    const MountCalibration expected = add(1);
    EXPECT_EQ(0, expected.contraryFrames);
    for (const std::function<void()>& begin : beginnings)
    {
        begin();
        const MountCalibration wrong = add(-1);
        EXPECT_GT(wrong.contraryFrames, 20);
        EXPECT_GT(wrong.contradictedFrames, 20);
        begin();
        const MountCalibration right = add(1);
        EXPECT_EQ(0, right.contraryFrames);
        EXPECT_EQ(expected.contradictedFrames, right.contradictedFrames);
    }
}

// Azimuths are counted from the optical axis, whichever way it points.
TEST(RSAckermann_Calibration, heading_of_a_camera_that_leans)
{
    const double roll = 6 * degree, pitch = -7 * degree;
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess());
    drive(*calibrator, StreetDrive(mounted(1), roll, pitch, StreetDrive::Options(), 2), 200, true);
    const MountCalibration c = calibrator->calibrate();
    EXPECT_NEAR(roll / degree, c.roll / degree, 0.15);
    EXPECT_NEAR(pitch / degree, c.pitch / degree, 0.15);
    EXPECT_NEAR(HEADING / degree, c.heading / degree, 0.15);
    EXPECT_EQ(c.heading, c.camera.heading);
}

// What a focal length that isn't exact changes is part of the standard deviations.
TEST(RSAckermann_Calibration, sigmas_have_that_of_the_focal_length)
{
    MountCalibration found[2];
    for (int i = 0; i < 2; i++)
    {
        RollingShutterCamera camera = guess();
        camera.focalSigma = i * 0.05 * camera.cameraMatrix(0, 0);
        const Ptr<MountCalibrator> calibrator = MountCalibrator::create(camera);
        drive(*calibrator, StreetDrive(mounted(1), ROLL, PITCH, StreetDrive::Options(), 2), 100, true);
        found[i] = calibrator->calibrate();
    }
    EXPECT_GT(found[1].pitchSigma, 1.03 * found[0].pitchSigma);
    EXPECT_GT(found[1].lineDelaySigma, 1.2 * found[0].lineDelaySigma);
}

// So is what is not known of the times, while the line delay is still observed.
TEST(RSAckermann_Calibration, sigma_of_the_line_delay_has_that_of_the_times)
{
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess());
    StreetDrive street(mounted(1), ROLL, PITCH, StreetDrive::Options(), 2);
    RNG rng(3);
    for (int i = 0; i < 200; i++)
    {
        const StreetDrive::Frame f = street.frame(i / 30., 1 / 30.);
        calibrator->addPoints(f.points, f.segments, f.seconds + rng.gaussian(0.0015), logOf(f, rng));
    }
    const MountCalibration c = calibrator->calibrate();
    EXPECT_TRUE(c.lineDelayObserved);
    EXPECT_GT(c.intervalSigma, 0.04);
    EXPECT_GT(c.lineDelaySigma, c.intervalSigma * c.lineDelay);
}

TEST(RSAckermann_Calibration, nothing_moves)
{
    const RollingShutterCamera camera = exampleCamera();
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(camera);
    RNG rng(4);
    for (int i = 0; i < 5; i++)
    {
        Mat points(200, 4, CV_64F);
        for (int k = 0; k < points.rows; k++)
        {
            const Point2d p = uniformPoint(rng, Point2d(0, 0), Point2d(640, 382)), q = p + gaussianPoint(rng, 0.2);
            *points.ptr<Vec4d>(k) = Vec4d(p.x, p.y, q.x, q.y);
        }
        EXPECT_FALSE(calibrator->addPoints(points, noArray(), i / 30.));
    }
    const MountCalibration c = calibrator->calibrate();
    EXPECT_EQ(0, c.frames);
    EXPECT_FALSE(c.rollObserved || c.pitchObserved || c.headingObserved || c.lineDelayObserved);
    EXPECT_LT(cv::norm(camera.uprightRotation - c.camera.uprightRotation), 1e-9);
    EXPECT_NEAR(0.1, c.roll, 1e-9);
    EXPECT_NEAR(-0.2, c.pitch, 1e-9);
    EXPECT_NEAR(camera.heading, c.heading, 1e-12);
    EXPECT_EQ(camera.lineDelay, c.lineDelay);
}

TEST(RSAckermann_Calibration, only_frames_that_follow_are_used)
{
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess());
    StreetDrive street(mounted(1), ROLL, PITCH, StreetDrive::Options(), 5);
    const StreetDrive::Frame f = street.frame(0, 1 / 30.);
    EXPECT_FALSE(calibrator->addPoints(f.points, f.segments, 10)); // the first one
    EXPECT_TRUE(calibrator->addPoints(f.points, f.segments, 10 + 1 / 30.));
    EXPECT_FALSE(calibrator->addPoints(f.points, f.segments, 20));            // after a gap
    EXPECT_FALSE(calibrator->addPoints(f.points, f.segments, 19));            // of another drive
    EXPECT_FALSE(calibrator->addPoints(noArray(), f.segments, 19 + 1 / 30.)); // nothing tracked
    EXPECT_EQ(1, calibrator->calibrate().frames);
    EXPECT_FALSE(calibrator->calibrate().rollObserved);
    calibrator->clear();
    EXPECT_EQ(0, calibrator->calibrate().frames);
    EXPECT_FALSE(calibrator->addPoints(f.points, f.segments, 10 + 2 / 30.));
}

// Of a texture at infinity, of a camera that has turned.
Mat turnedTexture(const RollingShutterCamera& camera, double yaw)
{
    Mat noise(camera.imageSize, CV_8U), texture, turned;
    RNG rng(3);
    rng.fill(noise, RNG::UNIFORM, 0, 256);
    GaussianBlur(noise, texture, Size(), 3);
    normalize(texture, texture, 0, 255, NORM_MINMAX);
    const Matx33d R(std::cos(yaw), 0, std::sin(yaw), 0, 1, 0, -std::sin(yaw), 0, std::cos(yaw));
    warpPerspective(texture, turned, camera.cameraMatrix * R * camera.cameraMatrix.inv(), camera.imageSize);
    return turned;
}

// The frame before it is too long ago for the interval to the damaged one.
TEST(RSAckermann_Calibration, frame_after_a_damaged_one_is_left_out)
{
    const RollingShutterCamera camera = guess();
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(camera);
    for (int i = 0; i < 6; i++)
    {
        const bool isDamaged = i == 2;
        const Mat image = isDamaged ? Mat(camera.imageSize, CV_8U, Scalar(90)) : turnedTexture(camera, i * degree);
        EXPECT_EQ(i == 1 || i > 3, calibrator->addFrame(image, i / 30.)) << i;
    }
}

TEST(RSAckermann_Calibration, image_before_tracked_points_is_not_the_one_before)
{
    const RollingShutterCamera camera = guess();
    const Mat texture = turnedTexture(camera, 0), turned = turnedTexture(camera, 1 * degree);
    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(camera);
    EXPECT_FALSE(calibrator->addFrame(texture, 0));
    EXPECT_TRUE(calibrator->addFrame(turned, 1 / 30.));
    calibrator->clear();
    EXPECT_FALSE(calibrator->addFrame(texture, 0));
    EXPECT_FALSE(calibrator->addPoints(noArray(), noArray(), 1 / 30.));
    EXPECT_FALSE(calibrator->addFrame(turned, 2 / 30.));
}

TEST(RSAckermann_Calibration, horizon_is_at_infinity)
{
    MountCalibration c;
    c.camera = guess();
    c.camera.setRollPitch(ROLL, PITCH);
    const Vec3d horizon = c.horizon();
    const simulation::Simulator simulator(c.camera, simulation::Drive(), simulation::Street());
    for (double azimuth = -0.5; azimuth < 0.6; azimuth += 0.25)
    {
        Point2d pixel;
        ASSERT_TRUE(simulator.pixelOf(Vec3d(std::sin(azimuth), 0, std::cos(azimuth)), pixel));
        EXPECT_NEAR(0, horizon.dot(Vec3d(pixel.x, pixel.y, 1)), 1e-9);
        ASSERT_TRUE(simulator.pixelOf(Vec3d(std::sin(azimuth), 0.1, std::cos(azimuth)), pixel));
        EXPECT_GT(horizon.dot(Vec3d(pixel.x, pixel.y, 1)), 10);
    }
}

TEST(RSAckermann_Calibration, bad_arguments)
{
    RollingShutterCamera columns = guess();
    columns.scanDirection = SCAN_LEFT_TO_RIGHT;
    EXPECT_THROW(MountCalibrator::create(columns), cv::Exception);
    EXPECT_THROW(MountCalibrator::create(RollingShutterCamera()), cv::Exception);
    double MountCalibrator::Params::*const fields[] = {
        &MountCalibrator::Params::tiltSigma, &MountCalibrator::Params::headingSigma,
        &MountCalibrator::Params::lineDelaySigma, &MountCalibrator::Params::suspensionSigma,
        &MountCalibrator::Params::suspensionTime};
    const double bad[] = {0, -1, NaN, infinity};
    for (size_t f = 0; f < 5; f++)
        for (size_t v = 0; v < 4; v++)
        {
            MountCalibrator::Params params;
            params.*fields[f] = bad[v];
            EXPECT_THROW(MountCalibrator::create(guess(), params), cv::Exception) << f << " " << bad[v];
        }
    MountCalibrator::Params params;
    params.maxFrames = 99;
    EXPECT_THROW(MountCalibrator::create(guess(), params), cv::Exception);
    params = MountCalibrator::Params();
    params.estimator.minLength = -1;
    EXPECT_THROW(MountCalibrator::create(guess(), params), cv::Exception);

    const Ptr<MountCalibrator> calibrator = MountCalibrator::create(guess());
    const Mat points(5, 4, CV_64F, Scalar(10)), image(540, 960, CV_8U, Scalar(0));
    EXPECT_THROW(calibrator->addPoints(Mat(5, 3, CV_64F), noArray(), 0), cv::Exception);
    EXPECT_THROW(calibrator->addPoints(points, Mat(5, 4, CV_8U), 0), cv::Exception);
    EXPECT_THROW(calibrator->addPoints(points, noArray(), NaN), cv::Exception);
    EXPECT_THROW(calibrator->addFrame(image, infinity), cv::Exception);
    EXPECT_THROW(calibrator->addFrame(Mat(540, 959, CV_8U), 0), cv::Exception);
    MotionPrior prior;
    prior.speedSigma = -1;
    EXPECT_THROW(calibrator->addPoints(points, noArray(), 0, prior), cv::Exception);
    EXPECT_FALSE(calibrator->addFrame(image, 0));
}

// From other starts a wrong line delay is found, or none; one with a standard deviation is no start.
TEST(RSAckermann_Calibration, line_delays_to_start_from)
{
    RollingShutterCamera camera = guess();
    for (const double readOut : {0., 0.002, 0.1})
    {
        camera.lineDelay = readOut / camera.imageSize.height;
        EXPECT_NO_THROW(MountCalibrator::create(camera)) << readOut;
    }
    for (const double readOut : {0.0019, 0.101})
    {
        camera.lineDelay = readOut / camera.imageSize.height;
        try
        {
            MountCalibrator::create(camera);
            ADD_FAILURE() << readOut;
        }
        catch (const cv::Exception& e)
        {
            EXPECT_NE(String::npos, e.err.find("camera.lineDelay is")) << e.err;
            EXPECT_NE(String::npos, e.err.find("from 0.002 to 0.1 s for all lines")) << e.err;
        }
        camera.lineDelaySigma = 0.01 * camera.lineDelay;
        EXPECT_NO_THROW(MountCalibrator::create(camera)) << readOut;
        camera.lineDelaySigma = 0;
    }
}

TEST(RSAckermann_Calibration, is_stored_and_loaded)
{
    MountCalibrator::Params params;
    params.estimator.minLength = 40;
    params.maxFrames = 333;
    params.tiltSigma = 0.01;
    params.headingSigma = 0.02;
    params.lineDelaySigma = 0.1;
    params.suspensionSigma = 0.003;
    params.suspensionTime = 2;
    const std::string path = cv::tempfile(".yml");
    MountCalibrator::create(exampleCamera(), params)->save(path);
    const Ptr<MountCalibrator> loaded = MountCalibrator::load(path);
    remove(path.c_str());
    expectSame(exampleCamera(), loaded->getCamera());
    const MountCalibrator::Params got = loaded->getParams();
    EXPECT_EQ(params.getEstimatorParams().minLength, got.getEstimatorParams().minLength);
    EXPECT_EQ(params.maxFrames, got.maxFrames);
    EXPECT_EQ(params.tiltSigma, got.tiltSigma);
    EXPECT_EQ(params.headingSigma, got.headingSigma);
    EXPECT_EQ(params.lineDelaySigma, got.lineDelaySigma);
    EXPECT_EQ(params.suspensionSigma, got.suspensionSigma);
    EXPECT_EQ(params.suspensionTime, got.suspensionTime);
}

}} // namespace
