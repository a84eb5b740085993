// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

const double trueYawRate = 40 * degree, trueSpeed = 20, trueDirection = 0.03;

//! What remains wrong in many frames of the same street.
struct Errors
{
    std::vector<double> yawRate, speed, direction, displacement;
};

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

Simulator street()
{
    return Simulator::fromMetric(simulation::paperCamera(), trueYawRate, trueSpeed, 2.5, 3, trueDirection);
}

AckermannMotion estimate(const Simulator& truth, int seed, const MotionPrior& prior)
{
    AckermannEstimator::Params params;
    params.wallDistance = 2.5;
    params.gravitySigma = 0;
    simulation::SegmentOptions options;
    options.inlierRatio = 0.8;
    options.noise = 0.15;
    RNG rng(seed + 1);
    return AckermannEstimator::create(truth.camera, params)->estimate(simulation::randomSegments(truth, options, rng).ends, noArray(), prior);
}

Errors errors(const MotionPrior& prior)
{
    const Simulator truth = street();
    Errors result;
    for (int seed = 0; seed < 41; seed++)
    {
        const AckermannMotion m = estimate(truth, seed, prior);
        EXPECT_EQ(MOTION_OK, m.status) << "seed " << seed;
        double yawRate, speed;
        m.yawRate(truth.camera, yawRate);
        m.speed(truth.camera, speed);
        result.yawRate.push_back(std::abs(yawRate - trueYawRate));
        result.speed.push_back(std::abs(speed - trueSpeed));
        result.direction.push_back(std::abs(std::atan(m.delta()) - trueDirection));
        result.displacement.push_back(truth.meanDisplacement(Simulator::fromMotion(truth.camera, m)));
    }
    return result;
}

TEST(RSAckermann_Prior, speed)
{
    MotionPrior prior;
    prior.speed = trueSpeed;
    prior.speedSigma = 0.5;
    const Errors with = errors(prior), without = errors(MotionPrior());
    EXPECT_LT(largest(with.speed), 3 * prior.speedSigma);
    EXPECT_LT(median(with.speed), median(without.speed));
    EXPECT_LT(median(with.displacement), median(without.displacement));
}

TEST(RSAckermann_Prior, yaw_rate)
{
    MotionPrior prior;
    prior.yawRate = trueYawRate;
    prior.yawRateSigma = 0.5 * degree;
    const Errors with = errors(prior), without = errors(MotionPrior());
    EXPECT_LT(largest(with.yawRate), 3 * prior.yawRateSigma);
    EXPECT_LT(median(with.yawRate), median(without.yawRate));
    EXPECT_LT(median(with.displacement), median(without.displacement));
}

TEST(RSAckermann_Prior, wall_direction)
{
    MotionPrior prior;
    prior.wallDirection = trueDirection;
    prior.wallDirectionSigma = 0.2 * degree;
    const Errors with = errors(prior), without = errors(MotionPrior());
    EXPECT_LT(largest(with.direction), 3 * prior.wallDirectionSigma);
    EXPECT_LT(median(with.direction), median(without.direction));
    EXPECT_LT(median(with.displacement), median(without.displacement));
}

TEST(RSAckermann_Prior, all_together)
{
    MotionPrior prior;
    prior.speed = trueSpeed;
    prior.speedSigma = 0.5;
    prior.yawRate = trueYawRate;
    prior.yawRateSigma = 0.5 * degree;
    prior.wallDirection = trueDirection;
    prior.wallDirectionSigma = 0.2 * degree;
    const Errors with = errors(prior);
    EXPECT_LT(largest(with.speed), 3 * prior.speedSigma);
    EXPECT_LT(largest(with.yawRate), 3 * prior.yawRateSigma);
    EXPECT_LT(largest(with.direction), 3 * prior.wallDirectionSigma);
}

// The frames of a drive at constant motion, each with the motion of the frame before.
TEST(RSAckermann_Prior, previous_frame)
{
    const Simulator truth = street();
    std::vector<double> alone, carried;
    MotionPrior prior;
    prior.previousNoise = 0.01;
    for (int seed = 0; seed < 60; seed++)
    {
        const AckermannMotion single = estimate(truth, seed, MotionPrior());
        prior.previous = estimate(truth, seed, prior);
        ASSERT_EQ(MOTION_OK, prior.previous.status);
        if (seed < 10)
            continue;
        alone.push_back(truth.meanDisplacement(Simulator::fromMotion(truth.camera, single)));
        carried.push_back(truth.meanDisplacement(Simulator::fromMotion(truth.camera, prior.previous)));
    }
    EXPECT_LT(median(carried), 0.7 * median(alone));
}

// A frame before without a motion says nothing.
TEST(RSAckermann_Prior, previous_frame_without_motion)
{
    const Simulator truth = street();
    MotionPrior prior;
    prior.previousNoise = 0.01;
    const AckermannMotion a = estimate(truth, 0, prior), b = estimate(truth, 0, MotionPrior());
    EXPECT_EQ(b.alpha, a.alpha);
    EXPECT_EQ(b.wallSlope, a.wallSlope);
    EXPECT_EQ(b.wallOffset, a.wallOffset);
    EXPECT_EQ(b.wallRatio, a.wallRatio);
}

// A wrong prior with a large sigma loses against the segments.
TEST(RSAckermann_Prior, weak_prior)
{
    MotionPrior prior;
    prior.speed = 2 * trueSpeed;
    prior.speedSigma = 20 * trueSpeed;
    prior.yawRate = -trueYawRate;
    prior.yawRateSigma = 20 * trueYawRate;
    const Errors with = errors(prior), without = errors(MotionPrior());
    EXPECT_LT(median(with.displacement), 1.1 * median(without.displacement));
}

// Metric values without a scale can't be used.
TEST(RSAckermann_Prior, without_scale)
{
    const Simulator truth = street();
    simulation::SegmentOptions options;
    RNG rng(1);
    const Mat segments = simulation::randomSegments(truth, options, rng).ends;
    RollingShutterCamera camera = truth.camera;
    camera.lineDelay = 0;
    const Ptr<AckermannEstimator> estimator = AckermannEstimator::create(camera);
    MotionPrior prior;
    prior.speed = -10;
    prior.speedSigma = 0.1;
    prior.yawRate = -1;
    prior.yawRateSigma = 0.01;
    EXPECT_EQ(estimator->estimate(segments).alpha, estimator->estimate(segments, noArray(), prior).alpha);
}

typedef void (*Spoil)(MotionPrior&);
typedef std::pair<const char*, Spoil> BadField;
class RSAckermann_PriorCheck : public testing::TestWithParam<BadField> {};
const BadField badFields[] = {
    BadField("speed", [](MotionPrior& p) { p.speed = NaN; }),
    BadField("speedSigma", [](MotionPrior& p) { p.speedSigma = -1; }),
    BadField("speedSigma", [](MotionPrior& p) { p.speedSigma = NaN; }),
    BadField("yawRate", [](MotionPrior& p) { p.yawRate = infinity; }),
    BadField("yawRateSigma", [](MotionPrior& p) { p.yawRateSigma = -1; }),
    BadField("yawRateSigma", [](MotionPrior& p) { p.yawRateSigma = infinity; }),
    BadField("wallDirection", [](MotionPrior& p) { p.wallDirection = NaN; }),
    BadField("wallDirectionSigma", [](MotionPrior& p) { p.wallDirectionSigma = -1; }),
    BadField("previousNoise", [](MotionPrior& p) { p.previousNoise = -1; }),
    BadField("previousNoise", [](MotionPrior& p) { p.previousNoise = NaN; }),
    BadField("prior.previous.alpha", [](MotionPrior& p) { p.previous.alpha = NaN; }),
    BadField("prior.previous.alpha", [](MotionPrior& p) { p.previous.alpha = -infinity; }),
    BadField("prior.previous.alpha", [](MotionPrior& p) { p.previous.alpha = 10.1; }),
    BadField("prior.previous.alpha", [](MotionPrior& p) { p.previous.alpha = -10.1; }),
    BadField("prior.previous.wallSlope", [](MotionPrior& p) { p.previous.wallSlope = NaN; }),
    BadField("prior.previous.wallSlope", [](MotionPrior& p) { p.previous.wallSlope = -infinity; }),
    BadField("prior.previous.wallSlope", [](MotionPrior& p) { p.previous.wallSlope = 101; }),
    BadField("prior.previous.wallSlope", [](MotionPrior& p) { p.previous.wallSlope = -101; }),
    BadField("prior.previous.wallOffset", [](MotionPrior& p) { p.previous.wallOffset = NaN; }),
    BadField("prior.previous.wallOffset", [](MotionPrior& p) { p.previous.wallOffset = -infinity; }),
    BadField("prior.previous.wallOffset", [](MotionPrior& p) { p.previous.wallOffset = 101; }),
    BadField("prior.previous.wallOffset", [](MotionPrior& p) { p.previous.wallOffset = -101; }),
    BadField("prior.previous.roadSlope", [](MotionPrior& p) { p.previous.roadSlope = NaN; }),
    BadField("prior.previous.roadSlope", [](MotionPrior& p) { p.previous.roadSlope = -infinity; }),
    BadField("prior.previous.roadSlope", [](MotionPrior& p) { p.previous.roadSlope = 1.1e6; }),
    BadField("prior.previous.roadSlope", [](MotionPrior& p) { p.previous.roadSlope = -1.1e6; }),
    BadField("prior.previous.rollCorrection", [](MotionPrior& p) { p.previous.rollCorrection = NaN; }),
    BadField("prior.previous.rollCorrection", [](MotionPrior& p) { p.previous.rollCorrection = -infinity; }),
    BadField("prior.previous.rollCorrection", [](MotionPrior& p) { p.previous.rollCorrection = 3.2; }),
    BadField("prior.previous.rollCorrection", [](MotionPrior& p) { p.previous.rollCorrection = -3.2; }),
    BadField("prior.previous.pitchCorrection", [](MotionPrior& p) { p.previous.pitchCorrection = NaN; }),
    BadField("prior.previous.pitchCorrection", [](MotionPrior& p) { p.previous.pitchCorrection = -infinity; }),
    BadField("prior.previous.pitchCorrection", [](MotionPrior& p) { p.previous.pitchCorrection = 3.2; }),
    BadField("prior.previous.pitchCorrection", [](MotionPrior& p) { p.previous.pitchCorrection = -3.2; }),
    BadField("prior.previous.wallRatio", [](MotionPrior& p) { p.previous.wallRatio = NaN; }),
    BadField("prior.previous.wallRatio", [](MotionPrior& p) { p.previous.wallRatio = infinity; }),
    BadField("prior.previous.wallRatio", [](MotionPrior& p) { p.previous.wallRatio = -0.1; }),
    BadField("prior.previous.wallDistance", [](MotionPrior& p) { p.previous.wallDistance = NaN; }),
    BadField("prior.previous.wallDistance", [](MotionPrior& p) { p.previous.wallDistance = infinity; }),
    BadField("prior.previous.wallDistance", [](MotionPrior& p) { p.previous.wallDistance = -0.1; }),
    BadField("prior.previous.wallRatio", [](MotionPrior& p) { p.previous.wallRatio = 1.1e6; }),
    BadField("prior.previous.covariance(0, 0)", [](MotionPrior& p) { p.previous.covariance(0, 0) = NaN; }),
    BadField("prior.previous.covariance(1, 2)", [](MotionPrior& p) { p.previous.covariance(1, 2) = infinity; }),
    BadField("prior.previous.covariance(3, 3)", [](MotionPrior& p) { p.previous.covariance(3, 3) = -infinity; }),
    BadField("prior.previous.rms", [](MotionPrior& p) { p.previous.rms = NaN; }),
    BadField("prior.previous.rms", [](MotionPrior& p) { p.previous.rms = infinity; }),
};
INSTANTIATE_TEST_CASE_P(/*nothing*/, RSAckermann_PriorCheck, testing::ValuesIn(badFields));

TEST_P(RSAckermann_PriorCheck, names_the_field)
{
    MotionPrior prior;
    EXPECT_NO_THROW(prior.check());
    GetParam().second(prior);
    std::string message;
    try
    {
        prior.check();
    }
    catch (const cv::Exception& e)
    {
        message = e.err;
    }
    EXPECT_NE(std::string::npos, message.find(GetParam().first)) << message;
    const Ptr<AckermannEstimator> estimator = AckermannEstimator::create(simulation::paperCamera());
    EXPECT_THROW(estimator->estimate(Mat(), noArray(), prior), cv::Exception);
}

std::string complaintOf(const MotionPrior& prior)
{
    try
    {
        prior.check();
    }
    catch (const cv::Exception& e)
    {
        return e.err;
    }
    return std::string();
}

TEST(RSAckermann_PreviousMotion, says_what_is_expected_of_the_previous_motion)
{
    MotionPrior prior;
    prior.previous.alpha = NaN;
    EXPECT_EQ("prior.previous.alpha is nan; a finite number is expected", complaintOf(prior));
    prior.previous.alpha = -11;
    EXPECT_EQ("prior.previous.alpha is -11; a number from -10 to 10 is expected", complaintOf(prior));
    prior.previous.alpha = 0;
    prior.previous.wallRatio = -2;
    EXPECT_EQ("prior.previous.wallRatio is -2; a number from 0 to 1e+06 is expected", complaintOf(prior));
}

TEST(RSAckermann_PreviousMotion, accepts_the_limits)
{
    MotionPrior prior;
    for (int sign = -1; sign <= 1; sign += 2)
    {
        AckermannMotion& m = prior.previous;
        m.alpha = sign * 10;
        m.wallSlope = m.wallOffset = sign * 100;
        m.roadSlope = sign * 1e6;
        m.wallRatio = sign < 0 ? 0 : 1e6;
        m.rollCorrection = m.pitchCorrection = sign * CV_PI;
        m.wallDistance = sign < 0 ? 0 : 1e6;
        EXPECT_EQ("", complaintOf(prior));
    }
}

// Motions at the limits leave an estimate finite.
TEST(RSAckermann_Prior, previous_frame_at_the_limits)
{
    const Simulator truth = street();
    for (int sign = -1; sign <= 1; sign += 2)
    {
        MotionPrior prior;
        prior.previousNoise = 0.1;
        prior.previous.status = MOTION_OK;
        prior.previous.model = MODEL_4LA;
        prior.previous.alpha = sign * 10;
        prior.previous.wallSlope = prior.previous.wallOffset = sign * 100;
        prior.previous.wallRatio = 1e6;
        const AckermannMotion m = estimate(truth, 0, prior);
        const double values[] = {m.alpha, m.wallSlope, m.wallOffset, m.wallRatio, m.roadSlope, m.rollCorrection, m.pitchCorrection, m.rms};
        for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); i++)
            EXPECT_FALSE(cvIsNaN(values[i]) || cvIsInf(values[i])) << "sign " << sign << ", value " << i;
    }
}

}} // namespace
