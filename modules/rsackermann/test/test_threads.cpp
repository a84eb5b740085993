// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_threads.hpp"

// What the headers promise of threads that the caller starts. The tests are meant for a thread sanitizer, too.

namespace opencv_test { namespace {

TEST(RSAckermann_Threads, one_estimator)
{
    AckermannEstimator::Params params;
    for (int exact = 0; exact < 2; exact++)
    {
        params.gravitySigma = exact ? 0 : params.gravitySigma; // by a consensus, or by an average
        const Ptr<AckermannEstimator> estimator = AckermannEstimator::create(simulation::paperCamera(), params);
        AckermannMotion expected[THREADS], motions[THREADS], fromImage[THREADS];
        Mat labels[THREADS], found[THREADS];
        for (int i = 0; i < THREADS; i++)
            expected[i] = estimator->estimate(streetSegments(i));
        inThreads([&](int i) {
            motions[i] = estimator->estimate(streetSegments(i), labels[i]);
            fromImage[i] = estimator->estimateFromImage(streetImage(i), found[i]);
        });
        for (int i = 0; i < THREADS; i++)
        {
            expectSame(expected[i], motions[i]);
            expectSame(estimator->estimate(found[i]), fromImage[i]);
        }
    }
}

TEST(RSAckermann_Threads, one_generator)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const int types[] = {CV_32FC1, CV_32FC2, CV_16SC2, CV_16SC2};
    Mat expected1[THREADS], expected2[THREADS], map1[THREADS], map2[THREADS], mask[THREADS];
    std::vector<Point2f> there[THREADS], back[THREADS];
    Rect roi[THREADS];
    const std::vector<Point2f> points(1, Point2f(201, 77));
    const auto motionOf = [&](int i) { return motionFromMetric(camera, 0.2 * i, 15, 2.5, 3, 0); };
    for (int i = 0; i < THREADS; i++)
        generator->initRectifyMap(motionOf(i), expected1[i], expected2[i], types[i]);
    inThreads([&](int i) {
        const AckermannMotion motion = motionOf(i);
        generator->initRectifyMap(motion, map1[i], map2[i], types[i], mask[i]);
        generator->correctPoints(motion, points, there[i]);
        generator->distortPoints(motion, there[i], back[i]);
        roi[i] = generator->validRoi(motion);
    });
    for (int i = 0; i < THREADS; i++)
    {
        EXPECT_EQ(0, cvtest::norm(expected1[i], map1[i], NORM_INF));
        if (types[i] != CV_32FC2)
        {
            EXPECT_EQ(0, cvtest::norm(expected2[i], map2[i], NORM_INF));
        }
        EXPECT_LT(cv::norm(back[i][0] - points[0]), 0.01);
        EXPECT_EQ(generator->validRoi(motionOf(i)), roi[i]);
    }
}

TEST(RSAckermann_Threads, one_value)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const AckermannMotion motion = motionFromMetric(camera, 0.6, 20, 2.5, 3, 0);
    double yawRate[THREADS];
    std::string text[THREADS];
    inThreads([&](int i) {
        motion.yawRate(camera, yawRate[i]);
        FileStorage out(".yml", FileStorage::WRITE | FileStorage::MEMORY);
        motion.write(out);
        camera.write(out);
        text[i] = out.releaseAndGetString();
    });
    for (int i = 0; i < THREADS; i++)
    {
        EXPECT_NEAR(0.6, yawRate[i], 1e-12);
        EXPECT_EQ(text[0], text[i]);
    }
}

}} // namespace
