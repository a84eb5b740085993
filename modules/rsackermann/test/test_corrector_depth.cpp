// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_corrector_common.hpp"
#include "test_metric_motion.hpp"
#include "test_posts_in_street.hpp"
#include "opencv2/imgproc.hpp"
#include "../src/warp/maps/maps.hpp"

namespace opencv_test { namespace {

struct CorrectorDepth : testing::Test
{
    CorrectorDepth() : camera(RollingShutterCamera::fromFocal(Size(320, 200), 400))
    {
        camera.lineDelay = 60e-6;
        camera.height = 1.3;
        motion = motionFromMetric(camera, 0.3, 15, 2.5, 3, 0);
        image.create(camera.imageSize, CV_8UC3);
        randu(image, 0, 256);
        GaussianBlur(image, image, Size(), 2);
        Mat values(camera.imageSize, CV_32F, Scalar(4));
        values(Rect(20, 10, 40, 180)).setTo(2);
        depth = DepthMap(values);
    }

    RollingShutterCamera camera;
    AckermannMotion motion;
    Mat image;
    DepthMap depth;
};

TEST_F(CorrectorDepth, is_that_of_the_maps)
{
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    Mat corrected, mask, map1, map2, expectedMask, expected, usedMap1, usedMap2;
    corrector->correctWithMotion(image, motion, corrected, mask, depth);
    EXPECT_TRUE(corrector->isDepthUsed());
    WarpMapGenerator::create(camera)->initRectifyMap(motion, map1, map2, CV_32FC1, expectedMask, depth);
    remap(image, expected, map1, map2, INTER_LINEAR);
    corrector->getMaps(usedMap1, usedMap2);
    EXPECT_EQ(0, cvtest::norm(corrected, expected, NORM_INF));
    EXPECT_EQ(0, cvtest::norm(mask, expectedMask, NORM_INF));
    EXPECT_EQ(0, cvtest::norm(usedMap1, map1, NORM_INF));
    EXPECT_GT(countNonZero(mask == MASK_HIDDEN), 0);

    corrector->correctWithMotion(image, motion, corrected, mask);
    EXPECT_FALSE(corrector->isDepthUsed());
    EXPECT_GT(cvtest::norm(corrected, expected, NORM_INF), 0);
}

TEST_F(CorrectorDepth, needs_metres)
{
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    Mat corrected, expected, mask;
    AckermannMotion unknown = motion;
    unknown.wallDistance = 0;
    unknown.scale = SCALE_UNKNOWN;
    corrector->correctWithMotion(image, unknown, expected, mask);
    corrector->correctWithMotion(image, unknown, corrected, mask, depth);
    EXPECT_FALSE(corrector->isDepthUsed());
    EXPECT_EQ(0, cvtest::norm(corrected, expected, NORM_INF));

    unknown.status = MOTION_NO_CONSENSUS;
    corrector->correctWithMotion(image, unknown, corrected, mask, depth);
    EXPECT_FALSE(corrector->isDepthUsed());
    EXPECT_EQ(0, cvtest::norm(corrected, image, NORM_INF));
}

TEST_F(CorrectorDepth, needs_a_value_that_is_known)
{
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    Mat corrected, expected;
    corrector->correctWithMotion(image, motion, expected);
    for (const float value : {0.f, -1.f, nan, infinity})
    {
        SCOPED_TRACE(value);
        Mat values(camera.imageSize, CV_32F, Scalar(value));
        corrector->correctWithMotion(image, motion, corrected, noArray(), DepthMap(values));
        EXPECT_FALSE(corrector->isDepthUsed());
        EXPECT_EQ(0, cvtest::norm(corrected, expected, NORM_INF));
        values.at<float>(values.rows - 1, values.cols - 1) = 3;
        corrector->correctWithMotion(image, motion, corrected, noArray(), DepthMap(values));
        EXPECT_TRUE(corrector->isDepthUsed());
    }
    Mat values(camera.imageSize, CV_16U, Scalar(0));
    corrector->correctWithMotion(image, motion, corrected, noArray(), DepthMap(values, DEPTH_RAW, 0.01));
    EXPECT_FALSE(corrector->isDepthUsed());
    // Nor is anything else expected.
    RNG rng(3);
    const simulation::Simulator street = simulation::Simulator::fromMetric(camera, 0.3, 15, 2.5, 3, 0);
    const Mat1f ends = simulation::randomSegments(street, simulation::SegmentOptions(), rng).ends;
    MotionPrior prior;
    prior.speed = 15;
    prior.speedSigma = 0.5;
    corrector->setPrior(prior);
    const AckermannMotion without = corrector->correctWithSegments(image, ends, corrected);
    ASSERT_EQ(MOTION_OK, without.status);
    const AckermannMotion with = corrector->correctWithSegments(image, ends, corrected, noArray(), DepthMap(values));
    EXPECT_FALSE(corrector->isDepthUsed());
    EXPECT_EQ(without.expectedRaw, with.expectedRaw);
    EXPECT_EQ(without.expectedResidual, with.expectedResidual);
}

// Millimetres taken for metres aren't used, whatever form they have, but by maps of a motion that is given.
TEST_F(CorrectorDepth, is_refused_in_another_unit)
{
    const double cars[][2] = {{15, 1.3}, {-15, 1.3}, {15, 4.2}}; // speed; height of the camera
    for (const auto& car : cars)
    {
        const double speed = car[0];
        camera.height = car[1];
        const simulation::Simulator street = simulation::Simulator::fromMetric(camera, 0.3, speed, 2.5, 3, 0);
        cv::divide(1, simulation::inverseDepthsOf(street), depth.values);
        RNG rng(11);
        const int horizon = cvCeil(camera.cameraMatrix(1, 2));
        std::vector<Vec4f> segments;
        const Mat1f ends = simulation::randomSegments(street, simulation::SegmentOptions(), rng).ends;
        for (int i = 0; i < ends.rows; i++)
            if (ends(i, 1) + ends(i, 3) < 2 * horizon)
                segments.push_back(Vec4f(ends[i]));
        for (const int mode : {0, 1, 2})
            for (const int type : {CV_32F, CV_16U})
                for (const int whose : {DEPTH_RAW, DEPTH_CORRECTED})
                    for (const double unit : {1., 2.5, 1 / 2.5, 3.9, 1 / 3.9, 100., 0.001})
                    {
                        const bool isSequence = mode == 1, hasVerticals = mode != 2;
                        SCOPED_TRACE(testing::Message() << speed << " " << camera.height << " " << isSequence << " "
                                                        << hasVerticals << " " << type << " " << whose << " " << unit);
                        MotionPrior prior;
                        prior.speed = speed;
                        prior.speedSigma = 0.3;
                        RollingShutterCorrector::Params params;
                        params.sequence = isSequence;
                        params.trackPoints = false;
                        const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera, params);
                        corrector->setPrior(prior);
                        DepthMap given(Mat(), whose, (type == CV_16U ? 0.01 : 1) * unit);
                        depth.values.convertTo(given.values, type, type == CV_16U ? 100 : 1);
                        if (!hasVerticals) // that have a depth
                            given.values.rowRange(0, horizon).setTo(0);
                        Mat corrected, expected;
                        const AckermannMotion found =
                            corrector->correctWithSegments(image, segments, corrected, noArray(), given);
                        ASSERT_EQ(MOTION_OK, found.status);
                        ASSERT_GT(speed * found.direction, 0);
                        // Verticals show it best, the road to a factor.
                        const double limit = hasVerticals ? 2 : 2.8;
                        const bool isPlausible = std::abs(std::log(unit)) < std::log(limit);
                        EXPECT_EQ(isPlausible, corrector->isDepthUsed());
                        corrector->correctWithMotion(image, found, expected, noArray(),
                                                     isPlausible ? given : DepthMap());
                        EXPECT_EQ(0, cvtest::norm(expected, corrected, NORM_INF));
                        corrector->correctWithMotion(image, found, corrected, noArray(), given);
                        EXPECT_TRUE(corrector->isDepthUsed());
                    }
    }
}

// With a depth that is known, what is left is that of the given values and of its scale alone; with one that the planes
// disagree with, it may be what they differ by.
TEST_F(CorrectorDepth, metres_expect_what_is_left)
{
    const simulation::Simulator street = simulation::Simulator::fromMetric(camera, 0.3, 15, 2.5, 3, 0);
    cv::divide(1, simulation::inverseDepthsOf(street), depth.values);
    const AckermannMotion truth = motionFromMetric(camera, 0.3, 15, 2.5, 3, 0);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    Mat whole[2], corrected;
    generator->initRectifyMap(truth, whole[0], whole[1], CV_32FC1, noArray(), depth);
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    RNG rng(5);
    for (const double farther : {1., 1.4, 1 / 1.4})
    {
        SCOPED_TRACE(farther);
        double left = 0, expected = 0;
        for (int trial = 0; trial < 40; trial++)
        {
            MotionPrior prior;
            prior.yawRateSigma = 0.03;
            prior.speedSigma = 0.5;
            prior.yawRate = 0.3 + rng.gaussian(prior.yawRateSigma);
            prior.speed = 15 + rng.gaussian(prior.speedSigma);
            corrector->setPrior(prior);
            const Mat1f ends = simulation::randomSegments(street, simulation::SegmentOptions(), rng).ends;
            DepthMap given = depth;
            given.scaleSigma = 0.06;
            given.scale = farther * std::exp(rng.gaussian(given.scaleSigma));
            const AckermannMotion found = corrector->correctWithSegments(image, ends, corrected, noArray(), given);
            if (farther == 1)
                ASSERT_TRUE(corrector->isDepthUsed());
            else if (!corrector->isDepthUsed())
                continue;
            expected += found.expectedResidual;
            Mat maps[2], distances;
            corrector->getMaps(maps[0], maps[1]);
            magnitude(maps[0] - whole[0], maps[1] - whole[1], distances);
            left += mean(distances)[0];
        }
        EXPECT_NEAR(1, left / expected, farther == 1 ? 0.3 : 0.5);
    }
    const Mat1f ends = simulation::randomSegments(street, simulation::SegmentOptions(), rng).ends;
    MotionPrior exactYawRate; // what is left is the speed's
    exactYawRate.yawRate = 0.3;
    exactYawRate.yawRateSigma = 1e-4;
    exactYawRate.speed = 15;
    exactYawRate.speedSigma = 1;
    corrector->setPrior(exactYawRate);
    const double ofPlanes = corrector->correctWithSegments(image, ends, corrected).expectedResidual;
    Mat few(camera.imageSize, CV_32F, Scalar(0));
    depth.values(Rect(20, 20, 10, 10)).copyTo(few(Rect(20, 20, 10, 10)));
    const AckermannMotion found = corrector->correctWithSegments(image, ends, corrected, noArray(), DepthMap(few));
    ASSERT_TRUE(corrector->isDepthUsed());
    EXPECT_GT(found.expectedResidual, 0.5 * ofPlanes);
}

// The pixels are those of the new camera, whose image may be a small one.
TEST_F(CorrectorDepth, unit_of_a_new_camera)
{
    WarpMapGenerator::Params params;
    params.newCameraMatrix = Matx33d::diag(Vec3d(0.25, 0.25, 1)) * camera.cameraMatrix;
    params.newSize = Size(camera.imageSize.width / 4, camera.imageSize.height / 4);
    Mat road(params.newSize, CV_32F, Scalar(0));
    for (int y = road.rows / 2 + 1; y < road.rows; y++)
        road.row(y).setTo(camera.height * params.newCameraMatrix(1, 1) / (y - params.newCameraMatrix(1, 2)));
    for (const double speed : {15., -15.})
        for (const double unit : {1., 100., 0.001})
        {
            AckermannMotion onRoad = motionFromMetric(camera, 0.3, speed, 0, 0, 0);
            onRoad.scale = SCALE_ROAD;
            EXPECT_EQ(unit != 1,
                      cv::rsackermann::isInAnotherUnit(camera, params, onRoad, DepthMap(road, DEPTH_CORRECTED, unit)))
                << speed << " " << unit;
        }
}

TEST_F(CorrectorDepth, relative_needs_no_metres)
{
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    Mat corrected, expected, mask;
    corrector->correctWithMotion(image, motion, expected, mask, depth);
    EXPECT_EQ(DEPTH_METRIC, corrector->getUsedDepth().kind);
    Mat inverse;
    cv::divide(1, depth.values, inverse);
    DepthMap relative(inverse, DEPTH_RAW, 15 * camera.secondsPerUnitTime(), DEPTH_RELATIVE);
    AckermannMotion unknown = motion;
    unknown.wallDistance = 0;
    unknown.scale = SCALE_UNKNOWN;
    corrector->correctWithMotion(image, unknown, corrected, mask, relative);
    EXPECT_TRUE(corrector->isDepthUsed());
    EXPECT_EQ(relative.scale, corrector->getUsedDepth().scale);
    EXPECT_LE(cvtest::norm(corrected, expected, NORM_L1) / corrected.total(), 0.01);
}

// An image without verticals shows no motion, with which a depth could be aligned.
TEST_F(CorrectorDepth, relative_needs_a_motion)
{
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    Mat corrected;
    const DepthMap relative(depth.values, DEPTH_RAW, 1, DEPTH_RELATIVE);
    corrector->correctWithSegments(image, Mat(0, 4, CV_32F), corrected, noArray(), relative);
    EXPECT_FALSE(corrector->isDepthUsed());
    EXPECT_TRUE(corrector->getUsedDepth().empty());
    EXPECT_EQ(0, cvtest::norm(corrected, image, NORM_INF));
    DepthMap bad = relative;
    bad.kind = 2;
    EXPECT_THROW(corrector->correct(image, corrected, noArray(), bad), cv::Exception);
    bad = relative;
    bad.shift = std::numeric_limits<double>::infinity();
    EXPECT_THROW(corrector->correct(image, corrected, noArray(), bad), cv::Exception);
    for (const double sigma : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()})
    {
        bad = relative;
        bad.scaleSigma = sigma;
        EXPECT_THROW(corrector->correct(image, corrected, noArray(), bad), cv::Exception) << sigma;
    }
}

// Images whose verticals may be those of a camera at rest as long as nothing is known of their depth.
TEST_F(CorrectorDepth, relative_shows_a_motion)
{
    RNG rng(14);
    int rescued = 0;
    for (int round = 0; round < 2; round++)
    {
        simulation::PostsInStreet s(rng);
        s.params.gravitySigma = s.params.vehiclePitchSigma = 0.01;
        RollingShutterCorrector::Params params;
        params.estimator = s.params;
        const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(s.camera, params);
        const Mat black(s.camera.imageSize, CV_8U, Scalar(0));
        Mat corrected;
        const AckermannMotion without = corrector->correctWithSegments(black, s.segments, corrected);
        const AckermannMotion with =
            corrector->correctWithSegments(black, s.segments, corrected, noArray(), s.relative(rng));
        if (without.status == MOTION_OK || with.status != MOTION_OK)
            continue;
        rescued++;
        EXPECT_TRUE(corrector->isDepthUsed());
        EXPECT_LT(std::abs(2 * with.alpha / s.camera.secondsPerUnitTime() - s.yawRate), std::abs(s.yawRate)) << round;
        EXPECT_LT(s.relativeError(corrector->getUsedDepth()), 0.4) << round;
    }
    EXPECT_GT(rescued, 0);
}

// A gyro's yaw rate is known beside a depth, too.
TEST_F(CorrectorDepth, relative_keeps_the_turn_of_a_gyro)
{
    RNG rng(21);
    for (int round = 0; round < 4; round++)
    {
        simulation::PostsInStreet s(rng);
        RollingShutterCorrector::Params params;
        params.estimator = s.params;
        params.estimator.gravitySigma = CV_PI / 180;
        params.gyroBiasSigma = params.gyroAxesSigma = 0.001;
        const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(s.camera, params);
        Mat1d times(100, 1), rates(100, 3, 0.);
        for (int i = 0; i < times.rows; i++)
        {
            times(i) = 0.01 * i;
            rates(i, 1) = s.yawRate;
        }
        corrector->addGyro(times, rates);
        corrector->setTimestamp(0.5);
        Mat corrected;
        const AckermannMotion found = corrector->correctWithSegments(Mat(s.camera.imageSize, CV_8U, Scalar(0)),
                                                                     s.segments, corrected, noArray(), s.relative(rng));
        ASSERT_EQ(MOTION_OK, found.status) << round;
        EXPECT_TRUE(corrector->isDepthUsed()) << round;
        EXPECT_NEAR(s.yawRate, 2 * found.alpha / s.camera.secondsPerUnitTime(), 0.02) << round;
    }
}

TEST_F(CorrectorDepth, bad_depth_is_refused_first)
{
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    Mat corrected;
    const DepthMap narrow(depth.values.colRange(1, 100));
    const Mat noSegments(0, 4, CV_32F);
    EXPECT_THROW(corrector->correct(image, corrected, noArray(), narrow), cv::Exception);
    EXPECT_THROW(corrector->correctWithSegments(image, noSegments, corrected, noArray(), narrow), cv::Exception);
    EXPECT_THROW(corrector->correctWithMotion(image, AckermannMotion(), corrected, noArray(), narrow), cv::Exception);
    EXPECT_TRUE(corrected.empty());
}

}} // namespace opencv_test::
