// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_corrector_common.hpp"
#include "opencv2/core/ocl.hpp"
#include "opencv2/imgproc.hpp"
#include "test_simulator.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

Mat noiseImage(const Size& size, int type)
{
    Mat image(size, type);
    theRNG().fill(image, RNG::UNIFORM, 0, CV_MAT_DEPTH(type) == CV_16U ? 65536 : 256);
    return image;
}

Mat streetSegments(const RollingShutterCamera& camera, double yawRate, double speed)
{
    RNG rng(11);
    const Simulator simulator = Simulator::fromMetric(camera, yawRate, speed, 2.5, 3, camera.heading);
    return simulation::randomSegments(simulator, simulation::SegmentOptions(), rng).ends;
}

typedef testing::TestWithParam<int> CorrectorTypes; // type of the image

TEST_P(CorrectorTypes, image_without_lines_is_copied)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    const Mat src(camera.imageSize, GetParam(), Scalar::all(77));
    Mat dst, mask, segments, labels, map1, map2;
    const AckermannMotion motion = corrector->correct(src, dst, mask);
    EXPECT_NE(MOTION_OK, motion.status);
    ASSERT_EQ(src.type(), dst.type());
    EXPECT_EQ(0, cvtest::norm(src, dst, NORM_INF));
    EXPECT_NE(src.data, dst.data);
    EXPECT_EQ(CV_8UC1, mask.type());
    EXPECT_EQ(camera.imageSize.area(), cv::countNonZero(mask == 255));

    corrector->getSegments(segments, labels);
    EXPECT_EQ(0, segments.rows);
    EXPECT_EQ(0, labels.rows);
    corrector->getMaps(map1, map2);
    ASSERT_EQ(camera.imageSize, map1.size());
    Mat remapped;
    cv::remap(src, remapped, map1, map2, INTER_LINEAR);
    EXPECT_EQ(0, cvtest::norm(src, remapped, NORM_INF));
}

TEST_P(CorrectorTypes, moving_camera)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    const Mat src = noiseImage(camera.imageSize, GetParam()), segments = streetSegments(camera, 0.6, 20);
    Mat dst, mask, map1, map2, expected;
    const AckermannMotion motion = corrector->correctWithSegments(src, segments, dst, mask);
    ASSERT_EQ(MOTION_OK, motion.status);

    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    Mat expected1, expected2, expectedMask;
    generator->initRectifyMap(motion, expected1, expected2, CV_32FC1, expectedMask);
    cv::remap(src, expected, expected1, expected2, INTER_LINEAR, BORDER_CONSTANT);
    EXPECT_EQ(0, cvtest::norm(expected, dst, NORM_INF));
    EXPECT_EQ(0, cvtest::norm(expectedMask, mask, NORM_INF));
    corrector->getMaps(map1, map2);
    EXPECT_EQ(0, cvtest::norm(expected1, map1, NORM_INF));
    EXPECT_EQ(0, cvtest::norm(expected2, map2, NORM_INF));
    EXPECT_GT(cvtest::norm(src, dst, NORM_INF), 0);
}

INSTANTIATE_TEST_CASE_P(RSAckermann, CorrectorTypes, testing::Values(CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3));

//! Mean pixels between where the maps put what they take from the raw image and where it belongs, over the walls.
double meanDisplacement(const Simulator& simulator, const Mat& map1, const Mat& map2)
{
    double sum = 0;
    int n = 0;
    for (int y = 10; y < map1.rows; y += 20)
        for (int x = 10; x < map1.cols; x += 20)
        {
            const Point2d raw(map1.at<float>(y, x), map2.at<float>(y, x));
            if (!simulator.inside(raw))
                continue;
            const simulation::Surface surface = simulator.surface(raw);
            Vec3d P;
            if (surface != simulation::LEFT && surface != simulation::RIGHT)
                continue;
            simulator.locate(raw, surface, P);
            P = simulator.camera.cameraMatrix * (simulator.camera.uprightRotation.t() * P);
            sum += cv::norm(Point2d(x, y) - Point2d(P[0] / P[2], P[1] / P[2]));
            n++;
        }
    EXPECT_GE(n, 100);
    return sum / n;
}

TEST(RSAckermann_Corrector, corrects_what_the_simulator_distorts)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Simulator simulator = Simulator::fromMetric(camera, 0.6, 20, 2.5, 3, 0);
    RollingShutterCorrector::Params params;
    params.estimator.gravitySigma = 0;
    params.estimator.wallDistance = 2.5; // with the camera's height it says where the road is
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera, params);
    Mat dst, map1, map2, rest1, rest2;
    corrector->correctWithSegments(noiseImage(camera.imageSize, CV_8UC1), streetSegments(camera, 0.6, 20), dst);
    corrector->getMaps(map1, map2);
    WarpMapGenerator::create(camera)->initRectifyMap(AckermannMotion(), rest1, rest2);
    EXPECT_LT(meanDisplacement(simulator, map1, map2), 0.02 * meanDisplacement(simulator, rest1, rest2));
}

// The segments of a distorted image are as good as those of an undistorted one.
TEST(RSAckermann_Corrector, lens_and_shutter)
{
    const RollingShutterCamera plain = simulation::paperCamera();
    RollingShutterCamera distorted = plain;
    distorted.distCoeffs = {-0.28, 0.09, 8e-4, -6e-4, -0.012};
    simulation::SegmentOptions options;
    options.noise = 0.3;
    double left[2] = {0, 0}, raw = 0;
    RNG rng(61);
    for (int round = 0; round < 20; round++)
    {
        const double yawRate = rng.uniform(-1.2, 1.2), speed = rng.uniform(5., 38.);
        for (int lens = 0; lens < 2; lens++)
        {
            const RollingShutterCamera& camera = lens ? distorted : plain;
            const Simulator simulator = Simulator::fromMetric(camera, yawRate, speed, 2.5, 3, 0);
            const Mat segments = simulation::randomSegments(simulator, options, rng).ends;
            RollingShutterCorrector::Params params;
            params.estimator.gravitySigma = 0;
            const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera, params);
            Mat dst, map1, map2;
            corrector->correctWithSegments(Mat(camera.imageSize, CV_8U, Scalar(0)), segments, dst);
            corrector->getMaps(map1, map2);
            left[lens] += meanDisplacement(simulator, map1, map2) / 20;
            if (lens)
                continue;
            WarpMapGenerator::create(camera)->initRectifyMap(AckermannMotion(), map1, map2);
            raw += meanDisplacement(simulator, map1, map2) / 20;
        }
    }
    EXPECT_LT(left[0], 0.3 * raw);
    EXPECT_LE(left[1], 1.3 * left[0]);
}

TEST(RSAckermann_Corrector, lens_of_a_camera_at_rest)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.distCoeffs = std::vector<double>(5, 0.);
    camera.distCoeffs[0] = -0.3;
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    const Mat src = noiseImage(camera.imageSize, CV_8UC3);
    Mat dst, expected, none(0, 4, CV_32F);
    const AckermannMotion motion = corrector->correctWithSegments(src, none, dst);
    EXPECT_EQ(MOTION_TOO_FEW_SEGMENTS, motion.status);
    // Maps in float as the corrector's: cv::undistort rounds places to 1/32 pixel, remap in OpenCV 5 doesn't.
    Mat map1, map2;
    cv::initUndistortRectifyMap(camera.cameraMatrix, camera.distCoeffs, noArray(), camera.cameraMatrix, src.size(),
                                CV_32FC1, map1, map2);
    cv::remap(src, expected, map1, map2, INTER_LINEAR);
    // OpenCV 4 rounds places to 1/32 pixel, in either direction if they lie between
    EXPECT_LE(cvtest::norm(dst, expected, NORM_L1) / src.total() / 3, 0.05);

    // coefficients that are all 0 are no lens
    camera.distCoeffs[0] = 0;
    corrector->setCamera(camera);
    corrector->correctWithSegments(src, none, dst);
    EXPECT_EQ(0, cvtest::norm(src, dst, NORM_INF));
}

TEST(RSAckermann_Corrector, column_shutter_is_not_observable)
{
    RollingShutterCamera camera = simulation::paperCamera();
    const Mat segments = streetSegments(camera, 0.6, 20);
    camera.scanDirection = SCAN_LEFT_TO_RIGHT;
    const Mat src = noiseImage(camera.imageSize, CV_8UC1);
    Mat dst;
    EXPECT_EQ(MOTION_NOT_OBSERVABLE,
              RollingShutterCorrector::create(camera)->correctWithSegments(src, segments, dst).status);
    EXPECT_EQ(0, cvtest::norm(src, dst, NORM_INF));
}

TEST(RSAckermann_Corrector, tiny_images)
{
    const Size sizes[] = {Size(1, 1), Size(7, 1), Size(1, 9),   Size(2, 2),
                          Size(3, 2), Size(5, 5), Size(17, 16), Size(1, 30000)};
    for (const Size& size : sizes)
        for (const bool isCarried : {false, true})
        {
            SCOPED_TRACE(testing::Message() << size << isCarried);
            const Mat src = noiseImage(size, CV_8UC3);
            RollingShutterCamera camera = RollingShutterCamera::fromFocal(size);
            camera.lineDelay = 1e-5;
            RollingShutterCorrector::Params params;
            params.sequence = isCarried;
            const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera, params);
            for (int frame = 0; frame < 3; frame++)
            {
                Mat dst, mask;
                corrector->setNextFrame(src, NaN);
                EXPECT_NE(MOTION_OK, corrector->correct(src, dst, mask).status);
                EXPECT_EQ(0, cvtest::norm(src, dst, NORM_INF));
                EXPECT_EQ(size.area(), cv::countNonZero(mask));
            }
        }
}

TEST(RSAckermann_Corrector, steady_state_reuses_buffers)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    const Mat src = noiseImage(camera.imageSize, CV_8UC1), segments = streetSegments(camera, 0.6, 20);
    Mat dst, mask, again;
    corrector->correctWithSegments(src, segments, dst, mask);
    dst.copyTo(again);
    const uchar* const data[] = {dst.data, mask.data};
    corrector->correctWithSegments(src, segments, dst, mask);
    EXPECT_EQ(data[0], dst.data);
    EXPECT_EQ(data[1], mask.data);
    EXPECT_EQ(0, cvtest::norm(again, dst, NORM_INF));
}

TEST(RSAckermann_Corrector, in_place)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    const Mat src = noiseImage(camera.imageSize, CV_8UC1), segments = streetSegments(camera, 0.6, 20);
    Mat dst, image = src.clone();
    corrector->correctWithSegments(src, segments, dst);
    corrector->correctWithSegments(image, segments, image);
    EXPECT_EQ(0, cvtest::norm(image, dst, NORM_INF));
    // A row or a column later in the same memory, either way.
    for (const Point& shift : {Point(0, 1), Point(1, 0), Point(-1, 1)})
        for (const bool later : {false, true})
        {
            Mat parent(camera.imageSize + Size(1, 1), CV_8UC1, Scalar(0));
            const Rect here(Point(shift.x < 0 ? 1 : 0, 0), camera.imageSize), there(here.tl() + shift, here.size());
            Mat from = parent(later ? here : there), to = parent(later ? there : here);
            src.copyTo(from);
            corrector->correctWithSegments(from, segments, to);
            EXPECT_EQ(0, cvtest::norm(to, dst, NORM_INF)) << shift << later;
            src.copyTo(from);
            corrector->correctWithSegments(from, Mat(), to); // as it is
            EXPECT_EQ(0, cvtest::norm(to, src, NORM_INF)) << shift << later;
            const AckermannMotion motion = motionFromMetric(camera, 0.3, 15, 2.5, 3, 0);
            const DepthMap depth(Mat(camera.imageSize, CV_32F, Scalar(4)));
            Mat byDepth;
            corrector->correctWithMotion(src, motion, byDepth, noArray(), depth);
            src.copyTo(from);
            corrector->correctWithMotion(from, motion, to, noArray(), depth);
            EXPECT_EQ(0, cvtest::norm(to, byDepth, NORM_INF)) << shift << later;
            Mat mask = parent(later ? there : here);
            EXPECT_THROW(corrector->correctWithSegments(from, segments, dst.clone(), mask), cv::Exception);
        }
    // Regions beside each other have their own pixels.
    Mat parent(camera.imageSize.height, 2 * camera.imageSize.width, CV_8UC1);
    Mat left = parent(Rect(Point(), camera.imageSize)),
        right = parent(Rect(Point(camera.imageSize.width, 0), camera.imageSize));
    Mat other;
    corrector->correctWithSegments(src, segments, left, right);
    corrector->correctWithSegments(src, segments, dst, other);
    EXPECT_EQ(0, cvtest::norm(left, dst, NORM_INF));
    EXPECT_EQ(0, cvtest::norm(right, other, NORM_INF));
}

TEST(RSAckermann_Corrector, OpenCL_in_place)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    const Mat src = noiseImage(camera.imageSize, CV_8UC3), segments = streetSegments(camera, 0.6, 20);
    UMat image, dst;
    src.copyTo(image);
    corrector->correctWithSegments(image, segments, dst);
    corrector->correctWithSegments(image, segments, image);
    EXPECT_EQ(0, cvtest::norm(image.getMat(ACCESS_READ), dst.getMat(ACCESS_READ), NORM_INF));
}

TEST(RSAckermann_Corrector, OpenCL)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    const Mat src = noiseImage(camera.imageSize, CV_8UC1), segments = streetSegments(camera, 0.6, 20);
    Mat dst;
    corrector->correctWithSegments(src, segments, dst);
    Mat map1, map2, deviceMap1, deviceMap2, hostMask;
    corrector->getMaps(map1, map2);

    UMat device, mask;
    corrector->correctWithSegments(src.getUMat(ACCESS_READ), segments, device, mask);
    corrector->getMaps(deviceMap1, deviceMap2);
    corrector->correctWithSegments(src.getUMat(ACCESS_READ), segments, device, hostMask);
    EXPECT_EQ(0, cvtest::norm(mask.getMat(ACCESS_READ), hostMask, NORM_INF));
    EXPECT_LE(cvtest::norm(map1, deviceMap1, NORM_INF, hostMask), 1e-3);
    EXPECT_LE(cvtest::norm(map2, deviceMap2, NORM_INF, hostMask), 1e-3);
    // OpenCL's remap doesn't round coordinates to 1/32 pixel, and white noise is the worst that can be interpolated
    EXPECT_LE(cvtest::norm(device.getMat(ACCESS_READ), dst, NORM_L1) / src.total(), 4);
    if (!cv::ocl::useOpenCL())
    {
        EXPECT_EQ(0, cvtest::norm(device.getMat(ACCESS_READ), dst, NORM_INF));
    }
}

TEST(RSAckermann_Corrector, segments_labels_and_timings)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    EXPECT_EQ(Vec4d(), corrector->getTimings());
    const Mat segments = streetSegments(camera, 0.6, 20);
    Mat dst, gotSegments, labels, expected;
    const AckermannMotion motion = corrector->correctWithSegments(noiseImage(camera.imageSize, CV_8UC1), segments, dst);
    corrector->getSegments(gotSegments, labels);
    segments.convertTo(expected, CV_32F);
    ASSERT_EQ(expected.size(), gotSegments.size());
    EXPECT_EQ(0, cvtest::norm(expected, gotSegments, NORM_INF));
    Mat expectedLabels;
    const AckermannMotion alone = AckermannEstimator::create(camera)->estimate(segments, expectedLabels);
    EXPECT_EQ(0, cvtest::norm(expectedLabels, labels, NORM_INF));
    EXPECT_EQ(alone.alpha, motion.alpha);
    const Vec4d timings = corrector->getTimings();
    EXPECT_EQ(0, timings[0]);
    for (int i = 1; i < 4; i++)
        EXPECT_GT(timings[i], 0);

    // four-channel segments of another type
    const Mat column = expected.reshape(4);
    EXPECT_EQ(MOTION_OK, corrector->correctWithSegments(noiseImage(camera.imageSize, CV_8UC1), column, dst).status);
    corrector->getSegments(gotSegments, labels);
    EXPECT_EQ(expected.size(), gotSegments.size());
}

TEST(RSAckermann_Corrector, segments_of_the_caller_s_type)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    std::vector<Vec4f> list(3);
    std::vector<Vec4d> exact;
    std::vector<uchar> labels;
    corrector->getSegments(list, labels); // no image yet
    EXPECT_EQ(0u, list.size());
    EXPECT_EQ(0u, labels.size());

    Mat dst, expected;
    const Mat segments = streetSegments(camera, 0.6, 20);
    corrector->correctWithSegments(noiseImage(camera.imageSize, CV_8UC1), segments, dst);
    corrector->getSegments(list, labels);
    corrector->getSegments(exact, noArray());
    segments.convertTo(expected, CV_32F);
    ASSERT_EQ(size_t(segments.rows), list.size());
    EXPECT_EQ(list.size(), labels.size());
    EXPECT_EQ(0, cvtest::norm(expected, Mat(list).reshape(1), NORM_INF));
    segments.convertTo(expected, CV_64F);
    EXPECT_EQ(0, cvtest::norm(expected, Mat(exact).reshape(1), NORM_INF));
}

//! What an image leaves behind isn't changed by a call that throws.
TEST(RSAckermann_Corrector, bad_segments_change_nothing)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    const Mat src = noiseImage(camera.imageSize, CV_8UC1);
    Mat dst, before, labelsBefore, after, labelsAfter;
    corrector->correctWithSegments(src, streetSegments(camera, 0.6, 20), dst);
    corrector->getSegments(before, labelsBefore);
    const Vec4d timings = corrector->getTimings();
    EXPECT_THROW(corrector->correctWithSegments(src, Mat(5, 3, CV_32F, Scalar(1)), dst), cv::Exception);
    EXPECT_THROW(corrector->correctWithSegments(src, Mat(5, 4, CV_32S, Scalar(1)), dst), cv::Exception);
    corrector->getSegments(after, labelsAfter);
    EXPECT_EQ(0, cvtest::norm(before, after, NORM_INF));
    EXPECT_EQ(0, cvtest::norm(labelsBefore, labelsAfter, NORM_INF));
    EXPECT_EQ(timings, corrector->getTimings());
}

TEST(RSAckermann_Corrector, setters_are_all_or_nothing)
{
    const Ptr<RollingShutterCorrector> corrector =
        RollingShutterCorrector::create(exampleCamera(), exampleCorrectorParams());
    const RollingShutterCorrector::Params example = exampleCorrectorParams();
    for (int i = 0; i < 3; i++)
    {
        RollingShutterCorrector::Params bad;
        (i == 0 ? bad.estimator.threshold : i == 1 ? bad.warp.tolerance : bad.frameInterval) = -1;
        EXPECT_THROW(corrector->setParams(bad), cv::Exception);
        expectSame(example, corrector->getParams());
        // The parts have kept theirs, too: what is corrected has the size of before.
        Mat dst;
        corrector->correctWithSegments(Mat(exampleCamera().imageSize, CV_8U, Scalar(0)), noArray(), dst);
        EXPECT_EQ(example.warp.newSize, dst.size());
    }
    RollingShutterCamera camera = exampleCamera();
    camera.imageSize = Size(640, 380);
    camera.heading = NaN;
    EXPECT_THROW(corrector->setCamera(camera), cv::Exception);
    expectSame(exampleCamera(), corrector->getCamera());
}

TEST(RSAckermann_Corrector, every_type_that_remap_takes)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Mat segments = streetSegments(camera, 0.6, 20), src = noiseImage(camera.imageSize, CV_8UC2);
    const int depths[] = {CV_8U, CV_16U, CV_16S, CV_32F, CV_64F};
    for (int i = 0; i < 5; i++)
    {
        Mat converted, dst;
        src.convertTo(converted, depths[i]);
        EXPECT_EQ(MOTION_OK,
                  RollingShutterCorrector::create(camera)->correctWithSegments(converted, segments, dst).status);
        EXPECT_EQ(converted.type(), dst.type());
    }
}

//! Segments of a street with noisy ends, other ones for each seed.
Mat noisySegments(const RollingShutterCamera& camera, double yawRate, double speed, int seed)
{
    RNG rng(seed);
    simulation::SegmentOptions options;
    options.noise = 0.3;
    return simulation::randomSegments(Simulator::fromMetric(camera, yawRate, speed, 2.5, 3, camera.heading), options,
                                      rng)
        .ends;
}

const double INTERVAL = 0.05; // seconds between two frames

//! A corrector for motions, whose images don't show a point that could be tracked, beside an estimator of the same
//! settings.
class CorrectorOfFrames
{
public:
    CorrectorOfFrames() : camera(simulation::paperCamera())
    {
        params.estimator.wallDistance = 2.5;
        params.estimator.gravitySigma = 0;
        params.sequence = true;
        params.frameInterval = INTERVAL;
        corrector = RollingShutterCorrector::create(camera, params);
    }

    AckermannMotion frame(const Mat& segments) const
    {
        Mat dst;
        return corrector->correctWithSegments(Mat(camera.imageSize, CV_8U, Scalar(0)), segments, dst);
    }

    AckermannMotion alone(const Mat& segments, const MotionPrior& prior = MotionPrior()) const
    {
        return AckermannEstimator::create(camera, params.estimator)->estimate(segments, noArray(), prior);
    }

    //! The estimate some seconds after a frame with the given motion: the yaw rate forgets and wanders.
    AckermannMotion after(const AckermannMotion& before, double seconds, const Mat& segments) const
    {
        const double kept = std::exp(-seconds / 2), usual = 15 * CV_PI / 180;
        MotionPrior prior;
        // As it has been seen, without what is usual: the estimate knows that itself.
        const double variance = kept * kept * before.metricCovariance(camera)(0, 0) + (1 - kept * kept) * usual * usual;
        const double information = 1 / variance - 1 / (usual * usual);
        before.yawRate(camera, prior.yawRate);
        prior.yawRate *= kept / variance / information;
        prior.yawRateSigma = 1 / std::sqrt(information);
        return alone(segments, prior);
    }

    RollingShutterCamera camera;
    RollingShutterCorrector::Params params;
    Ptr<RollingShutterCorrector> corrector;
};

TEST(RSAckermann_Corrector, prior_is_used)
{
    CorrectorOfFrames c;
    MotionPrior prior;
    prior.speed = 20;
    prior.speedSigma = 0.1;
    prior.yawRate = 0.6;
    prior.yawRateSigma = 0.01;
    c.corrector->setPrior(prior);
    EXPECT_EQ(0.1, c.corrector->getPrior().speedSigma);
    EXPECT_EQ(0.6, c.corrector->getPrior().yawRate);
    const Mat segments = noisySegments(c.camera, 0.6, 20, 3);
    const AckermannMotion motion = c.frame(segments);
    expectSame(c.alone(segments, prior), motion);
    double yawRate = 0, speed = 0;
    ASSERT_TRUE(motion.yawRate(c.camera, yawRate) && motion.speed(c.camera, speed));
    EXPECT_NEAR(0.6, yawRate, 0.03);
    EXPECT_NEAR(20, speed, 0.3);

    prior.yawRateSigma = -1;
    EXPECT_THROW(c.corrector->setPrior(prior), cv::Exception);
    EXPECT_EQ(0.01, c.corrector->getPrior().yawRateSigma);
}

// Both go into the estimate of a single image.
TEST(RSAckermann_Corrector, gyro_that_contradicts_a_given_yaw_rate)
{
    CorrectorOfFrames c;
    c.params.sequence = false;
    c.corrector->setParams(c.params);
    MotionPrior prior;
    prior.yawRate = 0.6;
    prior.yawRateSigma = 0.02;
    c.corrector->setPrior(prior);
    const Mat segments = noisySegments(c.camera, 0.6, 20, 3);
    for (const double measured : {0.6, 0.64, 0.3})
    {
        c.corrector->clearGyro();
        Mat times(21, 1, CV_64F), rates(21, 3, CV_64F, Scalar(0));
        for (int i = 0; i < times.rows; i++)
            times.at<double>(i) = 0.02 * (i - 10);
        rates.col(1).setTo(measured);
        c.corrector->addGyro(times, rates);
        c.corrector->setTimestamp(0);
        const AckermannMotion motion = c.frame(segments);
        EXPECT_FALSE(motion.rotationCurve.empty());
        EXPECT_EQ(measured == 0.3, motion.contradictsPrior) << measured;
        if (motion.contradictsPrior)
        {
            EXPECT_NEAR(measured, motion.seenYawRate, 1e-9);
        }
    }
}

TEST(RSAckermann_Corrector, motion_is_carried_from_frame_to_frame)
{
    CorrectorOfFrames c;
    const Mat a = noisySegments(c.camera, 0.6, 20, 3), b = noisySegments(c.camera, 0.65, 20.5, 4);
    const AckermannMotion first = c.frame(a);
    ASSERT_EQ(MOTION_OK, first.status);
    expectSame(c.alone(a), first);
    const AckermannMotion second = c.frame(b), expected = c.after(first, INTERVAL, b);
    EXPECT_NEAR(expected.alpha, second.alpha, 1e-9);
    EXPECT_NEAR(expected.wallSlope, second.wallSlope, 1e-9);
    EXPECT_NE(c.alone(b).alpha, second.alpha);
}

// Gravity that isn't exact misleads all frames in the same way.
TEST(RSAckermann_Corrector, segments_alone_dont_confirm_one_another_if_gravity_is_uncertain)
{
    CorrectorOfFrames c;
    c.params.estimator.gravitySigma = 0.01;
    c.corrector->setParams(c.params);
    const Mat a = noisySegments(c.camera, 0.6, 20, 3), b = noisySegments(c.camera, 0.65, 20.5, 4);
    c.frame(a);
    expectSame(c.alone(b), c.frame(b));
}

TEST(RSAckermann_Corrector, motion_is_not_carried_unless_asked_for)
{
    CorrectorOfFrames c;
    c.params.sequence = false;
    c.corrector->setParams(c.params);
    const Mat a = noisySegments(c.camera, 0.6, 20, 3), b = noisySegments(c.camera, 0.65, 20.5, 4);
    c.frame(a);
    expectSame(c.alone(b), c.frame(b));
}

TEST(RSAckermann_Corrector, carried_motion_is_forgotten)
{
    CorrectorOfFrames c;
    const Mat a = noisySegments(c.camera, 0.6, 20, 3), b = noisySegments(c.camera, 0.65, 20.5, 4);
    c.frame(a);
    c.corrector->reset();
    expectSame(c.alone(b), c.frame(b));
    c.camera.height = 1.3;
    c.corrector->setCamera(c.camera);
    expectSame(c.alone(a), c.frame(a));
    // A frame of another time
    c.corrector->setTimestamp(1000);
    expectSame(c.alone(b), c.frame(b));
}

TEST(RSAckermann_Corrector, frames_without_estimate_between)
{
    CorrectorOfFrames c;
    const Mat a = noisySegments(c.camera, 0.6, 20, 3), b = noisySegments(c.camera, 0.65, 20.5, 4);
    const AckermannMotion first = c.frame(a);
    for (int i = 0; i < 3; i++)
        ASSERT_EQ(MOTION_TOO_FEW_SEGMENTS, c.frame(a.rowRange(0, 2)).status);
    EXPECT_NEAR(c.after(first, 4 * INTERVAL, b).alpha, c.frame(b).alpha, 1e-9);
}

//! A texture of which points can be tracked.
Mat texturedImage(const Size& size, int seed)
{
    RNG rng(seed);
    Mat noise(size, CV_8U), image;
    rng.fill(noise, RNG::UNIFORM, 0, 256);
    GaussianBlur(noise, image, Size(), 2);
    normalize(image, image, 0, 255, NORM_MINMAX);
    return image;
}

//! As a camera takes it again.
Mat taken(const Mat& image, int time)
{
    RNG rng(time);
    Mat noise(image.size(), CV_8S), result;
    rng.fill(noise, RNG::NORMAL, 0, 1);
    cv::add(image, noise, result, noArray(), CV_8U);
    return result;
}

// After a cut a frame is as good as alone, whatever was known before.
TEST(RSAckermann_Corrector, another_scene_is_recognised)
{
    CorrectorOfFrames c;
    const Mat a = noisySegments(c.camera, 0.6, 20, 3), b = noisySegments(c.camera, 0.65, 20.5, 4);
    const Mat image = texturedImage(c.camera.imageSize, 1);
    Mat dst;
    for (int i = 0; i < 3; i++)
        c.corrector->correctWithSegments(taken(image, i), a, dst);
    const AckermannMotion known = c.corrector->correctWithSegments(taken(image, 3), a, dst);
    EXPECT_EQ(MOTION_NOT_SIGNIFICANT, known.status)
        << "what stays where it is is seen by a camera at rest, whatever the segments say";
    expectSame(c.alone(b), c.corrector->correctWithSegments(texturedImage(c.camera.imageSize, 2), b, dst));
}

// It shows no more than before, but what is given may be more.
TEST(RSAckermann_Corrector, first_image_again)
{
    CorrectorOfFrames c;
    const Mat a = noisySegments(c.camera, 0.6, 20, 3), image = texturedImage(c.camera.imageSize, 1);
    const Ptr<AckermannEstimator> alone = AckermannEstimator::create(c.camera, c.params.estimator);
    Mat dst, labels;
    for (const double yawRate : {0., 0.5, 0.7})
    {
        MotionPrior prior;
        prior.yawRate = yawRate;
        prior.yawRateSigma = yawRate > 0 ? 0.01 : 0;
        c.corrector->setPrior(prior);
        EXPECT_EQ(alone->estimate(a, labels, prior).alpha, c.corrector->correctWithSegments(image, a, dst).alpha)
            << yawRate;
        EXPECT_FALSE(c.corrector->isTracked());
    }
}

//! The image of a street after some steps in a bend to the right.
Mat approached(const Mat& street, int steps)
{
    const double larger = 1 + 0.03 * steps, kept = (1 - larger) / 2;
    const Matx23d change(larger, 0, kept * street.cols - 4 * steps, 0, larger, kept * street.rows);
    Mat image;
    warpAffine(street, image, change, street.size(), INTER_CUBIC, BORDER_REFLECT);
    return image;
}

// As between two street lamps. It ends with the scene, a second after the last frame that showed something.
TEST(RSAckermann_Corrector, frame_that_shows_nothing_goes_on_as_expected)
{
    CorrectorOfFrames c;
    const Mat street = texturedImage(c.camera.imageSize, 1), nothing(0, 4, CV_32F);
    for (int again = 0; again < 2; again++)
    {
        Mat dst;
        AckermannMotion motion;
        for (int i = 0; i < 4; i++)
            motion = c.corrector->correctWithSegments(approached(street, i), nothing, dst);
        ASSERT_EQ(MOTION_OK, motion.status);
        EXPECT_FALSE(motion.inverseDepthOffset.empty()) << "the texture isn't on the planes of a street";
        const double sigma = motion.covariance(0, 0);
        double seen = 0, yawRate = 0, propagated = 0;
        ASSERT_TRUE(motion.yawRate(c.camera, seen));
        EXPECT_GT(seen, 0.02);
        if (again)
        {
            c.corrector->reset();
            EXPECT_EQ(MOTION_TOO_FEW_SEGMENTS, c.frame(nothing).status);
            continue;
        }
        for (int i = 1; i * INTERVAL < 1 - 1e-6; i++)
        {
            motion = c.frame(nothing);
            ASSERT_EQ(MOTION_OK, motion.status) << i;
            EXPECT_LT(motion.expectedResidual, motion.expectedRaw);
            EXPECT_EQ(0, motion.candidates);
            EXPECT_TRUE(motion.inverseDepthOffset.empty());
            motion.yawRate(c.camera, yawRate);
            // That of the interval: the one of the instant has been seen to differ a little.
            if (i == 1)
                propagated = yawRate * std::exp(INTERVAL / 2);
            EXPECT_NEAR(seen, propagated, 2 * std::sqrt(sigma) / c.camera.secondsPerUnitTime());
            EXPECT_NEAR(propagated * std::exp(-i * INTERVAL / 2), yawRate, 1e-6);
        }
        EXPECT_GT(motion.covariance(0, 0), 2 * sigma);
        EXPECT_EQ(MOTION_TOO_FEW_SEGMENTS, c.frame(nothing).status);
    }
}

TEST(RSAckermann_Corrector, points_arent_tracked_unless_asked_for)
{
    CorrectorOfFrames c;
    c.params.trackPoints = false;
    c.corrector->setParams(c.params);
    const Mat a = noisySegments(c.camera, 0.6, 20, 3);
    Mat dst;
    for (int i = 0; i < 3; i++)
        EXPECT_EQ(MOTION_OK, c.corrector->correctWithSegments(texturedImage(c.camera.imageSize, 1), a, dst).status)
            << i;
}

TEST(RSAckermann_Corrector, next_frame)
{
    CorrectorOfFrames c;
    const Mat a = noisySegments(c.camera, 0.6, 20, 3), image = texturedImage(c.camera.imageSize, 1);
    Mat dst;
    // What stays where it is in the next image is at rest; that is used once.
    c.corrector->setNextFrame(taken(image, 1), std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(MOTION_NOT_SIGNIFICANT, c.corrector->correctWithSegments(image, a, dst).status);
    EXPECT_TRUE(c.corrector->isTracked());
    c.corrector->reset();
    EXPECT_EQ(MOTION_OK, c.corrector->correctWithSegments(image, a, dst).status);
    EXPECT_FALSE(c.corrector->isTracked());
    EXPECT_THROW(c.corrector->setNextFrame(Mat(10, 10, CV_8U, Scalar(0)), 1), cv::Exception);
}

TEST(RSAckermann_Corrector, tells_whether_points_showed_the_motion)
{
    CorrectorOfFrames c;
    const Mat nothing(0, 4, CV_32F), image = texturedImage(c.camera.imageSize, 1);
    Mat dst;
    const auto isTracked = [&](double seconds) {
        c.corrector->setTimestamp(seconds);
        c.corrector->correctWithSegments(image, nothing, dst);
        return c.corrector->isTracked();
    };
    EXPECT_FALSE(isTracked(1));
    EXPECT_TRUE(isTracked(1 + INTERVAL));
    c.frame(nothing); // black
    EXPECT_FALSE(c.corrector->isTracked());
    EXPECT_TRUE(isTracked(1 + 3 * INTERVAL)); // in the frame before that
    EXPECT_TRUE(isTracked(1 + 4 * INTERVAL));
    c.corrector->correctWithMotion(image, AckermannMotion(), dst);
    EXPECT_FALSE(c.corrector->isTracked());
    for (double milliseconds : {2000., 2050., 2100.}) // as seconds: no frame follows another
        EXPECT_FALSE(isTracked(milliseconds));
    EXPECT_TRUE(isTracked(2100 + INTERVAL));
    c.params.sequence = false;
    c.corrector->setParams(c.params);
    EXPECT_FALSE(isTracked(2100 + INTERVAL));
}

// A recorded drive has the time to track more points.
TEST(RSAckermann_Corrector, next_frame_refines_the_offset)
{
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(1600, 900));
    camera.lineDelay = 0.02 / 900;
    RollingShutterCorrector::Params params;
    params.sequence = true;
    params.frameInterval = INTERVAL;
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera, params);
    const Mat street = texturedImage(camera.imageSize, 1), nothing(0, 4, CV_32F);
    Mat dst;
    size_t values[4] = {0};
    for (int i = 0; i < 4; i++)
    {
        // Once the next frame is left out.
        if (i != 2)
            corrector->setNextFrame(approached(street, i + 1), std::numeric_limits<double>::quiet_NaN());
        const AckermannMotion motion = corrector->correctWithSegments(approached(street, i), nothing, dst);
        ASSERT_EQ(MOTION_OK, motion.status) << i;
        values[i] = motion.inverseDepthOffset.total();
    }
    EXPECT_GT(values[1], 2 * values[2]);
    EXPECT_GT(values[3], values[2]);
    // The frame before wasn't looked at closely: the points to it would be those to another one.
    EXPECT_LT(values[3], 0.8 * values[1]);
}

TEST(RSAckermann_Corrector, carrying_pays_in_a_steady_drive)
{
    CorrectorOfFrames c;
    const double trueYawRate = 0.5, trueSpeed = 15;
    const Simulator truth = Simulator::fromMetric(c.camera, trueYawRate, trueSpeed, 2.5, 3, 0);
    const int frames = 40, skipped = 5;
    Vec2d error[2]; // of the yaw rate and of the places of pixels, without and with the frame before
    for (int i = 0; i < frames; i++)
    {
        const Mat segments = noisySegments(c.camera, trueYawRate, trueSpeed, 100 + i);
        for (int carried = 0; carried < 2; carried++)
        {
            const AckermannMotion motion = carried ? c.frame(segments) : c.alone(segments);
            double yawRate = 0;
            motion.yawRate(c.camera, yawRate);
            if (i >= skipped)
                error[carried] += Vec2d(std::abs(yawRate - trueYawRate),
                                        truth.meanDisplacement(Simulator::fromMotion(c.camera, motion)));
        }
    }
    for (int k = 0; k < 2; k++)
        EXPECT_LT(error[1][k], 0.9 * error[0][k]) << k;
}

// An image without a motion is copied only if the other one is to have its size and its focal length.
TEST(RSAckermann_Corrector, another_image_without_a_motion)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Mat image(camera.imageSize, CV_8UC1, Scalar(9));
    RollingShutterCorrector::Params smaller, longer, both;
    smaller.warp.newSize = Size(320, 190);
    longer.warp.newCameraMatrix = camera.cameraMatrix;
    longer.warp.newCameraMatrix(0, 0) *= 2;
    both.warp.newSize = smaller.warp.newSize;
    both.warp.newCameraMatrix = Matx33d(408, 0, 159.5, 0, 408, 94.5, 0, 0, 1);
    for (const RollingShutterCorrector::Params& params : {smaller, longer, both})
    {
        const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera, params);
        Mat dst, mask, map1, map2, expected1, expected2;
        corrector->correct(image, dst, mask);
        corrector->getMaps(map1, map2);
        WarpMapGenerator::create(camera, params.warp)
            ->initRectifyMap(AckermannMotion(), expected1, expected2, CV_32FC1);
        ASSERT_EQ(expected1.size(), dst.size());
        EXPECT_EQ(expected1.size(), mask.size());
        ASSERT_EQ(expected1.size(), map1.size());
        EXPECT_EQ(0, cvtest::norm(map1, expected1, NORM_INF));
        EXPECT_EQ(0, cvtest::norm(map2, expected2, NORM_INF));
    }
}

TEST(RSAckermann_Corrector, bad_arguments)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera);
    Mat dst;
    EXPECT_THROW(RollingShutterCorrector::create(RollingShutterCamera()), cv::Exception);
    EXPECT_THROW(corrector->correct(Mat(), dst), cv::Exception);
    EXPECT_THROW(corrector->correct(noiseImage(Size(380, 640), CV_8UC1), dst), cv::Exception);
    EXPECT_THROW(corrector->correct(Mat(camera.imageSize, CV_8UC2, Scalar(0)), dst), cv::Exception);
    EXPECT_THROW(
        corrector->correctWithSegments(noiseImage(camera.imageSize, CV_8UC1), Mat(5, 3, CV_32F, Scalar(1)), dst),
        cv::Exception);

    RollingShutterCorrector::Params params;
    params.interpolation = INTER_AREA;
    EXPECT_THROW(corrector->setParams(params), cv::Exception);
    params = RollingShutterCorrector::Params();
    params.warp.tolerance = -1;
    EXPECT_THROW(corrector->setParams(params), cv::Exception);
    params = RollingShutterCorrector::Params();
    params.estimator.threshold = -1;
    EXPECT_THROW(corrector->setParams(params), cv::Exception);
    params = RollingShutterCorrector::Params();
    params.frameInterval = 0;
    EXPECT_THROW(corrector->setParams(params), cv::Exception);
}

}} // namespace opencv_test::
