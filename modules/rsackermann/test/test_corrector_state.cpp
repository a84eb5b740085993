// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// What a corrector keeps from call to call: each history in each mode against each property.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "opencv2/rsackermann/corrector.hpp"
#include "opencv2/imgproc.hpp"
#include "test_simulator.hpp"
#include <functional>

namespace opencv_test { namespace {

const double INTERVAL = 0.05;

//! A camera in a street of texture, whose frames approach it in a bend to the right.
struct Sequence
{
    RollingShutterCamera camera = simulation::paperCamera();
    Mat street, segments;

    Sequence()
    {
        RNG rng(1);
        Mat noise(camera.imageSize, CV_8U);
        rng.fill(noise, RNG::UNIFORM, 0, 256);
        GaussianBlur(noise, street, Size(), 2);
        normalize(street, street, 0, 255, NORM_MINMAX);
        const simulation::Simulator simulator = simulation::Simulator::fromMetric(camera, 0.6, 20, 2.5, 3, 0);
        segments = simulation::randomSegments(simulator, simulation::SegmentOptions(), rng).ends;
    }

    Mat frame(int i) const
    {
        const double larger = std::pow(1.03, i), kept = (1 - larger) / 2;
        const Matx23d change(larger, 0, kept * street.cols - 4 * i, 0, larger, kept * street.rows);
        Mat image;
        warpAffine(street, image, change, street.size(), INTER_CUBIC, BORDER_REFLECT);
        return image;
    }
};

enum Mode { ALONE, CARRIED, UNTRACKED, MODES };

Ptr<RollingShutterCorrector> createCorrector(const RollingShutterCamera& camera, int mode)
{
    RollingShutterCorrector::Params params;
    params.sequence = mode != ALONE;
    params.trackPoints = mode == CARRIED;
    params.frameInterval = INTERVAL;
    params.estimator.gravitySigma = 0;
    params.estimator.wallDistance = 2.5;
    return RollingShutterCorrector::create(camera, params);
}

typedef RollingShutterCorrector Corrector;

struct History
{
    const char* name;
    std::function<void(Corrector&, const Sequence&)> make;
};

AckermannMotion correctFrame(Corrector& corrector, const Sequence& s, int i, bool isBlank = false)
{
    Mat dst;
    return corrector.correctWithSegments(isBlank ? Mat(s.street.size(), CV_8U, Scalar(9)) : s.frame(i),
                                         isBlank ? Mat() : s.segments, dst);
}

MotionPrior givenYawRate(double yawRate, double sigma)
{
    MotionPrior prior;
    prior.yawRate = yawRate;
    prior.yawRateSigma = sigma;
    return prior;
}

const History HISTORIES[] = {{"nothing", [](Corrector&, const Sequence&) {}},
                             {"frames",
                              [](Corrector& c, const Sequence& s) {
                                  for (int i = 0; i < 3; i++)
                                      correctFrame(c, s, i);
                              }},
                             {"given values",
                              [](Corrector& c, const Sequence& s) {
                                  c.setPrior(givenYawRate(0.1, 0.05));
                                  for (int i = 0; i < 3; i++)
                                      correctFrame(c, s, i);
                                  c.setPrior(MotionPrior());
                              }},
                             {"copied image", [](Corrector& c, const Sequence& s) { correctFrame(c, s, 0, true); }},
                             {"known motion",
                              [](Corrector& c, const Sequence& s) {
                                  Mat dst;
                                  c.correctWithMotion(s.street, exampleMotion(), dst);
                              }},
                             {"device",
                              [](Corrector& c, const Sequence& s) {
                                  UMat dst;
                                  c.correctWithSegments(s.street.getUMat(ACCESS_READ), s.segments, dst);
                              }},
                             {"next frame", [](Corrector& c, const Sequence& s) { c.setNextFrame(s.frame(7), 0.3); }},
                             {"time", [](Corrector& c, const Sequence&) { c.setTimestamp(77); }},
                             {"late frame",
                              [](Corrector& c, const Sequence& s) {
                                  c.setTimestamp(1e11);
                                  correctFrame(c, s, 0);
                              }},
                             {"times that jitter",
                              [](Corrector& c, const Sequence& s) {
                                  for (int i = 0; i < 8; i++)
                                  {
                                      c.setTimestamp((i + 0.3 * (i % 2)) * INTERVAL);
                                      correctFrame(c, s, i);
                                  }
                              }},
                             {"skipped frame", [](Corrector& c, const Sequence&) { c.skipFrame(); }},
                             {"exception",
                              [](Corrector& c, const Sequence& s) {
                                  Mat dst;
                                  EXPECT_THROW(c.correctWithSegments(s.street, Mat(5, 3, CV_32F, Scalar(1)), dst),
                                               cv::Exception);
                                  EXPECT_THROW(c.setTimestamp(1e300), cv::Exception);
                              }},
                             {"camera and back", [](Corrector& c, const Sequence& s) {
                                  RollingShutterCamera other = s.camera;
                                  other.setRollPitch(0.1, 0.1);
                                  c.setCamera(other);
                                  correctFrame(c, s, 0);
                                  c.setCamera(s.camera);
                              }}};

//! The same but for the rounding of times that are sums.
void expectNear(const AckermannMotion& expected, const AckermannMotion& motion)
{
    EXPECT_EQ(expected.status, motion.status);
    EXPECT_NEAR(expected.alpha, motion.alpha, 1e-6);
    EXPECT_NEAR(expected.covariance(0, 0), motion.covariance(0, 0), 1e-6 * expected.covariance(0, 0));
}

typedef testing::TestWithParam<int> CorrectorState; // Mode

// What is refused hasn't happened: the same frame can be given again.
TEST_P(CorrectorState, refused_arguments_leave_the_sequence_as_it_was)
{
    const Sequence s;
    const Ptr<Corrector> corrector = createCorrector(s.camera, GetParam()),
                         undisturbed = createCorrector(s.camera, GetParam());
    for (int i = 0; i < 4; i++)
    {
        const Mat frame = s.frame(i);
        Mat dst, expected;
        Mat_<Vec3s> typed;
        std::vector<Mat> list(1);
        const auto correct = [&](InputArray segments, OutputArray result, OutputArray mask) {
            return corrector->correctWithSegments(frame, segments, result, mask);
        };
        EXPECT_THROW(correct(Mat(5, 3, CV_32F, Scalar(1)), dst, noArray()), cv::Exception);
        EXPECT_THROW(correct(s.segments, typed, noArray()), cv::Exception);
        EXPECT_THROW(correct(s.segments, noArray(), noArray()), cv::Exception);
        EXPECT_THROW(correct(s.segments, dst, typed), cv::Exception);
        EXPECT_THROW(correct(s.segments, dst, list), cv::Exception);
        EXPECT_THROW(corrector->correct(frame, typed), cv::Exception);
        const AckermannMotion motion = undisturbed->correctWithSegments(frame, s.segments, expected);
        expectSame(motion, correct(s.segments, dst, noArray()));
        EXPECT_EQ(0, cvtest::norm(expected, dst, NORM_INF)) << i;
    }
}

// After reset() or clear() a corrector is like a new one; clear() forgets what was given, too. What is given then is
// compared with what is seen from there on.
TEST_P(CorrectorState, reset_and_clear_forget_every_history)
{
    const Sequence s;
    const MotionPrior prior = givenYawRate(1, 0.01);
    const Mat times = (Mat_<double>(3, 1) << -0.05, 0, 0.05), rates(3, 3, CV_64F, Scalar(0.5));
    for (const History& history : HISTORIES)
        for (const bool isCleared : {false, true})
        {
            SCOPED_TRACE(testing::Message() << history.name << isCleared);
            const Ptr<Corrector> used = createCorrector(s.camera, GetParam()),
                                 unused = createCorrector(s.camera, GetParam());
            history.make(*used, s);
            if (isCleared)
            {
                used->setPrior(prior);
                used->addGyro(times, rates);
                used->clear();
                EXPECT_EQ(0, used->getPrior().yawRateSigma);
            }
            else
                used->reset();
            for (int i = 0; i < 3; i++)
            {
                if (i > 0 && !isCleared)
                    for (Corrector* c : {used.get(), unused.get()})
                        c->setPrior(prior);
                Mat dst, expected;
                const AckermannMotion motion = used->correctWithSegments(s.frame(i), s.segments, dst);
                expectSame(unused->correctWithSegments(s.frame(i), s.segments, expected), motion);
                EXPECT_EQ(0, cvtest::norm(expected, dst, NORM_INF)) << i;
            }
        }
}

// An image that comes again after a reset is the first one.
TEST_P(CorrectorState, reset_forgets_the_last_image)
{
    const Sequence s;
    const Ptr<Corrector> used = createCorrector(s.camera, GetParam()), unused = createCorrector(s.camera, GetParam());
    Mat dst, expected;
    for (int i = 0; i < 4; i++)
        used->correctWithSegments(s.frame(i), s.segments, dst);
    used->reset();
    const AckermannMotion motion = used->correctWithSegments(s.frame(3), s.segments, dst);
    expectSame(unused->correctWithSegments(s.frame(3), s.segments, expected), motion);
    EXPECT_EQ(0, cvtest::norm(expected, dst, NORM_INF));
}

// getMaps() is of the last image, whatever the one before was.
TEST_P(CorrectorState, maps_are_those_of_the_last_image)
{
    const Sequence s;
    for (const History& before : HISTORIES)
        for (const bool isBlank : {false, true})
        {
            SCOPED_TRACE(testing::Message() << before.name << isBlank);
            const Ptr<Corrector> corrector = createCorrector(s.camera, GetParam());
            before.make(*corrector, s);
            Mat dst, mask, map1, map2, expected;
            const Mat image = isBlank ? Mat(s.street.size(), CV_8U, Scalar(9)) : s.frame(4);
            if (isBlank)
                corrector->correctWithMotion(image, AckermannMotion(), dst, mask);
            else
                corrector->correctWithMotion(image, exampleMotion(), dst, mask);
            corrector->getMaps(map1, map2);
            remap(image, expected, map1, map2, INTER_LINEAR);
            EXPECT_EQ(0, cvtest::norm(expected, dst, NORM_INF));
        }
}

// A time holds for one image; the one after it is an interval later, whether the image between was there or not.
// Of an image with a motion that is given there is nothing of an earlier image to be had.
TEST_P(CorrectorState, motion_that_is_given_after_an_image)
{
    const Sequence sequence;
    const Ptr<Corrector> used = createCorrector(sequence.camera, GetParam()),
                         unused = createCorrector(sequence.camera, GetParam());
    Mat corrected, expected;
    const AckermannMotion motion =
        used->correctWithSegments(sequence.frame(0), sequence.segments, corrected, noArray(), DepthMap());
    ASSERT_EQ(MOTION_OK, motion.status);
    for (Corrector* c : {used.get(), unused.get()})
    {
        Mat segments, labels, maps[2];
        c->correctWithMotion(sequence.frame(1), motion, c == used.get() ? corrected : expected);
        c->getSegments(segments, labels);
        EXPECT_TRUE(segments.empty());
        EXPECT_TRUE(labels.empty());
        EXPECT_FALSE(c->isDepthUsed());
        EXPECT_EQ(0, c->getTimings()[0] + c->getTimings()[1]);
    }
    EXPECT_EQ(0, cv::norm(expected, corrected, NORM_INF));
}

TEST_P(CorrectorState, time_of_a_frame)
{
    const Sequence s;
    for (const bool isSkipped : {false, true})
        for (const bool isFirstSet : {false, true})
        {
            SCOPED_TRACE(testing::Message() << isSkipped << isFirstSet);
            const Ptr<Corrector> given = createCorrector(s.camera, GetParam()),
                                 assumed = createCorrector(s.camera, GetParam());
            for (int i = 0; i < 5; i++)
            {
                given->setTimestamp(100 + i * INTERVAL);
                if (i == 0 && isFirstSet)
                    assumed->setTimestamp(5);
                if (isSkipped && i == 2)
                {
                    assumed->skipFrame();
                    continue;
                }
                SCOPED_TRACE(i);
                expectNear(correctFrame(*given, s, i), correctFrame(*assumed, s, i));
            }
        }
}

// Frames that are lost, and clocks that are set back, change nothing of the others, or leave them less certain.
TEST(RSAckermann_CorrectorState, random_events_in_a_sequence)
{
    Sequence s;
    s.segments = Mat(); // they show the motion of another street
    const int frames = 8;
    std::vector<AckermannMotion> undisturbed;
    const Ptr<Corrector> reference = createCorrector(s.camera, CARRIED);
    for (int i = 0; i < frames; i++)
        undisturbed.push_back(correctFrame(*reference, s, i));
    RNG rng(7);
    int compared = 0;
    for (int round = 0; round < 30; round++)
    {
        const Ptr<Corrector> corrector = createCorrector(s.camera, CARRIED);
        double clock = 0;
        for (int i = 0; i < frames; i++)
        {
            const int event = rng.uniform(0, 9);
            clock += INTERVAL;
            if (event == 0 && i > 0) // lost
            {
                corrector->skipFrame();
                continue;
            }
            if (event == 1 && i > 0) // its time is known, and that of the lost one before isn't given
            {
                if (++i == frames)
                    break;
                clock += INTERVAL;
            }
            if (event == 2) // of another size
            {
                Mat dst;
                EXPECT_THROW(corrector->correct(s.frame(i).rowRange(0, 50), dst), cv::Exception);
                corrector->skipFrame();
                continue;
            }
            if (event == 3)
                clock -= 0.3;
            if (event == 4 && i > 1) // repeated, or one that is late: with its own time, a new sequence
            {
                const bool isLate = rng.uniform(0, 2) == 1;
                corrector->setTimestamp(clock - (isLate ? 2 : 1) * INTERVAL);
                correctFrame(*corrector, s, i - (isLate ? 2 : 1));
            }
            corrector->setTimestamp(clock);
            const AckermannMotion motion = correctFrame(*corrector, s, i);
            if (i < 2 || motion.status != MOTION_OK || event == 3)
                continue;
            compared++;
            // The scale of the picture grows from frame to frame, so that frames further apart see a little more.
            const double sigma = std::sqrt(motion.covariance(0, 0) + undisturbed[i].covariance(0, 0));
            EXPECT_NEAR(undisturbed[i].alpha, motion.alpha, 3 * sigma) << round << ", " << i;
        }
    }
    EXPECT_GT(compared, 60);
}

// The interval to the frame before is unknown then.
TEST(RSAckermann_CorrectorState, clock_that_is_set_back_begins_another_sequence)
{
    const Sequence s;
    for (const double step : {0., -0.001, -0.3, -1000.})
    {
        const Ptr<Corrector> used = createCorrector(s.camera, CARRIED), unused = createCorrector(s.camera, CARRIED);
        used->setTimestamp(50);
        for (int i = 0; i < 3; i++)
            correctFrame(*used, s, i);
        used->setTimestamp(50 + 2 * INTERVAL + step);
        for (int i = 3; i < 5; i++)
            expectNear(correctFrame(*unused, s, i), correctFrame(*used, s, i));
        // Nor is a next frame one that was taken before.
        used->setNextFrame(s.frame(6), 50 + 4 * INTERVAL + step - 0.2);
        expectNear(correctFrame(*unused, s, 5), correctFrame(*used, s, 5));
    }
}

// One that is taken long after shows another scene.
// An image that isn't later, or only by what times are rounded, is none after it, nor is one that is much later.
TEST(RSAckermann_CorrectorState, next_frame_at_another_time)
{
    const Sequence s;
    for (const double next : {-INTERVAL, 0., 5e-5, INTERVAL, 1.5})
    {
        SCOPED_TRACE(next);
        const Ptr<Corrector> with = createCorrector(s.camera, CARRIED), without = createCorrector(s.camera, CARRIED);
        with->setTimestamp(0);
        without->setTimestamp(0);
        with->setNextFrame(s.frame(1), next);
        const AckermannMotion expected = correctFrame(*without, s, 0), motion = correctFrame(*with, s, 0);
        if (next == INTERVAL)
            EXPECT_NE(expected.alpha, motion.alpha);
        else
            expectSame(expected, motion);
    }
}

// All of the camera but gravity and uncertainties is that of a sequence.
TEST(RSAckermann_CorrectorState, camera_of_a_sequence)
{
    const Sequence s;
    typedef RollingShutterCamera Camera;
    const std::pair<const char*, std::function<void(Camera&)>> changes[] = {
        {"cameraMatrix", [](Camera& c) { c.cameraMatrix(0, 2) += 1; }},
        {"distCoeffs",
         [](Camera& c) {
             c.distCoeffs = {0.01, 0, 0, 0};
         }},
        {"lensModel",
         [](Camera& c) {
             c.distCoeffs = {0.01, 0, 0, 0};
             c.lensModel = LENS_FISHEYE;
         }},
        {"scanDirection", [](Camera& c) { c.scanDirection = SCAN_BOTTOM_TO_TOP; }},
        {"lineDelay", [](Camera& c) { c.lineDelay *= 1.1; }},
        {"referenceRow", [](Camera& c) { c.referenceRow += 5; }},
        {"heading", [](Camera& c) { c.heading += 0.01; }},
        {"height", [](Camera& c) { c.height += 0.1; }},
        {"uprightRotation", [](Camera& c) { c.setRollPitch(0, 0.001); }},
        {"focalSigma", [](Camera& c) { c.focalSigma += 1; }},
        {"lineDelaySigma", [](Camera& c) { c.lineDelaySigma += 1e-7; }}};
    for (const auto& change : changes)
    {
        SCOPED_TRACE(change.first);
        const bool isKept = std::string(change.first) == "uprightRotation" ||
                            std::string(change.first).find("Sigma") != std::string::npos;
        RollingShutterCamera camera = s.camera;
        change.second(camera);
        const Ptr<Corrector> used = createCorrector(s.camera, CARRIED), unused = createCorrector(camera, CARRIED);
        for (int i = 0; i < 3; i++)
            correctFrame(*used, s, i);
        used->setCamera(camera);
        const AckermannMotion fresh = correctFrame(*unused, s, 3), carried = correctFrame(*used, s, 3);
        if (isKept)
            EXPECT_NE(fresh.alpha, carried.alpha);
        else
            expectSame(fresh, carried);
    }
}

// Parameters of the estimator that tracked frames use, and those that only frames use that are estimated alone.
TEST(RSAckermann_CorrectorState, parameters_of_tracked_frames)
{
    const Sequence s;
    typedef AckermannEstimator::Params Params;
    struct Change
    {
        const char* name;
        bool hasEffect;
        std::function<void(Params&)> make;
    };
    const Change changes[] = {
        {"minLength", true, [](Params& p) { p.minLength = 120; }},
        {"threshold", true, [](Params& p) { p.threshold = 5; }},
        {"limits of slants", true, [](Params& p) { p.slantTolerance = p.maxYawRate = p.maxSpeed = 0.01; }},
        {"wallDistance", true, [](Params& p) { p.wallDistance = 7; }},
        {"gravitySigma", true, [](Params& p) { p.gravitySigma = 0.02; }},
        {"priorYawRate", true, [](Params& p) { p.priorYawRate = 0.001; }},
        {"wallDeviationSigma", true, [](Params& p) { p.wallDeviationSigma = 0.01; }},
        {"priorSpeed", true, [](Params& p) { p.priorSpeed = 3; }},
        {"priorWallDistance", true, [](Params& p) { p.priorWallDistance = 50; }},
        {"standingProbability", true, [](Params& p) { p.standingProbability = 0.9; }},
        {"seed", false, [](Params& p) { p.seed = 5; }},
        {"confidence", false, [](Params& p) { p.confidence = 0.5; }},
        {"maxIterations", false, [](Params& p) { p.maxIterations = 3; }},
        {"minCandidates", false, [](Params& p) { p.minCandidates = 1000; }},
        {"reverseProbability", false, [](Params& p) { p.reverseProbability = 0.4; }}};
    const auto lastOf = [&s](const Params* estimator) {
        const Ptr<Corrector> corrector = createCorrector(s.camera, CARRIED);
        RollingShutterCorrector::Params params = corrector->getParams();
        if (estimator)
            params.estimator = *estimator;
        corrector->setParams(params);
        AckermannMotion motion;
        for (int i = 0; i < 3; i++)
        {
            corrector->setNextFrame(s.frame(i + 1), NaN); // so that the first one is tracked, too
            motion = correctFrame(*corrector, s, i);
        }
        return motion;
    };
    const AckermannMotion plain = lastOf(0);
    ASSERT_EQ(MOTION_OK, plain.status);
    for (const Change& change : changes)
    {
        SCOPED_TRACE(change.name);
        Params params = createCorrector(s.camera, CARRIED)->getParams().estimator;
        change.make(params);
        const AckermannMotion motion = lastOf(&params);
        const bool isSame = motion.alpha == plain.alpha && motion.candidates == plain.candidates &&
                            motion.inliers == plain.inliers && motion.wallDistance == plain.wallDistance &&
                            motion.status == plain.status;
        EXPECT_EQ(!change.hasEffect, isSame);
    }
    // A model is of a single image.
    RollingShutterCorrector::Params params = createCorrector(s.camera, CARRIED)->getParams();
    params.estimator.model = MODEL_NONE;
    EXPECT_THROW(params.check(), cv::Exception);
    params.trackPoints = false;
    EXPECT_NO_THROW(params.check());
}

// Points of images that are far apart aren't taken for those of neighbours.
TEST(RSAckermann_CorrectorState, points_again_after_images_without)
{
    const Sequence s;
    for (const int without : {1, 3, 6})
    {
        const Ptr<RollingShutterCorrector> always = createCorrector(s.camera, CARRIED),
                                           again = createCorrector(s.camera, CARRIED);
        RollingShutterCorrector::Params params = always->getParams();
        for (int i = 0; i < 12; i++)
        {
            params.trackPoints = i < 4 || i >= 4 + without;
            again->setParams(params);
            const AckermannMotion expected = correctFrame(*always, s, i), motion = correctFrame(*again, s, i);
            if (!params.trackPoints || i < 4)
                continue;
            EXPECT_EQ(i > 4 + without, again->isTracked()) << i;
            double yawRate, expectedRate;
            ASSERT_TRUE(expected.yawRate(s.camera, expectedRate));
            const bool isKnown = motion.yawRate(s.camera, yawRate);
            EXPECT_TRUE(!isKnown ||
                        std::abs(yawRate - expectedRate) < 3 * std::sqrt(motion.metricCovariance(s.camera)(0, 0)))
                << yawRate << " for " << expectedRate << ", " << without << " at " << i;
        }
    }
}

INSTANTIATE_TEST_CASE_P(RSAckermann, CorrectorState, testing::Range(0, int(MODES)));

}} // namespace opencv_test::
