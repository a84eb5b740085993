// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"

// What the estimator makes of segments if gravity is uncertain, as it is on real streets.

namespace opencv_test { namespace {

using simulation::Simulator;

//! A camera as cars have them: 2048 x 1024 pixels, read out in 38 ms.
RollingShutterCamera carCamera()
{
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(2048, 1024), 2260);
    camera.setRollPitch(0, 0);
    camera.lineDelay = 37.7e-6;
    camera.height = 1.3;
    return camera;
}

//! Segments of vertical lines all over the image of a camera at rest that lean by N(0, sigma).
Mat leaningSegments(const RollingShutterCamera& camera, int count, double sigma, RNG& rng)
{
    const double width = camera.imageSize.width, height = camera.imageSize.height;
    Mat segments(count, 4, CV_64F);
    for (int i = 0; i < count; i++)
    {
        const double length = rng.uniform(0.15, 0.4) * height, x = rng.uniform(0.1, 0.9) * width,
                     y = rng.uniform(0.02, 0.98) * (height - length);
        const double lean = length * std::tan(rng.gaussian(sigma));
        double* s = segments.ptr<double>(i);
        s[0] = x - lean / 2;
        s[1] = y;
        s[2] = x + lean / 2;
        s[3] = y + length;
    }
    return segments;
}

//! Lines on the walls of a street, seen by a camera at rest, none of which is upright: each leans along its wall, by up
//! to the slant.
Mat slantedSegments(const RollingShutterCamera& camera, int count, double slant, RNG& rng)
{
    Mat segments = leaningSegments(camera, count, 0, rng);
    for (int i = 0; i < count; i++)
    {
        double* s = segments.ptr<double>(i);
        // A line that moves away by the slant for each metre of its height moves towards the vanishing point by that
        // part of its column.
        const double column = (s[0] - camera.cameraMatrix(0, 2)) / camera.cameraMatrix(0, 0);
        const double shift = (rng.uniform(0, 2) ? 1 : -1) * rng.uniform(slant / 2, slant) * column * (s[3] - s[1]);
        s[0] -= shift / 2;
        s[2] += shift / 2;
    }
    return segments;
}

//! Segments on the walls of a street that lean by N(0, 0.3 degrees), and clutter.
Mat streetSegments(const Simulator& street, RNG& rng)
{
    simulation::SegmentOptions options;
    options.count = 80;
    options.inlierRatio = 0.8;
    options.noise = 0.3;
    options.minLength = 80;
    options.maxLength = 400;
    Mat segments;
    simulation::randomSegments(street, options, rng).ends.convertTo(segments, CV_64F);
    for (int i = 0; i < segments.rows; i++)
    {
        double* s = segments.ptr<double>(i);
        const double lean = std::tan(rng.gaussian(0.3 * degree)) * (s[3] - s[1]);
        s[0] -= lean / 2;
        s[2] += lean / 2;
    }
    return segments;
}

//! Mean distance of the maps of two motions where both have a place.
double mapDistance(const RollingShutterCamera& camera1, const AckermannMotion& motion1,
                   const RollingShutterCamera& camera2, const AckermannMotion& motion2)
{
    Mat x1, y1, x2, y2, mask1, mask2, distance;
    WarpMapGenerator::create(camera1)->initRectifyMap(motion1, x1, y1, CV_32FC1, mask1);
    WarpMapGenerator::create(camera2)->initRectifyMap(motion2, x2, y2, CV_32FC1, mask2);
    magnitude(x1 - x2, y1 - y2, distance);
    return mean(distance, mask1 & mask2)[0];
}

//! The same camera with an upright rotation that is off.
RollingShutterCamera tilted(RollingShutterCamera camera, double roll, double pitch)
{
    camera.setRollPitch(roll, pitch);
    return camera;
}

RollingShutterCamera tiltedAtRandom(RNG& rng)
{
    const double pitch = rng.gaussian(0.3 * degree), roll = rng.gaussian(1 * degree);
    return tilted(carCamera(), roll, pitch);
}

AckermannMotion estimate(const RollingShutterCamera& camera, const Mat& segments,
                         const MotionPrior& prior = MotionPrior(),
                         const AckermannEstimator::Params& params = AckermannEstimator::Params())
{
    return AckermannEstimator::create(camera, params)->estimate(segments, noArray(), prior);
}

TEST(RSAckermann_Posterior, lines_that_lean_are_no_motion)
{
    RNG rng(1);
    int moved = 0;
    for (int i = 0; i < 100; i++)
        moved += estimate(carCamera(), leaningSegments(carCamera(), 40, 1 * degree, rng)).status == MOTION_OK;
    RecordProperty("moved_percent", moved);
    EXPECT_LE(moved, 3);
}

TEST(RSAckermann_Posterior, walls_of_slanted_lines_are_no_motion)
{
    RNG rng(13);
    int moved = 0;
    for (int i = 0; i < 100; i++)
        moved += estimate(carCamera(), slantedSegments(carCamera(), 60, 0.4, rng)).status == MOTION_OK;
    RecordProperty("moved", moved);
    EXPECT_LE(moved, 3);
}

// It shows nothing of the motion: no reason to correct it, and none to expect that it needs no correction.
TEST(RSAckermann_Posterior, image_without_verticals_is_as_usual)
{
    RNG rng(5);
    const Mat segments = leaningSegments(carCamera(), 60, 25 * degree, rng);
    const auto expected = [&](double standing, double reverse) {
        AckermannEstimator::Params params;
        params.standingProbability = standing;
        params.reverseProbability = reverse;
        const AckermannMotion m = estimate(carCamera(), segments, MotionPrior(), params);
        EXPECT_EQ(MOTION_NOT_SIGNIFICANT, m.status);
        EXPECT_EQ(m.expectedRaw, m.expectedResidual);
        return m.expectedRaw;
    };
    const double usual = expected(0.5, 0.02);
    EXPECT_GT(usual, 1); // pixels
    EXPECT_NEAR(usual, expected(0.5, 0.5), 0.1 * usual);
    EXPECT_NEAR(0.4 * usual, expected(0.8, 0.02), 0.1 * usual);
}

// Some of many lines agree with some motion by chance: a scene in which most don't shows none.
// One that is asked for has all that rest leaves: a car that turns doesn't seem to stand more than among all motions.
TEST(RSAckermann_Posterior, requested_model_is_no_less_probable)
{
    RNG rng(17);
    double requested = 0, all = 0;
    for (int i = 0; i < 20; i++)
    {
        const RollingShutterCamera camera = tiltedAtRandom(rng);
        const Mat segments = streetSegments(Simulator::fromMetric(carCamera(), 10 * degree, 0, 5, 7, 0), rng);
        AckermannEstimator::Params params;
        all += estimate(camera, segments, MotionPrior(), params).expectedRaw;
        params.model = MODEL_1LA;
        requested += estimate(camera, segments, MotionPrior(), params).expectedRaw;
    }
    RecordProperty("share_of_all", requested / all);
    EXPECT_GT(requested, all);
}

TEST(RSAckermann_Posterior, few_lines_that_agree_are_no_motion)
{
    RNG rng(4);
    int moved = 0;
    for (int k = 0; k < 90; k++)
    {
        const Mat segments = leaningSegments(carCamera(), 30 * (1 + k % 3), 10 * degree, rng);
        moved += estimate(carCamera(), segments).status == MOTION_OK;
    }
    EXPECT_LE(moved, 1);
}

TEST(RSAckermann_Posterior, roll_that_is_not_told_is_no_motion)
{
    RNG rng(2);
    int moved = 0;
    for (int i = 0; i < 100; i++)
    {
        const RollingShutterCamera given = tiltedAtRandom(rng);
        moved += estimate(given, leaningSegments(carCamera(), 60, 0.3 * degree, rng)).status == MOTION_OK;
    }
    EXPECT_LE(moved, 5);
}

// However far an unknown mount is tilted, and whatever else leans.
TEST(RSAckermann_Posterior, mount_that_is_not_given_is_no_motion)
{
    RNG rng(3);
    RollingShutterCamera camera = carCamera();
    int moved = 0;
    for (int i = 0; i < 100; i++)
    {
        Mat segments = leaningSegments(camera, 30, 0.3 * degree, rng);
        segments.push_back(leaningSegments(camera, 15, 10 * degree, rng));
        camera.setRollPitch(rng.uniform(-5., 5.) * degree, rng.uniform(-12., 12.) * degree);
        camera.rollSigma = 2 * degree;
        camera.pitchSigma = 5 * degree;
        moved += estimate(camera, segments).status == MOTION_OK;
    }
    EXPECT_LE(moved, 10);
}

TEST(RSAckermann_Posterior, copies_of_a_segment_are_one_witness)
{
    const Mat one(Matx14d(1500, 300, 1512, 700));
    Mat copies;
    repeat(one, 6, 1, copies);
    EXPECT_NE(MOTION_OK, estimate(carCamera(), copies).status);
}

// What the verticals say is worth less than a gyro.
TEST(RSAckermann_Posterior, verticals_do_not_overrule_a_gyro)
{
    RNG rng(3);
    int beyond = 0;
    const int frames = 50;
    for (int i = 0; i < frames; i++)
    {
        const double yawRate = rng.uniform(-20., 20.) * degree, sigma = 1 * degree;
        const double right = rng.uniform(5., 12.), left = rng.uniform(5., 12.), speed = rng.uniform(5., 20.);
        const Simulator street = Simulator::fromMetric(carCamera(), yawRate, speed, left, right, 0);
        MotionPrior prior;
        prior.yawRate = yawRate + rng.gaussian(sigma);
        prior.yawRateSigma = sigma;
        const RollingShutterCamera given = tiltedAtRandom(rng);
        const AckermannMotion motion = estimate(given, streetSegments(street, rng), prior);
        double found = 0;
        if (motion.status == MOTION_OK && motion.yawRate(given, found))
            beyond += std::abs(found - yawRate) > 2.5 * sigma;
    }
    EXPECT_LE(beyond, 2);
}

TEST(RSAckermann_Posterior, speed_and_height_give_the_road)
{
    RNG rng(4);
    const double speed = 14;
    const Simulator street = Simulator::fromMetric(carCamera(), 0.05, speed, 6, 8, 0);
    MotionPrior prior;
    prior.speed = speed;
    prior.speedSigma = 0.5;
    const AckermannMotion motion = estimate(carCamera(), streetSegments(street, rng), prior);
    ASSERT_EQ(MOTION_OK, motion.status);
    const double G = speed * carCamera().secondsPerUnitTime() / carCamera().height;
    EXPECT_NEAR(G, motion.roadSlope, 0.02 * G);
    EXPECT_EQ(SCALE_SPEED, motion.scale);
    double found = 0;
    EXPECT_TRUE(motion.speed(carCamera(), found));
    EXPECT_NEAR(speed, found, 1e-9);
}

// Something that drives isn't known to metres if it is said to stand, however uncertain that is.
TEST(RSAckermann_Posterior, given_rest_gives_no_metres)
{
    RNG rng(4);
    const Simulator street = Simulator::fromMetric(carCamera(), 0.05, 14, 6, 8, 0);
    MotionPrior prior;
    prior.speedSigma = 30;
    const AckermannMotion motion = estimate(carCamera(), streetSegments(street, rng), prior);
    ASSERT_EQ(MOTION_OK, motion.status);
    EXPECT_EQ(SCALE_UNKNOWN, motion.scale);
    EXPECT_EQ(0, motion.wallDistance);
    EXPECT_EQ(0, motion.speedSigma);
}

TEST(RSAckermann_Posterior, a_guess_is_no_scale)
{
    RNG rng(5);
    const Simulator street = Simulator::fromMetric(carCamera(), 0.05, 14, 6, 8, 0);
    const AckermannMotion motion = estimate(carCamera(), streetSegments(street, rng));
    ASSERT_EQ(MOTION_OK, motion.status);
    EXPECT_GT(motion.roadSlope, 0); // the maps have a road
    EXPECT_EQ(SCALE_UNKNOWN, motion.scale);
    double found = 1;
    EXPECT_FALSE(motion.speed(carCamera(), found));
    EXPECT_EQ(0, found);
    Mat corrected;
    EXPECT_THROW(WarpMapGenerator::create(carCamera())
                     ->correctPoints(motion, Mat1d(Matx12d(300, 200)), corrected, Mat1d(1, 1, 10.)),
                 cv::Exception);
}

// Frames drawn from what is usual, with verticals that lean and gravity that is off: what the estimator expects is what
// happens.
TEST(RSAckermann_Posterior, improves_what_it_expects_to_improve)
{
    applyTestTag(CV_TEST_TAG_LONG);
    RNG rng(6);
    double raw = 0, left = 0, expectedRaw = 0, expectedResidual = 0;
    int ok = 0, worse = 0;
    const int frames = 100;
    for (int i = 0; i < frames; i++)
    {
        const double yawRate = rng.gaussian(4 * degree), speed = 12 * std::exp(rng.gaussian(0.5));
        const double walls[2] = {8 * std::exp(rng.gaussian(0.5)), 8 * std::exp(rng.gaussian(0.5))};
        const double direction = rng.gaussian(0.03);
        const Simulator street = Simulator::fromMetric(carCamera(), yawRate, speed, walls[0], walls[1], direction);
        const RollingShutterCamera given = tiltedAtRandom(rng);
        const AckermannMotion motion = estimate(given, streetSegments(street, rng));
        if (motion.status != MOTION_OK)
        {
            EXPECT_EQ(motion.expectedRaw, motion.expectedResidual);
            continue;
        }
        ok++;
        EXPECT_LT(motion.expectedResidual, motion.expectedRaw);
        const AckermannMotion truth = motionFromMetric(carCamera(), yawRate, speed, walls[0], walls[1], direction);
        const double before = mapDistance(carCamera(), AckermannMotion(), carCamera(), truth);
        const double after = mapDistance(given, motion, carCamera(), truth);
        raw += before;
        left += after;
        expectedRaw += motion.expectedRaw;
        expectedResidual += motion.expectedResidual;
        worse += after > 1.1 * before && after > before + 0.2;
    }
    RecordProperty("ok", ok);
    RecordProperty("left_over_raw", cv::format("%.3f", left / raw).c_str());
    RecordProperty("worse", worse);
    RecordProperty("expected_raw_over_raw", cv::format("%.3f", expectedRaw / raw).c_str());
    RecordProperty("expected_left_over_left", cv::format("%.3f", expectedResidual / left).c_str());
    EXPECT_GE(ok, frames / 2);
    EXPECT_LT(left, 0.6 * raw);
    EXPECT_LE(worse, frames * 6 / 100);
    EXPECT_GE(expectedRaw, 0.8 * raw);
    EXPECT_LE(expectedRaw, 1.5 * raw);
    EXPECT_GE(expectedResidual, 0.8 * left);
    EXPECT_LE(expectedResidual, 1.7 * left);
}

TEST(RSAckermann_Posterior, roll_and_yaw_rate_are_told_apart_by_a_gyro_only)
{
    RNG rng(7);
    for (int scan = SCAN_TOP_TO_BOTTOM; scan <= SCAN_BOTTOM_TO_TOP; scan++)
    {
        RollingShutterCamera camera = carCamera();
        camera.scanDirection = scan;
        const Simulator street = Simulator::fromMetric(camera, 0.3, 14, 6, 8, 0);
        const Mat segments = streetSegments(street, rng);
        MotionPrior gyro;
        gyro.yawRate = 0.3;
        gyro.yawRateSigma = 0.2 * degree;
        const AckermannMotion alone = estimate(camera, segments), given = estimate(camera, segments, gyro);
        ASSERT_EQ(MOTION_OK, alone.status) << scan;
        EXPECT_TRUE(alone.rollYawAmbiguous) << scan;
        EXPECT_FALSE(given.rollYawAmbiguous) << scan;
    }
}

// A vehicle that turns faster than cars do: what gravity hides is decided by how it usually turns.
TEST(RSAckermann_Posterior, usual_yaw_rates_are_told)
{
    RNG rng(9);
    double error[2] = {0, 0};
    for (int i = 0; i < 20; i++)
    {
        const double yawRate = (i % 2 ? 1 : -1) * 25 * degree;
        const Simulator street = Simulator::fromMetric(carCamera(), yawRate, 10, 6, 8, 0);
        const Mat segments = streetSegments(street, rng);
        for (int k = 0; k < 2; k++)
        {
            AckermannEstimator::Params params;
            if (k == 1)
                params.priorYawRate = 30 * degree;
            double found = 0;
            estimate(carCamera(), segments, MotionPrior(), params).yawRate(carCamera(), found);
            error[k] += std::abs(found - yawRate) / 20;
        }
    }
    RecordProperty("error_of_car", cv::format("%.1f", error[0] / degree).c_str());
    RecordProperty("error_of_robot", cv::format("%.1f", error[1] / degree).c_str());
    EXPECT_LT(error[1], 0.5 * error[0]);
}

// Of a street that is open to one side the wall alone is enough, if a motion is given; trees may stand on the open
// side.
TEST(RSAckermann_Posterior, one_wall_of_two)
{
    const int frames = 20;
    double raw = 0, left = 0;
    for (int i = 0; i < frames; i++)
    {
        RNG rng(200 + i);
        const double yawRate = rng.gaussian(4 * degree), speed = rng.uniform(8., 20.), wall = rng.uniform(4., 10.);
        const double leftWall = i % 2 ? wall : 0, rightWall = i % 2 ? 0 : wall;
        const AckermannMotion truth = motionFromMetric(carCamera(), yawRate, speed, leftWall, rightWall, 0);
        const Mat segments =
            streetSegments(Simulator::fromMetric(carCamera(), yawRate, speed, leftWall, rightWall, 0), rng);
        MotionPrior prior;
        prior.speed = speed;
        prior.speedSigma = 0.5;
        prior.yawRate = yawRate;
        prior.yawRateSigma = 1 * degree;
        raw += mapDistance(carCamera(), AckermannMotion(), carCamera(), truth) / frames;
        left += mapDistance(carCamera(), estimate(carCamera(), segments, prior), carCamera(), truth) / frames;
    }
    RecordProperty("left", cv::format("%.2f of %.2f", left, raw));
    EXPECT_LT(left, 0.2 * raw);
}

// Some of the lines that belong to nothing point along some street: they don't make its direction surer than it is.
TEST(RSAckermann_Posterior, direction_among_lines_of_nothing)
{
    const int frames = 40;
    double squares = 0;
    int within = 0;
    for (int i = 0; i < frames; i++)
    {
        RNG rng(900 + i);
        const double direction = rng.gaussian(6 * degree);
        const Simulator street = Simulator::fromMetric(carCamera(), 0.05, rng.uniform(8., 20.), 6, 8, direction);
        Mat segments = streetSegments(street, rng);
        for (int k = 0; k < 25; k++)
        {
            const double angle = rng.uniform(-60., 60.) * degree, length = rng.uniform(80., 250.);
            const Vec4d line(rng.uniform(0., 2048.), rng.uniform(0., 1024.), length * std::cos(angle),
                             length * std::sin(angle));
            segments.push_back(Mat(Vec4d(line[0], line[1], line[0] + line[2], line[1] + line[3])).t());
        }
        AckermannEstimator::Params params;
        params.gravitySigma = 0;
        const AckermannMotion motion = estimate(carCamera(), segments, MotionPrior(), params);
        if (motion.status != MOTION_OK)
            continue;
        const double delta = motion.delta();
        const double sigma = std::sqrt(motion.metricCovariance(carCamera())(2, 2)) / (1 + delta * delta);
        const double z = (std::atan(delta) - direction) / sigma;
        squares += z * z / frames;
        within += std::abs(z) < 2;
    }
    RecordProperty("rms", cv::format("%.2f", std::sqrt(squares)));
    EXPECT_LT(squares, 2 * 2);
    EXPECT_GE(within, frames * 9 / 10);
}

// A camera that isn't given how a shutter's rows are timed has no yaw rate, and neither has a motion of which nothing
// is known.
TEST(RSAckermann_Posterior, nothing_is_known_without_segments)
{
    const AckermannMotion motion = estimate(carCamera(), Mat(0, 4, CV_64F));
    EXPECT_EQ(MOTION_TOO_FEW_SEGMENTS, motion.status);
    double yawRate = 1;
    EXPECT_FALSE(motion.yawRate(carCamera(), yawRate));
    EXPECT_EQ(0, yawRate);
}

TEST(RSAckermann_Posterior, reverse_is_told)
{
    RNG rng(8);
    const Simulator street = Simulator::fromMetric(carCamera(), 0.05, -6, 4, 5, 0);
    MotionPrior prior;
    prior.speed = -6;
    prior.speedSigma = 0.5;
    const AckermannMotion motion = estimate(carCamera(), streetSegments(street, rng), prior);
    ASSERT_EQ(MOTION_OK, motion.status);
    EXPECT_EQ(-1, motion.direction);
    EXPECT_LT(motion.roadSlope, 0);
}

}} // namespace
