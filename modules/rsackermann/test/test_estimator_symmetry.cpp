// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_symmetry.hpp"
#include "test_simulator.hpp"
#include <functional>

// The estimate of a single image in each mode, with each thing that may be known: what changes nothing of what is seen
// changes nothing of the result.

namespace opencv_test { namespace {

using simulation::Simulator;

struct Setting
{
    RollingShutterCamera camera;
    AckermannEstimator::Params params;
    MotionPrior prior;
    MetricMotion metric;
    Mat segments;
};

struct Change
{
    const char* name;
    std::function<void(Setting&)> make;
};

//! What the camera sees.
const Change MODES[] = {{"forward", [](Setting&) {}},
                        {"reverse", [](Setting& s) { s.metric.speed = -12; }},
                        {"left turn", [](Setting& s) { s.metric.yawRate = -0.5; }},
                        {"left wall", [](Setting& s) { s.metric.rightDistance = 0; }},
                        {"right wall", [](Setting& s) { s.metric.leftDistance = 0; }},
                        {"right wall in reverse",
                         [](Setting& s) {
                             s.metric.leftDistance = 0;
                             s.metric.speed = -12;
                         }},
                        {"looks right", [](Setting& s) { s.metric.wallDirection = s.camera.heading = -1.5; }},
                        {"looks left", [](Setting& s) { s.metric.wallDirection = s.camera.heading = 1.45; }},
                        {"at rest", [](Setting& s) { s.metric.speed = s.metric.yawRate = 0; }},
                        {"turn alone", [](Setting& s) { s.metric.speed = 0; }}};

//! What is known.
const Change KNOWN[] = {
    {"gravity", [](Setting&) {}},
    {"nothing", [](Setting& s) { s.params.gravitySigma = AckermannEstimator::Params().gravitySigma; }},
    {"yaw rate",
     [](Setting& s) {
         s.prior.yawRate = s.metric.yawRate;
         s.prior.yawRateSigma = 0.02;
         s.params.gravitySigma = 0.01;
     }},
    {"speed",
     [](Setting& s) {
         s.prior.speed = s.metric.speed;
         s.prior.speedSigma = 0.5;
     }},
    {"speed and wall",
     [](Setting& s) {
         s.prior.speed = s.metric.speed;
         s.prior.speedSigma = 0.5;
         s.params.wallDistance = s.metric.leftDistance > 0 ? s.metric.leftDistance : s.metric.rightDistance;
     }},
    {"direction of the walls",
     [](Setting& s) {
         s.prior.wallDirection = s.metric.wallDirection;
         s.prior.wallDirectionSigma = 0.05;
     }},
    {"focal length hardly", [](Setting& s) { s.camera.focalSigma = 40; }},
    {"lens hardly", [](Setting& s) { s.camera.distortionSigma = 0.1; }},
    {"line delay not at all", [](Setting& s) { s.camera.lineDelay = 0; }},
    {"scale from the road", [](Setting& s) { s.params.scaleFromRoad = true; }}};

Setting settingOf(const Change& mode, const Change& known)
{
    Setting s;
    s.camera = RollingShutterCamera(Size(640, 380), Matx33d(500, 0, 310, 0, 520, 200, 0, 0, 1));
    s.camera.lineDelay = 70e-6;
    s.camera.height = 1.3;
    s.camera.heading = 0.1;
    s.camera.setRollPitch(0.03, -0.05);
    s.params.gravitySigma = 0;
    s.params.reverseProbability = 0.5; // that a reversed drive is as probable
    s.metric.yawRate = 0.6;
    s.metric.speed = 16;
    s.metric.leftDistance = 4;
    s.metric.rightDistance = 5.5;
    s.metric.wallDirection = 0.12;
    mode.make(s);
    RNG rng(11);
    simulation::SegmentOptions options;
    options.count = 70;
    options.noise = 0.15;
    options.inlierRatio = 0.85;
    const Simulator simulator = Simulator::fromMetric(s.camera, s.metric.yawRate, s.metric.speed, s.metric.leftDistance,
                                                      s.metric.rightDistance, s.metric.wallDirection);
    s.segments = simulation::randomSegments(simulator, options, rng).ends.clone();
    known.make(s);
    return s;
}

AckermannMotion estimate(const Setting& s, Mat& labels)
{
    return AckermannEstimator::create(s.camera, s.params)->estimate(s.segments, labels, s.prior);
}

//! Scaled inverse depth of the walls where the image is.
Matx<double, 1, 9> wallsOf(const AckermannMotion& m)
{
    Matx<double, 1, 9> w;
    for (int i = 0; i < 9; i++)
    {
        const double left = m.wallOffset - m.wallSlope * (i - 4) / 8, right = -m.wallRatio * left;
        w(i) = m.direction * std::max(std::max(left * m.direction, right * m.direction), 0.);
    }
    return w;
}

/** What is seen and how well: the same but for a part of it. The mean over possible motions is one in the unknowns, of
which the wall on the left is one and the other wall another; only next to that is what a mirror shows the same. */
void expectNear(const Setting& s, const AckermannMotion& a, const Setting& t, const AckermannMotion& b, double part)
{
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.scale, b.scale);
    EXPECT_EQ(a.contradictsPrior, b.contradictsPrior);
    EXPECT_NEAR(a.inliers, b.inliers, 1 + part * a.candidates);
    const double sigma = std::sqrt(a.covariance(0, 0));
    EXPECT_NEAR(a.alpha, b.alpha, part * (std::abs(a.alpha) + sigma));
    EXPECT_NEAR(sigma, std::sqrt(b.covariance(0, 0)), 2 * part * sigma);
    EXPECT_LE(cv::norm(wallsOf(a), wallsOf(b), NORM_INF), part * (cv::norm(wallsOf(a), NORM_INF) + 0.01));
    EXPECT_NEAR(a.roadSlope, b.roadSlope, part * (std::abs(a.roadSlope) + 0.01));
    EXPECT_NEAR(a.rollCorrection, b.rollCorrection, part * 0.01);
    EXPECT_NEAR(a.pitchCorrection, b.pitchCorrection, part * 0.01);
    double speed, otherSpeed;
    EXPECT_EQ(a.speed(s.camera, speed), b.speed(t.camera, otherSpeed));
    const double speedSigma = std::sqrt(a.metricCovariance(s.camera)(1, 1)); // large where the left wall isn't seen
    EXPECT_NEAR(speed, otherSpeed, part * (std::abs(speed) + speedSigma) + 1e-9);
    EXPECT_NEAR(a.seenYawRate, b.seenYawRate, part * (std::abs(a.seenYawRate) + a.seenYawRateSigma) + 1e-9);
    EXPECT_NEAR(a.seenYawRateSigma, b.seenYawRateSigma, part * a.seenYawRateSigma + 1e-9);
    EXPECT_NEAR(a.seenSpeed, b.seenSpeed, part * (std::abs(a.seenSpeed) + a.seenSpeedSigma) + 1e-9);
    EXPECT_NEAR(a.seenSpeedSigma, b.seenSpeedSigma, 2 * part * a.seenSpeedSigma + 1e-9);
    EXPECT_NEAR(a.expectedRaw, b.expectedRaw, part * (a.expectedRaw + 0.1));
    EXPECT_NEAR(a.expectedResidual, b.expectedResidual, part * (a.expectedRaw + 0.1));
    EXPECT_NEAR(a.probabilityWorse, b.probabilityWorse, part);
}

//! The same in every value, but for where iterations end.
void expectSameUnknowns(const AckermannMotion& a, const AckermannMotion& b)
{
    const double speed = std::hypot(a.wallSlope, a.wallOffset);
    EXPECT_EQ(a.model, b.model);
    EXPECT_EQ(a.rollYawAmbiguous, b.rollYawAmbiguous);
    if (speed < 0.01)
        return; // the direction of a car that stands isn't known
    EXPECT_EQ(a.direction, b.direction);
    EXPECT_NEAR(a.wallSlope, b.wallSlope, 0.01 * speed);
    EXPECT_NEAR(a.wallOffset, b.wallOffset, 0.01 * speed);
    EXPECT_NEAR(a.wallRatio, b.wallRatio, 0.01 + 0.01 * a.wallRatio);
    EXPECT_NEAR(a.wallDistance, b.wallDistance, 0.01 * a.wallDistance);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            EXPECT_NEAR(a.covariance(i, j), b.covariance(i, j),
                        0.02 * std::sqrt(a.covariance(i, i) * a.covariance(j, j)) + 1e-9);
}

typedef testing::TestWithParam<int> EstimatorSymmetry; // index of MODES

TEST_P(EstimatorSymmetry, mirror_and_reversed_drive)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    for (const Change& known : KNOWN)
    {
        SCOPED_TRACE(known.name);
        const Setting s = settingOf(MODES[GetParam()], known);
        Mat labels, twinLabels;
        const AckermannMotion motion = estimate(s, labels);
        for (const Twin& twin : {MIRRORED, REVERSED, ON_ITS_HEAD})
        {
            SCOPED_TRACE(testing::Message() << twin);
            // A car that only turns may do it in either direction, as may one that is known to stand creep; few
            // segments seem to stand on the road; and it is the left wall whose distance is given.
            const bool hasNoDirection = s.metric.speed == 0 && (s.metric.yawRate != 0 || s.params.wallDistance > 0);
            if (hasNoDirection || (twin.mirrored && (s.params.scaleFromRoad || s.params.wallDistance > 0)))
                continue;
            Setting t = s;
            t.camera = twin.of(s.camera);
            t.segments = twin.ofPlaces(s.segments, s.camera.imageSize);
            t.prior = twin.of(s.prior);
            const AckermannMotion expected = twin.of(motion, s.camera), other = estimate(t, twinLabels);
            expectNear(t, expected, t, other, twin.mirrored ? 0.1 : 0.01);
            if (twin.mirrored)
                continue;
            expectSameUnknowns(expected, other);
            EXPECT_LE(countNonZero(labels != twinLabels), 1);
        }
    }
}

// Seconds of another length, metres of another length, ends and segments in another order.
TEST_P(EstimatorSymmetry, units_and_order)
{
    struct
    {
        const char* name;
        double second, metre; // old ones of a new one
        std::function<void(Setting&)> make;
    } const changes[] = {{"seconds", 4, 1,
                          [](Setting& s) {
                              s.camera.lineDelay *= 4;
                              for (double* rate : {&s.params.maxYawRate, &s.params.maxSpeed, &s.params.priorYawRate,
                                                   &s.params.priorSpeed, &s.prior.speed, &s.prior.speedSigma,
                                                   &s.prior.yawRate, &s.prior.yawRateSigma})
                                  *rate /= 4;
                              s.params.priorReadoutTime *= 4;
                          }},
                         {"metres", 1, 4,
                          [](Setting& s) {
                              for (double* length :
                                   {&s.params.maxSpeed, &s.params.priorSpeed, &s.params.priorWallDistance,
                                    &s.params.priorHeight, &s.params.wallDistance, &s.camera.height, &s.prior.speed,
                                    &s.prior.speedSigma})
                                  *length *= 4;
                          }},
                         {"order", 1, 1, [](Setting& s) {
                              Mat other;
                              flip(s.segments, other, 0);
                              for (int i = 0; i < other.rows; i += 2)
                              {
                                  std::swap(other.at<double>(i, 0), other.at<double>(i, 2));
                                  std::swap(other.at<double>(i, 1), other.at<double>(i, 3));
                              }
                              s.segments = other;
                          }}};
    SCOPED_TRACE(MODES[GetParam()].name);
    for (const Change& known : KNOWN)
    {
        SCOPED_TRACE(known.name);
        const Setting s = settingOf(MODES[GetParam()], known);
        Mat labels;
        const AckermannMotion motion = estimate(s, labels);
        for (const auto& change : changes)
        {
            SCOPED_TRACE(change.name);
            Setting other = s;
            change.make(other);
            AckermannMotion same = estimate(other, labels);
            same.wallDistance /= change.metre;
            same.seenSpeed *= change.second / change.metre;
            same.seenSpeedSigma *= change.second / change.metre;
            same.seenYawRate *= change.second;
            same.seenYawRateSigma *= change.second;
            expectNear(s, motion, s, same, 0.01);
            expectSameUnknowns(motion, same);
        }
    }
}

// Of values that are given, how usual they are changes nothing of what is seen instead.
TEST_P(EstimatorSymmetry, seen_however_usual)
{
    const Change changes[] = {{"reverse", [](Setting& s) { s.params.reverseProbability = 1e-3; }},
                              {"speed", [](Setting& s) { s.params.priorSpeed *= 2; }},
                              {"yaw rate", [](Setting& s) { s.params.priorYawRate /= 2; }}};
    SCOPED_TRACE(MODES[GetParam()].name);
    Setting s = settingOf(MODES[GetParam()], {"speed and yaw rate", [](Setting& setting) {
                                                  for (const int k : {2, 3})
                                                      KNOWN[k].make(setting);
                                              }});
    for (const bool isWrong : {false, true})
    {
        if (isWrong)
            s.prior = REVERSED.of(s.prior);
        Mat labels;
        const AckermannMotion expected = estimate(s, labels);
        for (const Change& change : changes)
        {
            SCOPED_TRACE(testing::Message() << isWrong << " " << change.name);
            Setting other = s;
            change.make(other);
            if (s.metric.yawRate == 0 && other.params.priorYawRate != s.params.priorYawRate)
                continue; // a usual one is as fast
            const AckermannMotion m = estimate(other, labels);
            const double part = 1e-3; // by where the measurement of the noise begins
            EXPECT_NEAR(expected.seenYawRate, m.seenYawRate, part * expected.seenYawRateSigma);
            EXPECT_NEAR(expected.seenYawRateSigma, m.seenYawRateSigma, part * expected.seenYawRateSigma);
            EXPECT_NEAR(expected.seenSpeed, m.seenSpeed, part * expected.seenSpeedSigma);
            EXPECT_NEAR(expected.seenSpeedSigma, m.seenSpeedSigma, part * expected.seenSpeedSigma);
            EXPECT_EQ(expected.contradictsPrior, m.contradictsPrior);
        }
    }
}

// A focal length that is hardly known adds to the variances what another focal length changes.
TEST_P(EstimatorSymmetry, another_focal_length)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    Setting s = settingOf(MODES[GetParam()], KNOWN[0]), longer = s, uncertain = s;
    const double ratio = 1.04;
    longer.camera.cameraMatrix(0, 0) *= ratio;
    longer.camera.cameraMatrix(1, 1) *= ratio;
    uncertain.camera.focalSigma = (ratio - 1) * s.camera.cameraMatrix(0, 0);
    Mat labels;
    const AckermannMotion one = estimate(s, labels), other = estimate(longer, labels),
                          both = estimate(uncertain, labels);
    const bool isOneSided = s.metric.leftDistance == 0 || s.metric.rightDistance == 0;
    if (isOneSided || s.metric.speed == 0)
        return;                                                                                // there are other minima
    const Vec3d change = Vec3d(other.alpha, other.wallSlope, other.wallOffset) * (1 / ratio) - // per second
                         Vec3d(one.alpha, one.wallSlope, one.wallOffset);
    for (int i = 0; i < 3; i++)
        EXPECT_NEAR(std::abs(change[i]), std::sqrt(both.covariance(i, i) - one.covariance(i, i)),
                    0.3 * std::sqrt(one.covariance(i, i)))
            << i;
}

// A longer lens shows another street, whose image is displaced the same, at a road near the camera as well.
TEST(RSAckermann_EstimatorSymmetry, displacement_by_another_focal_length)
{
    for (const int mode : {0, 2, 3}) // which are told apart from their reverse
    {
        SCOPED_TRACE(MODES[mode].name);
        Setting s = settingOf(MODES[mode], KNOWN[0]), uncertain = s;
        const double relative = 0.04;
        s.camera.height = uncertain.camera.height = 0.3;
        uncertain.camera.focalSigma = relative * s.camera.cameraMatrix(0, 0);
        Mat labels;
        const AckermannMotion one = estimate(s, labels), both = estimate(uncertain, labels);
        const double added = std::pow(both.expectedResidual, 2) - std::pow(one.expectedResidual, 2);
        EXPECT_GT(added, 0);
        EXPECT_LT(std::sqrt(added), relative / 2 * one.expectedRaw);
    }
}

INSTANTIATE_TEST_CASE_P(/*nothing*/, EstimatorSymmetry, testing::Range(0, int(sizeof(MODES) / sizeof(*MODES))));

}} // namespace opencv_test::
