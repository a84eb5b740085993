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

void expectNear(double expected, double value, double scale)
{
    EXPECT_NEAR(expected, value, 0.01 * scale + 1e-9);
}

//! The same minimum but for where iterations end.
void expectNear(const AckermannMotion& a, const AckermannMotion& b)
{
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.model, b.model);
    EXPECT_EQ(a.direction, b.direction);
    EXPECT_EQ(a.scale, b.scale);
    EXPECT_EQ(a.contradictsPrior, b.contradictsPrior);
    EXPECT_EQ(a.rollYawAmbiguous, b.rollYawAmbiguous);
    EXPECT_NEAR(a.inliers, b.inliers, 1);
    const double speed = std::hypot(a.wallSlope, a.wallOffset) + 1e-3;
    expectNear(a.alpha, b.alpha, std::abs(a.alpha) + std::sqrt(a.covariance(0, 0)));
    expectNear(a.wallSlope, b.wallSlope, speed);
    expectNear(a.wallOffset, b.wallOffset, speed);
    expectNear(a.wallRatio, b.wallRatio, 1);
    expectNear(a.roadSlope, b.roadSlope, std::abs(a.roadSlope));
    expectNear(a.rollCorrection, b.rollCorrection, 0.01);
    expectNear(a.pitchCorrection, b.pitchCorrection, 0.01);
    expectNear(a.wallDistance, b.wallDistance, a.wallDistance);
    expectNear(a.seenYawRate, b.seenYawRate, 0.1);
    expectNear(a.seenYawRateSigma, b.seenYawRateSigma, a.seenYawRateSigma);
    expectNear(a.seenSpeed, b.seenSpeed, std::abs(a.seenSpeed));
    expectNear(a.seenSpeedSigma, b.seenSpeedSigma, a.seenSpeedSigma);
    expectNear(a.expectedRaw, b.expectedRaw, a.expectedRaw);
    expectNear(a.expectedResidual, b.expectedResidual, a.expectedResidual);
    expectNear(a.probabilityWorse, b.probabilityWorse, 1);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            expectNear(a.covariance(i, j), b.covariance(i, j), 2 * std::sqrt(a.covariance(i, i) * a.covariance(j, j)));
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
        for (const Twin& twin : TWINS)
        {
            SCOPED_TRACE(testing::Message() << twin);
            Setting t = s;
            t.camera = twin.of(s.camera);
            t.segments = twin.ofPlaces(s.segments, s.camera.imageSize);
            t.prior = twin.of(s.prior);
            expectNear(twin.of(motion, s.camera), estimate(t, twinLabels));
        }
    }
}

// Seconds of another length, metres of another length, ends and segments in another order.
TEST_P(EstimatorSymmetry, units_and_order)
{
    const Change changes[] = {{"seconds",
                               [](Setting& s) {
                                   s.camera.lineDelay *= 4;
                                   for (double* rate : {&s.params.maxYawRate, &s.params.maxSpeed,
                                                        &s.params.priorYawRate, &s.params.priorSpeed, &s.prior.speed,
                                                        &s.prior.speedSigma, &s.prior.yawRate, &s.prior.yawRateSigma})
                                       *rate /= 4;
                                   s.params.priorReadoutTime *= 4;
                               }},
                              {"metres",
                               [](Setting& s) {
                                   for (double* length :
                                        {&s.params.maxSpeed, &s.params.priorSpeed, &s.params.priorWallDistance,
                                         &s.params.priorHeight, &s.camera.height, &s.prior.speed, &s.prior.speedSigma})
                                       *length *= 4;
                               }},
                              {"order", [](Setting& s) {
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
        for (const Change& change : changes)
        {
            SCOPED_TRACE(change.name);
            Setting other = s;
            change.make(other);
            AckermannMotion same = estimate(other, labels);
            const double seconds = change.name[0] == 's' ? 4 : 1, metres = change.name[0] == 'm' ? 4 : 1;
            same.wallDistance /= metres;
            same.seenSpeed *= seconds / metres;
            same.seenSpeedSigma *= seconds / metres;
            same.seenYawRate *= seconds;
            same.seenYawRateSigma *= seconds;
            expectNear(motion, same);
        }
    }
}

INSTANTIATE_TEST_CASE_P(/*nothing*/, EstimatorSymmetry, testing::Range(0, int(sizeof(MODES) / sizeof(*MODES))));

}} // namespace opencv_test::
