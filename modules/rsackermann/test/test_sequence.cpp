// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"
#include "../src/sequence/clock_noise.hpp"
#include "../src/sequence/point_prediction.hpp"
#include "../src/sequence/residual_noise.hpp"
#include "../src/sequence/sequence_filter.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

const double DEGREE = CV_PI / 180;

//! A camera that isn't the same in any direction: fx != fy, off centre, tilted, not looking along the car.
RollingShutterCamera driveCamera(int scan = SCAN_TOP_TO_BOTTOM)
{
    RollingShutterCamera camera(Size(960, 540), Matx33d(700, 0, 470, 0, 840, 280, 0, 0, 1));
    camera.scanDirection = scan;
    camera.lineDelay = 0.03 / 540;
    camera.height = 1.3;
    camera.heading = 0.05;
    camera.setRollPitch(0.01, 0.04);
    return camera;
}

struct Truth
{
    double yawRate, speed, left, right, direction; // rad/s, m/s, metres, radians
};

Simulator simulate(const RollingShutterCamera& camera, const Truth& truth)
{
    return Simulator::fromMetric(camera, truth.yawRate, truth.speed, truth.left, truth.right, truth.direction);
}

//! A point of the scene that is seen at a random pixel, in the frame and in the one before.
bool randomPair(const Simulator& s, double seconds, RNG& rng, PointPair& pair)
{
    const double T = seconds / s.camera.secondsPerUnitTime();
    pair.now = uniformPoint(rng, Point2d(0, 0), Point2d(s.camera.imageSize.width, s.camera.imageSize.height));
    const double t = s.time(pair.now);
    const Vec3d place = s.drive.position(t), ray = s.drive.turn(s.bearing(pair.now), t);
    const simulation::Surface surface = s.street.first(place, ray);
    if (surface == simulation::NOTHING)
        return false;
    const Vec3d P = place + s.street.distance(surface, place, ray) * ray;
    // The same motion brought the car here: its frame before is at the reference row of that time.
    Simulator other = s;
    other.drive.yaw -= T * s.drive.yawChange;
    return other.project(s.drive.toCamera(P, -T), pair.other) && pair.other.x > 0 &&
           pair.other.x < s.camera.imageSize.width;
}

std::vector<PointPair> randomPairs(const Simulator& s, double seconds, int count, double noise, double outliers,
                                   RNG& rng)
{
    std::vector<PointPair> pairs;
    for (int tries = 0; int(pairs.size()) < count && tries < 100 * count; tries++)
    {
        PointPair pair;
        if (!randomPair(s, seconds, rng, pair))
            continue;
        pair.other += gaussianPoint(rng, noise);
        if (rng.uniform(0., 1.) < outliers)
            pair.other += uniformPoint(rng, Point2d(-40, -20), Point2d(40, 20));
        pairs.push_back(pair);
    }
    return pairs;
}

std::vector<TrackedBearing> bearingsOf(const RollingShutterCamera& camera, const std::vector<PointPair>& pairs,
                                       double seconds)
{
    std::vector<TrackedBearing> bearings;
    addBearings(camera, pairs, seconds, bearings);
    return bearings;
}

SequenceState stateOf(const RollingShutterCamera& camera, const Truth& truth)
{
    SequenceState state(camera, AckermannEstimator::Params());
    state.value[SEQUENCE_YAW_RATE] = truth.yawRate;
    state.value[SEQUENCE_SPEED] = truth.speed;
    state.value[SEQUENCE_DIRECTION] = truth.direction;
    state.value[SEQUENCE_LEFT] = truth.left > 0 ? 1 / truth.left : 0;
    state.value[SEQUENCE_RIGHT] = truth.right > 0 ? 1 / truth.right : 0;
    state.value[SEQUENCE_ROAD] = 1 / camera.height;
    return state;
}

Truth randomTruth(RNG& rng)
{
    const int walls = rng.uniform(0, 3);
    const Truth truth = {
        rng.uniform(-0.5, 0.5), rng.uniform(0., 1.) < 0.2 ? rng.uniform(-4., -1.) : rng.uniform(2., 25.),
        walls == 1 ? 0 : rng.uniform(4., 15.), walls == 2 ? 0 : rng.uniform(4., 15.), rng.uniform(-0.2, 0.2)};
    return truth;
}

// With another gravity what is known of motion and street stays known, together.
TEST(RSAckermann_Sequence, state_with_another_gravity)
{
    const RollingShutterCamera camera = driveCamera(SCAN_TOP_TO_BOTTOM);
    const AckermannEstimator::Params params;
    const SequenceState fresh(camera, params);
    SequenceState state(camera, params);
    for (int i = 0; i < SEQUENCE_VALUES; i++)
        for (int j = 0; j < SEQUENCE_VALUES; j++)
        {
            state.value[i] = 0.1 * i;
            state.covariance(i, j) = i == j ? 2 : 0.01 * (i + j);
        }
    const SequenceState before = state;
    state.change(camera, params, SEQUENCE_ROLL);
    for (int i = 0; i < SEQUENCE_VALUES; i++)
        for (int j = 0; j < SEQUENCE_VALUES; j++)
        {
            const bool isKept = i < SEQUENCE_ROLL && j < SEQUENCE_ROLL;
            EXPECT_EQ((isKept ? before : fresh).covariance(i, j), state.covariance(i, j)) << i << ", " << j;
            EXPECT_EQ((i < SEQUENCE_ROLL ? before : fresh).value[i], state.value[i]) << i;
        }
}

// Of roll and yaw rate, of either sign.
TEST(RSAckermann_Sequence, state_that_is_ambiguous)
{
    const RollingShutterCamera camera = driveCamera(SCAN_TOP_TO_BOTTOM);
    for (const double correlation : {-0.95, -0.8, 0., 0.8, 0.95})
    {
        SequenceState state = stateOf(camera, {0.1, 10, 4, 5, 0});
        state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_ROLL) = state.covariance(SEQUENCE_ROLL, SEQUENCE_YAW_RATE) =
            correlation * std::sqrt(state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE) *
                                    state.covariance(SEQUENCE_ROLL, SEQUENCE_ROLL));
        AckermannMotion motion;
        state.toMotion(camera.secondsPerUnitTime(), motion);
        EXPECT_EQ(std::abs(correlation) > 0.9, motion.rollYawAmbiguous) << correlation;
    }
}

// What was measured, without what is known of any drive.
TEST(RSAckermann_Sequence, state_shows_what_it_was_given)
{
    const RollingShutterCamera camera = driveCamera(SCAN_TOP_TO_BOTTOM);
    SequenceState state(camera, AckermannEstimator::Params());
    double mean = 0, sigma = 0;
    state.seen(SEQUENCE_SPEED, mean, sigma);
    EXPECT_EQ(0, sigma);
    MotionPrior prior;
    prior.yawRate = -0.2;
    prior.yawRateSigma = 0.15;
    prior.speed = 7;
    prior.speedSigma = 9;
    state.measure(prior);
    state.seen(SEQUENCE_YAW_RATE, mean, sigma);
    EXPECT_NEAR(prior.yawRate, mean, 1e-9);
    EXPECT_NEAR(prior.yawRateSigma, sigma, 1e-9);
    state.seen(SEQUENCE_SPEED, mean, sigma);
    EXPECT_NEAR(prior.speed, mean, 1e-9);
    EXPECT_NEAR(prior.speedSigma, sigma, 1e-9);
}

// Points that agree on nothing are another scene, of which nothing is known.
TEST(RSAckermann_Sequence, filter_of_another_scene)
{
    RNG rng(4);
    const RollingShutterCamera camera = driveCamera(SCAN_TOP_TO_BOTTOM);
    const AckermannEstimator::Params params;
    SequenceFilter filter(camera, params);
    filter.advance(0, camera, params);
    filter.state = stateOf(camera, {0.1, 10, 4, 5, 0});
    filter.isUninitialised = false;
    std::vector<PointPair> pairs;
    for (int i = 0; i < 200; i++)
        pairs.push_back({uniformPoint(rng, Point2d(0, 0), Point2d(camera.imageSize)),
                         uniformPoint(rng, Point2d(0, 0), Point2d(camera.imageSize))});
    FrameFeatures features;
    features.setPoints(camera, pairs, 0.05);
    SequenceFit fit(filter.state);
    EXPECT_FALSE(filter.update(features, camera, params, fit));
    EXPECT_TRUE(filter.isUninitialised);
    EXPECT_EQ(SequenceState(camera, params).value, filter.state.value);
    EXPECT_EQ(SequenceState(camera, params).covariance, filter.state.covariance);
}

// Of the next frame all stays, of the one before nothing, on whichever grid points were tracked.
TEST(RSAckermann_Sequence, features_without_the_frame_before)
{
    RNG rng(7);
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(1200, 800));
    camera.lineDelay = 2e-5;
    Mat noise(camera.imageSize, CV_8U);
    rng.fill(noise, RNG::UNIFORM, 0, 256);
    GaussianBlur(noise, noise, Size(), 3);
    normalize(noise, noise, 0, 255, NORM_MINMAX);
    FramePrediction same;
    same.usual = [](const Point2d& now, double) { return now; };
    FrameFeatures features;
    for (int i = 0; i < 2; i++)
    {
        const auto frame = [&](int k) { return GrayFrame(noise.colRange(2 * k, noise.cols - 8 + 2 * k), 1, 0.1 * k); };
        features.track(camera, frame(i), 0.1, same, frame(i + 1));
    }
    std::vector<TrackedBearing>* const all[] = {&features.bearings, &features.fineBearings};
    std::ptrdiff_t after[2];
    const auto isAfter = [](const TrackedBearing& b) { return b.pitch == FLOW_PITCH_AFTER; };
    for (int k = 0; k < 2; k++)
    {
        after[k] = std::count_if(all[k]->begin(), all[k]->end(), isAfter);
        EXPECT_GT(after[k], 50);
        EXPECT_GT(std::ptrdiff_t(all[k]->size()), after[k] + 50);
    }
    features.leaveOut(0.1);
    for (int k = 0; k < 2; k++)
    {
        EXPECT_EQ(after[k], std::ptrdiff_t(all[k]->size()));
        EXPECT_TRUE(std::all_of(all[k]->begin(), all[k]->end(), isAfter));
    }
}

typedef testing::TestWithParam<int> Scans;

TEST_P(Scans, points_move_as_the_simulated_motion_moves_them)
{
    RNG rng(5);
    const RollingShutterCamera camera = driveCamera(GetParam());
    int count = 0;
    for (int i = 0; i < 500; i++)
    {
        const Truth truth = randomTruth(rng);
        const double seconds = rng.uniform(-0.1, 0.1);
        const std::vector<PointPair> pairs = randomPairs(simulate(camera, truth), seconds, 20, 0, 0, rng);
        double values[FLOW_VALUES] = {0};
        const SequenceVector value = stateOf(camera, truth).value;
        std::copy(value.val, value.val + SEQUENCE_VALUES, values);
        const std::vector<TrackedBearing> bearings = bearingsOf(camera, pairs, seconds);
        for (size_t k = 0; k < bearings.size(); k++, count++)
            ASSERT_LT(cv::norm(FlowResidual(camera).evaluate(bearings[k], values, 0)), 1e-6)
                << "motion " << i << ", point " << k;
    }
    EXPECT_GT(count, 8000);
}

TEST_P(Scans, other_frames_may_have_another_yaw_rate)
{
    RNG rng(11);
    const RollingShutterCamera camera = driveCamera(GetParam());
    const double unit = camera.secondsPerUnitTime();
    std::vector<double> known, ignored;
    for (int i = 0; i < 200; i++)
    {
        Truth truth = randomTruth(rng);
        truth.speed *= 0.1;
        const double seconds = rng.uniform(0., 1.) < 0.5 ? 0.1 : -0.1, change = rng.uniform(-0.5, 0.5);
        Simulator simulator = simulate(camera, truth);
        simulator.drive.yawChange = change * unit * unit;
        double values[FLOW_VALUES] = {0};
        const SequenceVector value = stateOf(camera, truth).value;
        std::copy(value.val, value.val + SEQUENCE_VALUES, values);
        const std::vector<TrackedBearing> bearings =
            bearingsOf(camera, randomPairs(simulator, seconds, 20, 0, 0, rng), seconds);
        for (size_t k = 0; k < bearings.size(); k++)
        {
            values[FLOW_YAW_CHANGE] = 0;
            ignored.push_back(cv::norm(FlowResidual(camera).evaluate(bearings[k], values, 0)));
            values[FLOW_YAW_CHANGE] = change;
            known.push_back(cv::norm(FlowResidual(camera).evaluate(bearings[k], values, 0)));
        }
    }
    // What is left is the change of the car's way, which is no part of it and grows with the speed.
    EXPECT_LT(median(known), 0.02 * median(ignored));
    EXPECT_GT(median(ignored), 0.3);
}

TEST_P(Scans, derivatives_are_those_of_slow_motions)
{
    RNG rng(6);
    const RollingShutterCamera camera = driveCamera(GetParam());
    const FlowResidual residual(camera);
    for (int i = 0; i < 200; i++)
    {
        Truth truth = randomTruth(rng);
        truth.yawRate *= 0.1;
        truth.speed *= 0.1;
        const std::vector<TrackedBearing> bearings =
            bearingsOf(camera, randomPairs(simulate(camera, truth), 0.04, 10, 0, 0, rng), 0.04);
        double values[FLOW_VALUES] = {0}, jacobian[2][FLOW_VALUES];
        const SequenceVector value = stateOf(camera, truth).value;
        std::copy(value.val, value.val + SEQUENCE_VALUES, values);
        for (size_t k = 0; k < bearings.size(); k++)
        {
            residual.evaluate(bearings[k], values, jacobian[0]);
            for (int p = 0; p < FLOW_VALUES; p++)
            {
                const double h = 1e-5, at = values[p];
                values[p] = at + h;
                const Point2d high = residual.evaluate(bearings[k], values, 0);
                values[p] = at - h;
                const Point2d low = residual.evaluate(bearings[k], values, 0);
                values[p] = at;
                const Point2d slope = (high - low) * (0.5 / h), got(jacobian[0][p], jacobian[1][p]);
                // At an edge between two planes there is no derivative.
                const double small = p == FLOW_YAW_CHANGE ? 0.02 : 2; // of some 0.5, and of 1000
                if (cv::norm(slope) < 1e4)
                {
                    EXPECT_LT(std::abs(slope.x - got.x), 0.1 * cv::norm(slope) + small) << "value " << p;
                    EXPECT_LT(std::abs(slope.y - got.y), 0.1 * std::abs(slope.y) + small) << "value " << p;
                }
            }
        }
    }
}

TEST_P(Scans, derivative_by_the_inverse_depth)
{
    RNG rng(8);
    const RollingShutterCamera camera = driveCamera(GetParam());
    const FlowResidual residual(camera);
    int count = 0;
    for (int i = 0; i < 200; i++)
    {
        const Truth truth = randomTruth(rng);
        const std::vector<TrackedBearing> bearings =
            bearingsOf(camera, randomPairs(simulate(camera, truth), 0.04, 10, 0, 0, rng), 0.04);
        double values[FLOW_VALUES] = {0};
        const SequenceVector value = stateOf(camera, truth).value;
        std::copy(value.val, value.val + SEQUENCE_VALUES, values);
        values[FLOW_PITCH_BEFORE] = rng.uniform(-0.1, 0.1);
        values[FLOW_ROLL_BEFORE] = rng.uniform(-0.1, 0.1);
        for (size_t k = 0; k < bearings.size(); k++, count++)
        {
            const double h = 1e-6;
            FlowResidual::View view = residual.predict(bearings[k], values);
            Point2d got;
            residual.residualOf(bearings[k], values, view, &got);
            view.inverseDepth += h;
            const Point2d nearer = residual.residualOf(bearings[k], values, view);
            view.inverseDepth -= 2 * h;
            const Point2d slope = (nearer - residual.residualOf(bearings[k], values, view)) * (0.5 / h);
            ASSERT_LT(cv::norm(slope - got), 1e-6 * cv::norm(slope) + 1e-6) << "motion " << i << ", point " << k;
        }
    }
    EXPECT_GT(count, 1500);
}

TEST_P(Scans, motion_is_found)
{
    RNG rng(7);
    const RollingShutterCamera camera = driveCamera(GetParam());
    std::vector<double> yaw, speed, left;
    for (int i = 0; i < 60; i++)
    {
        const Truth truth = randomTruth(rng);
        const Simulator simulator = simulate(camera, truth);
        const std::vector<TrackedBearing> bearings =
            bearingsOf(camera, randomPairs(simulator, 0.05, 250, 0.3, 0.2, rng), 0.05);
        if (bearings.size() < 100)
            continue;
        const SequenceFit fit = fitFrame(camera, bearings, std::vector<UprightSegment>(),
                                         SequenceState(camera, AckermannEstimator::Params()), true);
        EXPECT_TRUE(fit.moves) << i;
        EXPECT_LT(fit.residual, 0.5) << i;
        EXPECT_GT(fit.agreeing, 0.7) << i;
        for (int k = SEQUENCE_LEFT; k <= SEQUENCE_ROAD; k++)
            EXPECT_GE(fit.values[k], 0) << i;
        yaw.push_back(std::abs(fit.state.value[SEQUENCE_YAW_RATE] - truth.yawRate) / DEGREE);
        speed.push_back(std::abs(fit.state.value[SEQUENCE_SPEED] / truth.speed - 1));
        if (truth.left > 0)
            left.push_back(std::abs(fit.state.value[SEQUENCE_LEFT] * truth.left - 1));
    }
    ASSERT_GT(yaw.size(), 50u);
    EXPECT_LT(median(yaw), 0.2);
    EXPECT_LT(*std::max_element(yaw.begin(), yaw.end()), 1.5);
    EXPECT_LT(median(speed), 0.1);
    EXPECT_LT(median(left), 0.2);
}

//! A frame of which 250 points are seen in the one before, while its camera pitches and rolls ever faster or slower.
std::vector<TrackedBearing> shakenBearings(const Simulator& simulator, double changeSigma, RNG& rng)
{
    const double interval = 1. / 30, pitch = rng.gaussian(changeSigma), roll = rng.gaussian(changeSigma);
    std::vector<TrackedBearing> bearings =
        bearingsOf(simulator.camera, randomPairs(simulator, interval, 250, 0.3, 0, rng), interval);
    for (TrackedBearing& b : bearings)
    {
        const double seconds = b.timeNow * simulator.camera.secondsPerUnitTime(), x = b.now.x, y = b.now.y;
        b.now += seconds * (pitch * Point2d(x * y, 1 + y * y) + roll * Point2d(-y, x));
    }
    return bearings;
}

// A pitch rate that changes looks like a road that is nearer: the state is as uncertain as these changes make it.
TEST_P(Scans, states_of_cameras_that_shake_have_true_sigmas)
{
    RNG rng(8);
    const RollingShutterCamera camera = driveCamera(GetParam());
    const double size = 20 * DEGREE; // per second
    int count = 0;
    // Squares of the errors of speeds, and the same in sigmas, if changes are expected and if they aren't
    double errors[2] = {0, 0}, squares[2] = {0, 0};
    for (int i = 0; i < 20; i++)
    {
        const Truth truth = {rng.uniform(-0.2, 0.2), rng.uniform(6., 14.), rng.uniform(6., 15.), rng.uniform(6., 15.),
                             0};
        const Simulator simulator = simulate(camera, truth);
        SequenceState state = stateOf(camera, truth);
        state.covariance(SEQUENCE_ROAD, SEQUENCE_ROAD) *= 1e-4; // a speed is as uncertain as the camera's height
        SequenceState states[2] = {state, state};
        for (int frame = 0; frame < 10; frame++)
        {
            const std::vector<TrackedBearing> bearings = shakenBearings(simulator, size, rng);
            for (int k = 0; k < 2; k++)
            {
                FitNuisances nuisances;
                nuisances.pitchChange = nuisances.rollChange = k == 0 ? size : 0;
                const SequenceState fitted =
                    fitFrame(camera, bearings, std::vector<UprightSegment>(), states[k], false, nuisances).state;
                const double error = fitted.value[SEQUENCE_SPEED] - truth.speed;
                errors[k] += error * error;
                squares[k] += error * error / fitted.covariance(SEQUENCE_SPEED, SEQUENCE_SPEED);
                states[k] = fitted;
                states[k].predict(1. / 30);
            }
            count++;
        }
    }
    EXPECT_LT(errors[0], 0.5 * errors[1]);
    EXPECT_LT(squares[0], count);
    EXPECT_GT(squares[1], 2 * squares[0]);
}

//! A frame of a street whose parts are off its planes, by shares of a usual deviation.
std::vector<TrackedBearing> unevenBearings(const Simulator& simulator, const Truth& truth, double share, RNG& rng)
{
    const double interval = 1. / 30;
    const RollingShutterCamera& camera = simulator.camera;
    const FlowResidual residual(camera);
    double values[FLOW_VALUES] = {0};
    const SequenceVector value = stateOf(camera, truth).value;
    std::copy(value.val, value.val + SEQUENCE_VALUES, values);
    std::vector<TrackedBearing> bearings =
        bearingsOf(camera, randomPairs(simulator, interval, 250, 0.3, 0, rng), interval);
    for (TrackedBearing& b : bearings)
    {
        const Point2d d =
            pixelsOfDeviation(residual, b, values, camera.secondsPerUnitTime(), residual.predict(b, values));
        b.other += rng.gaussian(share) / camera.cameraMatrix(0, 0) * d;
    }
    return bearings;
}

// Of points that are exact a street that is plane shows a yaw rate well, and an uneven one as well as it is uneven.
TEST_P(Scans, states_of_uneven_streets_have_true_sigmas)
{
    for (const double heading : {0., -CV_PI / 2})
    {
        SCOPED_TRACE(heading);
        double sigmas[2];
        for (int uneven = 0; uneven < 2; uneven++)
        {
            RNG rng(10);
            RollingShutterCamera camera = driveCamera(GetParam());
            camera.heading = heading;
            std::vector<double> errors, found;
            for (int i = 0; i < 100; i++)
            {
                const Truth truth = {rng.uniform(-0.2, 0.2), rng.uniform(6., 14.), rng.uniform(6., 15.),
                                     rng.uniform(6., 15.), 0};
                SequenceState state = stateOf(camera, truth);
                // Of a known gravity: another one makes plane streets uncertain, too.
                state.measure(SEQUENCE_ROLL, 0, 1e-6);
                state.measure(SEQUENCE_PITCH, 0, 1e-6);
                const std::vector<TrackedBearing> bearings =
                    unevenBearings(simulate(camera, truth), truth, 0.5 * uneven, rng);
                const SequenceState fitted =
                    fitFrame(camera, bearings, std::vector<UprightSegment>(), state, false).state;
                const double sigma = std::sqrt(fitted.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE));
                errors.push_back(std::abs(fitted.value[SEQUENCE_YAW_RATE] - truth.yawRate) / sigma);
                found.push_back(sigma);
            }
            sigmas[uneven] = median(found);
            RecordProperty("sigma", format("%.2f deg/s", sigmas[uneven] / DEGREE));
            EXPECT_LT(*std::max_element(errors.begin(), errors.end()), 2);
            EXPECT_GT(median(errors), 0.1);
        }
        EXPECT_LT(sigmas[0], 0.5 * DEGREE);
        EXPECT_GT(sigmas[1], (heading == 0 ? 1.3 : 3) * sigmas[0]); // beside a wall turning looks like passing
    }
}

// Points of one house that stands back err together: many of them show no more than few.
TEST_P(Scans, states_beside_houses_have_true_sigmas)
{
    RNG rng(11);
    RollingShutterCamera camera = driveCamera(GetParam());
    camera.heading = -CV_PI / 2;
    const int houses = 6, trials = 100;
    int beyond = 0; // two sigmas
    for (int i = 0; i < trials; i++)
    {
        const Truth truth = {rng.uniform(-0.2, 0.2), rng.uniform(6., 14.), 0, rng.uniform(6., 15.), 0};
        SequenceState state = stateOf(camera, truth);
        state.measure(SEQUENCE_ROLL, 0, 1e-6);
        state.measure(SEQUENCE_PITCH, 0, 1e-6);
        state.measure(SEQUENCE_SPEED, truth.speed, 0.01);
        double values[FLOW_VALUES] = {0};
        std::copy(state.value.val, state.value.val + SEQUENCE_VALUES, values);
        const FlowResidual residual(camera);
        const double interval = 1. / 30, unit = camera.secondsPerUnitTime();
        double standing[houses];
        for (double& s : standing)
            s = rng.gaussian(0.5);
        std::vector<TrackedBearing> bearings =
            bearingsOf(camera, randomPairs(simulate(camera, truth), interval, 600, 0.1, 0, rng), interval);
        for (TrackedBearing& b : bearings)
        {
            const double across = b.now.x * camera.cameraMatrix(0, 0) / camera.imageSize.width + 0.5;
            const int house = std::min(std::max(cvFloor(across * houses), 0), houses - 1);
            b.other += standing[house] / camera.cameraMatrix(0, 0) *
                       pixelsOfDeviation(residual, b, values, unit, residual.predict(b, values));
        }
        const SequenceState fitted = fitFrame(camera, bearings, std::vector<UprightSegment>(), state, false).state;
        beyond += std::abs(fitted.value[SEQUENCE_YAW_RATE] - truth.yawRate) >
                  2 * std::sqrt(fitted.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE));
    }
    RecordProperty("beyond", beyond);
    EXPECT_LE(beyond, trials / 10);
}

//! A camera of which is known only how it would be without a tilt, that of a state.
RollingShutterCamera untilted(const RollingShutterCamera& camera, const SequenceVector& state)
{
    RollingShutterCamera given = camera;
    given.uprightRotation = tiltRotation(state[SEQUENCE_ROLL], state[SEQUENCE_PITCH]).t() * camera.uprightRotation;
    return given;
}

// Points that move along the road show how the camera is tilted; as if it weren't they would show another speed.
TEST_P(Scans, points_show_the_tilt)
{
    RNG rng(12);
    std::vector<double> errors[SEQUENCE_VALUES], pitches;
    for (int i = 0; i < 100; i++)
    {
        const RollingShutterCamera camera = driveCamera(GetParam());
        const Truth truth = {rng.uniform(-0.2, 0.2), rng.uniform(6., 14.), rng.uniform(6., 15.), rng.uniform(6., 15.),
                             0};
        SequenceVector expected = stateOf(camera, truth).value;
        expected[SEQUENCE_ROLL] = rng.uniform(-3., 3.) * DEGREE;
        expected[SEQUENCE_PITCH] = rng.uniform(-3., 3.) * DEGREE;
        const RollingShutterCamera given = untilted(camera, expected);
        AckermannEstimator::Params params;
        params.gravitySigma = params.vehiclePitchSigma = 3 * DEGREE;
        const double interval = 1. / 30;
        const std::vector<TrackedBearing> bearings =
            bearingsOf(given, randomPairs(simulate(camera, truth), interval, 250, 0.3, 0, rng), interval);
        const SequenceState fitted =
            fitFrame(given, bearings, std::vector<UprightSegment>(), SequenceState(given, params), true).state;
        for (int which : {SEQUENCE_YAW_RATE, SEQUENCE_SPEED, SEQUENCE_ROLL, SEQUENCE_PITCH})
            errors[which].push_back(std::abs(fitted.value[which] - expected[which]) /
                                    std::sqrt(fitted.covariance(which, which)));
        pitches.push_back(std::sqrt(fitted.covariance(SEQUENCE_PITCH, SEQUENCE_PITCH)));
    }
    for (int which : {SEQUENCE_YAW_RATE, SEQUENCE_SPEED, SEQUENCE_ROLL, SEQUENCE_PITCH})
    {
        EXPECT_LT(*std::max_element(errors[which].begin(), errors[which].end()), 3) << "value " << which;
        EXPECT_GT(median(errors[which]), 0.05) << "value " << which;
    }
    EXPECT_LT(median(pitches), 0.5 * DEGREE);
}

// They are looked for where a camera of this tilt sees them.
TEST_P(Scans, points_are_expected_with_the_tilt)
{
    RNG rng(13);
    const RollingShutterCamera camera = driveCamera(GetParam());
    const double interval = 1. / 30;
    std::vector<double> errors, ways;
    for (int i = 0; i < 20; i++)
    {
        const Truth truth = {rng.uniform(-0.2, 0.2), rng.uniform(6., 14.), rng.uniform(6., 15.), rng.uniform(6., 15.),
                             0};
        SequenceVector expected = stateOf(camera, truth).value;
        expected[SEQUENCE_ROLL] = rng.uniform(-3., 3.) * DEGREE;
        expected[SEQUENCE_PITCH] = (i % 2 ? 3 : -3) * DEGREE;
        const RollingShutterCamera given = untilted(camera, expected);
        SequenceFilter filter(given, AckermannEstimator::Params());
        filter.state.value = expected;
        filter.isUninitialised = false;
        const FramePrediction::Function predict = predictPoints(given, AckermannEstimator::Params(), filter, 0).known;
        for (const PointPair& pair : randomPairs(simulate(camera, truth), interval, 50, 0, 0, rng))
        {
            errors.push_back(cv::norm(predict(pair.now, interval) - pair.other));
            ways.push_back(cv::norm(pair.now - pair.other));
        }
    }
    EXPECT_LT(median(errors), 0.03 * median(ways)); // the row in which the other image has them isn't known
}

// Times that jitter, as those at which a computer received the frames, look like a speed that does: the state is as
// uncertain as they make it, and the speed is a mean. Those of a clock without errors cost nothing.
TEST_P(Scans, states_of_frames_whose_times_jitter_have_true_sigmas)
{
    RNG rng(9);
    const RollingShutterCamera camera = driveCamera(GetParam());
    const double interval = 1. / 30;
    for (const double jitter : {0., 0.003})
    {
        int count = 0;
        // Of the speeds, with errors of the times in mind and without
        double errors[2] = {0, 0}, squares[2] = {0, 0}, variances[2] = {0, 0};
        for (int i = 0; i < 4; i++)
        {
            const Truth truth = {rng.uniform(-0.2, 0.2), rng.uniform(6., 14.), rng.uniform(6., 15.),
                                 rng.uniform(6., 15.), 0};
            const Simulator simulator = simulate(camera, truth);
            SequenceState state = stateOf(camera, truth);
            state.covariance(SEQUENCE_ROAD, SEQUENCE_ROAD) *= 1e-4; // a speed is as uncertain as the camera's height
            SequenceState states[2] = {state, state};
            ClockNoise noise;
            double errorBefore = 0;
            for (int frame = 0; frame < 40; frame++)
            {
                const double error = rng.gaussian(jitter), given = interval + error - errorBefore;
                errorBefore = error;
                const std::vector<TrackedBearing> bearings =
                    bearingsOf(camera, randomPairs(simulator, interval, 250, 0.3, 0, rng), given);
                FitNuisances nuisances;
                nuisances.interval = noise.sigma();
                for (int k = 0; k < 2; k++)
                {
                    states[k].predict(given);
                    const SequenceFit fit = fitFrame(camera, bearings, std::vector<UprightSegment>(), states[k], false,
                                                     k == 0 ? nuisances : FitNuisances());
                    if (k == 0)
                        noise.add(fit.values[SEQUENCE_SPEED], given);
                    states[k] = fit.state;
                    const double off = fit.state.value[SEQUENCE_SPEED] - truth.speed,
                                 variance = fit.state.covariance(SEQUENCE_SPEED, SEQUENCE_SPEED);
                    if (frame < 10)
                        continue; // that show the errors
                    errors[k] += off * off;
                    squares[k] += off * off / variance;
                    variances[k] += variance;
                }
                count += frame >= 10;
            }
        }
        SCOPED_TRACE(testing::Message() << jitter << ": " << errors[0] / count << " " << errors[1] / count << ", "
                                        << squares[0] / count << " " << squares[1] / count << ", "
                                        << variances[0] / variances[1]);
        EXPECT_LT(squares[0], 1.5 * count);
        if (jitter == 0)
        {
            EXPECT_LT(variances[0], 1.2 * variances[1]);
        }
        else
        {
            EXPECT_LT(errors[0], 0.5 * errors[1]);
            EXPECT_GT(squares[1], 2 * count);
        }
    }
}

// Of times with errors an interval has those of both of its ends.
TEST(RSAckermann_Sequence, noise_of_the_clock_is_that_of_intervals)
{
    const double interval = 1. / 30, jitter = 0.002;
    RNG rng(4);
    double sum = 0;
    const int drives = 20;
    for (int i = 0; i < drives; i++)
    {
        ClockNoise noise(1e9);
        double before = 0;
        for (int frame = 0; frame < 2000; frame++)
        {
            const double error = rng.gaussian(jitter), given = interval + error - before;
            noise.add(12 * interval / given, given);
            before = error;
        }
        sum += noise.sigma();
    }
    EXPECT_NEAR(std::sqrt(2.) * jitter / interval, sum / drives, 0.005);
}

TEST(RSAckermann_Sequence, noise_of_the_clock_is_finite_beside_rest)
{
    for (const Vec3d& speeds : {Vec3d(0, 10, 0), Vec3d(10, 0, 10), Vec3d(10, -10, 10), Vec3d(0, 0, 0)})
    {
        ClockNoise noise;
        for (int i = 0; i < 3; i++)
            noise.add(speeds[i], 0.1);
        EXPECT_GE(noise.sigma(), 0);
        EXPECT_LT(noise.sigma(), 1);
    }
}

INSTANTIATE_TEST_CASE_P(RSAckermann_Sequence, Scans, testing::Values(int(SCAN_TOP_TO_BOTTOM), int(SCAN_BOTTOM_TO_TOP)));

TEST(RSAckermann_Sequence, rest_is_rest)
{
    RNG rng(8);
    const RollingShutterCamera camera = driveCamera();
    for (int i = 0; i < 20; i++)
    {
        const Truth truth = {0, 0, 6, 7, 0};
        Truth moving = truth;
        moving.speed = 1; // only to have points: those of a camera at rest are where they were
        std::vector<PointPair> pairs = randomPairs(simulate(camera, moving), 0.05, 200, 0, 0, rng);
        for (size_t k = 0; k < pairs.size(); k++)
            pairs[k].other = pairs[k].now + gaussianPoint(rng, 0.2);
        const SequenceFit fit = fitFrame(camera, bearingsOf(camera, pairs, 0.05), std::vector<UprightSegment>(),
                                         SequenceState(camera, AckermannEstimator::Params()), true);
        EXPECT_FALSE(fit.moves) << i;
        EXPECT_LT(std::abs(fit.state.value[SEQUENCE_YAW_RATE]), 0.5 * DEGREE) << i;
    }
}

//! Largest relative error of the road where it hardly has points, and something else has some that all moved by some
//! pixels: 0 on the car itself, others on a car ahead.
double roadErrorBeside(int otherPoints, const Point2d& moved, bool isUninitialised)
{
    RNG rng(9);
    const RollingShutterCamera camera = driveCamera();
    const double seconds = 0.1, top = 0.85 * camera.imageSize.height;
    double largest = 0;
    for (int i = 0; i < 40; i++)
    {
        const Truth truth = {rng.uniform(-0.1, 0.1), 11, 8, 6, 0.05};
        const std::vector<PointPair> all = randomPairs(simulate(camera, truth), seconds, 250, 0.3, 0.1, rng);
        std::vector<PointPair> pairs;
        for (size_t k = 0; k < all.size(); k++)
            if (all[k].now.y < 0.6 * camera.imageSize.height || (all[k].now.y < top && rng.uniform(0., 1.) < 0.3))
                pairs.push_back(all[k]);
        for (int k = 0; k < otherPoints; k++)
        {
            PointPair other;
            other.now = uniformPoint(rng, Point2d(300, top), Point2d(660, camera.imageSize.height));
            other.other = other.now + moved + gaussianPoint(rng, 0.1);
            pairs.push_back(other);
        }
        const SequenceState before =
            isUninitialised ? SequenceState(camera, AckermannEstimator::Params()) : stateOf(camera, truth);
        const SequenceFit fit = fitFrame(camera, bearingsOf(camera, pairs, seconds), std::vector<UprightSegment>(),
                                         before, isUninitialised);
        EXPECT_TRUE(fit.moves) << i;
        largest = std::max(largest, std::abs(fit.state.value[SEQUENCE_ROAD] * camera.height - 1));
    }
    return largest;
}

TEST(RSAckermann_Sequence, own_bonnet_is_no_distant_road)
{
    EXPECT_LT(roadErrorBeside(40, Point2d(), false), 0.2);
    EXPECT_LT(roadErrorBeside(150, Point2d(), false), 0.2);
    EXPECT_LT(roadErrorBeside(40, Point2d(), true), 0.2);
    EXPECT_LT(roadErrorBeside(150, Point2d(), true), 0.2);
}

// However large it is: the points of the scene are those that agree.
TEST(RSAckermann_Sequence, own_car_is_no_other_scene)
{
    RNG rng(12);
    const RollingShutterCamera camera = driveCamera();
    const AckermannEstimator::Params params;
    const Truth truth = {0.2, 11, 8, 6, 0.05};
    for (const int stillPoints : {0, 100, 400})
    {
        std::vector<PointPair> pairs = randomPairs(simulate(camera, truth), 0.1, 200, 0.1, 0.1, rng);
        for (int k = 0; k < stillPoints; k++)
        {
            const Point2d at = uniformPoint(rng, Point2d(0, 300), Point2d(960, 540));
            pairs.push_back({at, at});
        }
        const SequenceFit fit = fitFrame(camera, bearingsOf(camera, pairs, 0.1), std::vector<UprightSegment>(),
                                         stateOf(camera, truth), false);
        EXPECT_NEAR(0.9, fit.agreeing, 0.06) << stillPoints;
        EXPECT_TRUE(fit.moves) << stillPoints;
        EXPECT_NEAR(truth.yawRate, fit.state.value[SEQUENCE_YAW_RATE], 0.5 * DEGREE) << stillPoints;
    }
}

// Nor is a dashboard, which hides the road but for a strip of it.
TEST(RSAckermann_Sequence, dashboard_is_no_distant_road)
{
    RNG rng(13);
    const RollingShutterCamera camera = driveCamera();
    const double seconds = 1. / 30, edge = 380;
    const Truth truth = {0.1, 11, 6, 8, 0};
    for (const int stillPoints : {0, 60, 100})
    {
        SequenceFilter filter(camera, AckermannEstimator::Params());
        for (int frame = 0; frame < 10; frame++)
        {
            std::vector<PointPair> pairs;
            for (const PointPair& pair : randomPairs(simulate(camera, truth), seconds, 250, 0.3, 0.1, rng))
                if (pair.now.y < edge)
                    pairs.push_back(pair);
            for (int k = 0; k < stillPoints; k++)
            {
                const Point2d at = uniformPoint(rng, Point2d(0, edge), Point2d(960, 540));
                pairs.push_back({at + gaussianPoint(rng, 0.1), at});
            }
            FrameFeatures features;
            features.bearings = bearingsOf(camera, pairs, seconds);
            filter.advance(frame * seconds, camera, AckermannEstimator::Params());
            SequenceFit fit(filter.state);
            ASSERT_TRUE(filter.update(features, camera, AckermannEstimator::Params(), fit)) << stillPoints;
            EXPECT_TRUE(fit.moves) << stillPoints;
            EXPECT_NEAR(truth.speed, fit.state.value[SEQUENCE_SPEED], 2) << stillPoints << ", frame " << frame;
            EXPECT_NEAR(truth.yawRate, fit.state.value[SEQUENCE_YAW_RATE], 1 * DEGREE) << stillPoints;
        }
    }
}

TEST(RSAckermann_Sequence, car_ahead_is_no_distant_road)
{
    EXPECT_LT(roadErrorBeside(40, Point2d(1, 3), false), 0.2);
}

// All points stand still then, but that isn't the car itself; whatever the motion was before.
TEST(RSAckermann_Sequence, sudden_stop_is_rest)
{
    RNG rng(11);
    const RollingShutterCamera camera = driveCamera();
    for (int i = 0; i < 100; i++)
    {
        std::vector<PointPair> pairs = randomPairs(simulate(camera, randomTruth(rng)), 0.05, 200, 0, 0, rng);
        for (size_t k = 0; k < pairs.size(); k++)
            pairs[k].other = pairs[k].now + gaussianPoint(rng, 0.2);
        const SequenceFit fit = fitFrame(camera, bearingsOf(camera, pairs, 0.05), std::vector<UprightSegment>(),
                                         stateOf(camera, randomTruth(rng)), false);
        EXPECT_FALSE(fit.moves) << i;
        EXPECT_GT(fit.agreeing, 0.9) << i;
        EXPECT_LT(std::abs(fit.state.value[SEQUENCE_YAW_RATE]), 0.5 * DEGREE) << i;
    }
}

//! Median error in degrees of the roll that verticals tell, with the motion known from points, or else from the frames
//! before.
double rollError(bool hasPoints)
{
    std::vector<double> errors;
    for (int i = 0; i < 30; i++)
    {
        RNG rng(100 + i);
        const RollingShutterCamera camera = driveCamera();
        const Truth truth = {rng.uniform(-0.3, 0.3), 12, 6, 7, 0};
        const double roll = rng.uniform(-1., 1.) * DEGREE;
        const Simulator simulator = simulate(camera, truth);
        RollingShutterCamera believed = camera;
        believed.setRollPitch(0.01 - roll, 0.04);
        simulation::SegmentOptions options;
        options.noise = 0.3;
        std::vector<UprightSegment> verticals, others;
        Mat segments;
        simulation::randomSegments(simulator, options, rng).ends.convertTo(segments, CV_64F);
        selectCandidates(segments.reshape(1), believed, AckermannEstimator::Params(), verticals, others);
        std::vector<TrackedBearing> bearings;
        SequenceState prediction(believed, AckermannEstimator::Params());
        if (hasPoints)
            bearings = bearingsOf(believed, randomPairs(simulator, 0.05, 250, 0.3, 0.2, rng), 0.05);
        else
        {
            prediction = stateOf(believed, truth);
            for (int k = 0; k < SEQUENCE_ROLL; k++)
                prediction.covariance(k, k) *= 1e-6;
        }
        const SequenceFit fit = fitFrame(believed, bearings, verticals, prediction, hasPoints);
        errors.push_back(std::abs(fit.state.value[SEQUENCE_ROLL] - roll) / DEGREE);
    }
    return median(errors);
}

TEST(RSAckermann_Sequence, verticals_tell_roll)
{
    EXPECT_LT(rollError(true), 0.15);
    EXPECT_LT(rollError(false), 0.15);
}

TEST(RSAckermann_Sequence, state_forgets)
{
    const RollingShutterCamera camera = driveCamera();
    const SequenceState usual(camera, AckermannEstimator::Params());
    SequenceState once = usual;
    once.measure(SEQUENCE_YAW_RATE, 0.3, 0.01);
    once.measure(SEQUENCE_LEFT, 0.25, 0.001);
    SequenceState twice = once, late = once;
    once.predict(0.5);
    for (int i = 0; i < 5; i++)
        twice.predict(0.1);
    late.predict(1000);
    EXPECT_LT(cv::norm(once.value - twice.value), 1e-9);
    EXPECT_LT(cv::norm(once.covariance - twice.covariance), 1e-9);
    EXPECT_LT(cv::norm(late.value - usual.value), 1e-9);
    EXPECT_LT(cv::norm(late.covariance - usual.covariance), 1e-9);
}

// Each value within its own time (doc/theory.md, "Sequence"), and what two values have to do with each other as fast.
TEST(RSAckermann_Sequence, values_are_forgotten_one_by_one)
{
    const double memories[SEQUENCE_VALUES] = {2, 10, 1, 1, 1, 1, 10, 10}, seconds = 0.7;
    const SequenceState usual(driveCamera(), AckermannEstimator::Params());
    for (int i = 0; i < SEQUENCE_VALUES; i++)
        for (int j = 0; j < SEQUENCE_VALUES; j++)
        {
            SequenceState state = usual;
            state.value[i] += 0.1;
            state.covariance(i, j) = state.covariance(j, i) = 1e-3;
            state.predict(seconds);
            const double kept = std::exp(-seconds / memories[i]), rest = kept * std::exp(-seconds / memories[j]);
            EXPECT_NEAR(usual.value[i] + 0.1 * kept, state.value[i], 1e-12) << i;
            EXPECT_NEAR(1e-3 * rest + (i == j ? (1 - rest) * usual.covariance(i, i) : 0), state.covariance(i, j), 1e-12)
                << i << " " << j;
        }
}

// Whichever way time passes: what is known becomes less.
TEST(RSAckermann_Sequence, filter_in_reversed_time)
{
    const RollingShutterCamera camera = driveCamera();
    const AckermannEstimator::Params params;
    SequenceFilter filters[] = {SequenceFilter(camera, params), SequenceFilter(camera, params)};
    const double passed[] = {0.3, -0.3};
    double known = 0;
    for (int i = 0; i < 2; i++)
    {
        filters[i].advance(5, camera, params);
        filters[i].state.measure(SEQUENCE_YAW_RATE, 0.3, 0.01);
        known = filters[i].state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE);
        EXPECT_TRUE(filters[i].advance(5 + passed[i], camera, params));
    }
    EXPECT_GT(filters[0].state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE), known);
    EXPECT_LT(cv::norm(filters[0].state.value - filters[1].state.value), 1e-9);
    EXPECT_LT(cv::norm(filters[0].state.covariance - filters[1].state.covariance), 1e-9);
}

TEST(RSAckermann_Sequence, measurement_is_weighed)
{
    const RollingShutterCamera camera = driveCamera();
    SequenceState state(camera, AckermannEstimator::Params());
    state.covariance(SEQUENCE_SPEED, SEQUENCE_ROAD) = state.covariance(SEQUENCE_ROAD, SEQUENCE_SPEED) = 0.5;
    const SequenceState before = state;
    const double variance = before.covariance(SEQUENCE_SPEED, SEQUENCE_SPEED), sigma = 3,
                 total = variance + sigma * sigma;
    state.measure(SEQUENCE_SPEED, 20, sigma);
    EXPECT_NEAR((before.value[SEQUENCE_SPEED] * sigma * sigma + 20 * variance) / total, state.value[SEQUENCE_SPEED],
                1e-9);
    EXPECT_NEAR(variance * sigma * sigma / total, state.covariance(SEQUENCE_SPEED, SEQUENCE_SPEED), 1e-9);
    EXPECT_NEAR(before.value[SEQUENCE_ROAD] + 0.5 * (20 - before.value[SEQUENCE_SPEED]) / total,
                state.value[SEQUENCE_ROAD], 1e-9);
    const SequenceState same = state;
    state.measure(SEQUENCE_SPEED, 5, 0);
    EXPECT_EQ(same.value[SEQUENCE_SPEED], state.value[SEQUENCE_SPEED]);
}

// Each of the values that a prior may have, alone or beside the others.
TEST(RSAckermann_Sequence, given_values_are_measurements)
{
    for (int which = 1; which < 8; which++)
    {
        MotionPrior prior;
        prior.yawRate = 0.2;
        prior.speed = -7;
        prior.wallDirection = 0.1;
        prior.yawRateSigma = which & 1 ? 0.03 : 0;
        prior.speedSigma = which & 2 ? 1 : 0;
        prior.wallDirectionSigma = which & 4 ? 0.02 : 0;
        SequenceState state(driveCamera(), AckermannEstimator::Params()), expected = state;
        state.measure(prior);
        expected.measure(SEQUENCE_YAW_RATE, prior.yawRate, prior.yawRateSigma);
        expected.measure(SEQUENCE_SPEED, prior.speed, prior.speedSigma);
        expected.measure(SEQUENCE_DIRECTION, prior.wallDirection, prior.wallDirectionSigma);
        EXPECT_LT(cv::norm(expected.value - state.value, NORM_INF), 1e-9) << which;
        EXPECT_LT(cv::norm(expected.covariance - state.covariance, NORM_INF), 1e-9) << which;
    }
}

TEST(RSAckermann_Sequence, state_is_a_motion)
{
    RNG rng(9);
    const RollingShutterCamera camera = driveCamera();
    for (int i = 0; i < 200; i++)
    {
        const Truth truth = randomTruth(rng);
        const AckermannMotion expected =
            motionFromMetric(camera, truth.yawRate, truth.speed, truth.left, truth.right, truth.direction);
        AckermannMotion got;
        stateOf(camera, truth).toMotion(camera.secondsPerUnitTime(), got);
        EXPECT_NEAR(expected.alpha, got.alpha, 1e-12);
        EXPECT_NEAR(expected.wallSlope, got.wallSlope, 1e-12);
        EXPECT_NEAR(expected.wallOffset, got.wallOffset, 1e-12);
        EXPECT_NEAR(expected.wallRatio, got.wallRatio, 1e-9);
        EXPECT_NEAR(expected.roadSlope, got.roadSlope, 1e-12);
        EXPECT_EQ(expected.direction, got.direction);
    }
}

TEST(RSAckermann_Sequence, derivatives_of_the_model)
{
    RNG rng(10);
    const RollingShutterCamera camera = driveCamera();
    const double unit = camera.secondsPerUnitTime(), h = 1e-6;
    for (int i = 0; i < 100; i++)
    {
        const SequenceVector value = stateOf(camera, randomTruth(rng)).value;
        Matx<double, PARAMETERS, SEQUENCE_VALUES> J;
        toModel(value, unit, &J);
        for (int v = 0; v < SEQUENCE_VALUES; v++)
        {
            if (value[v] == 0 && (v == SEQUENCE_LEFT || v == SEQUENCE_RIGHT))
                continue; // a wall that comes into being
            SequenceVector low = value, high = value;
            low[v] -= h;
            high[v] += h;
            const Model a = toModel(low, unit, 0), b = toModel(high, unit, 0);
            for (int p = 0; p < PARAMETERS; p++)
                EXPECT_NEAR((b.value[p] - a.value[p]) / (2 * h), J(p, v), 1e-5 * (1 + std::abs(J(p, v))))
                    << "parameter " << p << " by value " << v;
        }
    }
}

Mat randomTexture(const Size& size, double blur)
{
    RNG rng(11);
    Mat noise(size, CV_8U), texture;
    rng.fill(noise, RNG::UNIFORM, 0, 256);
    GaussianBlur(noise, texture, Size(), blur);
    normalize(texture, texture, 0, 255, NORM_MINMAX);
    return texture;
}

//! Points of an image in the one before.
void goOn(PointTracker& tracker, const Mat& image, int scale, std::vector<PointPair>& pairs,
          const PointPredictions& predictions = PointPredictions())
{
    tracker.set(image, scale);
    tracker.track(PointTracker::NEIGHBOUR, pairs, predictions);
}

TEST(RSAckermann_Sequence, points_are_tracked)
{
    // A texture that is shifted by whole pixels, in an image that is searched in a quarter of its size.
    const Mat texture = randomTexture(Size(1100, 600), 3);
    const Point shift(24, -10);
    PointTracker tracker(COARSE_PIXELS);
    std::vector<PointPair> pairs;
    goOn(tracker, texture(Rect(50, 40, 1000, 500)).clone(), 1, pairs);
    EXPECT_TRUE(pairs.empty());
    goOn(tracker, texture(Rect(Point(50, 40) - shift, Size(1000, 500))).clone(), 1, pairs);
    ASSERT_GT(pairs.size(), 100u);
    std::vector<double> errors;
    for (size_t i = 0; i < pairs.size(); i++)
        errors.push_back(cv::norm(pairs[i].now - pairs[i].other - Point2d(shift)));
    EXPECT_LT(median(errors), 0.2);
    tracker.reset();
    goOn(tracker, texture(Rect(50, 40, 1000, 500)).clone(), 1, pairs);
    EXPECT_TRUE(pairs.empty());
}

// As far as their prediction may be wrong; of several the right one counts, unless one before it is good enough.
TEST(RSAckermann_Sequence, points_are_looked_for_where_they_are_expected)
{
    const Mat texture = randomTexture(Size(1000, 600), 3);
    const Size size(600, 400);
    const Point shift(170, -90), off(5, -4);
    const auto expected = [=](const Point& error) {
        return [=](const Point2d& now) { return now - Point2d(shift + error); };
    };
    const auto share = [&](const PointPredictions& predictions) {
        PointTracker tracker(COARSE_PIXELS);
        std::vector<PointPair> pairs;
        goOn(tracker, texture(Rect(Point(200, 100), size)).clone(), 1, pairs, predictions);
        goOn(tracker, texture(Rect(Point(200, 100) - shift, size)).clone(), 1, pairs, predictions);
        int right = 0;
        for (const PointPair& pair : pairs)
            right += cv::norm(pair.now - pair.other - Point2d(shift)) < 0.2;
        EXPECT_GE(right, 0.9 * pairs.size());
        return double(right) / tracker.pointCount();
    };
    const double inBoth = (1 - 170 / 600.) * (1 - 90 / 400.);
    PointPredictions predictions;
    predictions.all = {expected(off)};
    EXPECT_GT(share(predictions), 0.8 * inBoth);
    predictions.all = {PointPrediction(), expected(off)};
    EXPECT_GT(share(predictions), 0.8 * inBoth);
    predictions.all = {expected(off), PointPrediction()};
    predictions.enough = 0.3;
    EXPECT_GT(share(predictions), 0.8 * inBoth);
}

// Exposure and lamps change what is seen of a texture, but not where it is.
TEST(RSAckermann_Sequence, points_in_another_light)
{
    const Mat texture = randomTexture(Size(640, 420), 2);
    const Mat before = texture(Rect(0, 0, 600, 400)).clone(), now = texture(Rect(8, 5, 600, 400)).clone();
    size_t found[2];
    for (const int changes : {0, 1})
    {
        PointTracker tracker(COARSE_PIXELS);
        std::vector<PointPair> pairs;
        goOn(tracker, before, 1, pairs);
        goOn(tracker, changes ? Mat(now * 0.7 + 50) : now, 1, pairs);
        found[changes] = pairs.size();
        std::vector<double> errors;
        for (const PointPair& pair : pairs)
            errors.push_back(cv::norm(pair.now - pair.other + Point2d(8, 5)));
        EXPECT_LT(median(errors), 0.2);
    }
    EXPECT_GT(found[1], 0.7 * found[0]);
}

// Waves across and lower ones along make a structure tensor whose eigenvalues are 25 to 1.
TEST(RSAckermann_Sequence, points_are_uncertain_along_edges)
{
    for (const double degrees : {0, 30, 90, 140})
    {
        SCOPED_TRACE(degrees);
        const Point2d across(std::cos(degrees * CV_PI / 180), std::sin(degrees * CV_PI / 180));
        Mat_<uchar> image(300, 400);
        for (int y = 0; y < image.rows; y++)
            for (int x = 0; x < image.cols; x++)
                image(y, x) = saturate_cast<uchar>(128 + 80 * std::sin(across.dot(Point2d(x, y)) / 2) +
                                                   16 * std::sin(across.cross(Point2d(x, y)) / 2));
        PointTracker tracker(COARSE_PIXELS);
        std::vector<PointPair> pairs;
        goOn(tracker, image, 1, pairs);
        goOn(tracker, image, 1, pairs);
        ASSERT_GT(pairs.size(), 100u);
        std::vector<double> along, aside;
        for (const PointPair& pair : pairs)
        {
            along.push_back(std::abs(across.cross(pair.weak)));
            aside.push_back(std::abs(across.dot(pair.weak)));
        }
        EXPECT_NEAR(25, median(along), 5);
        EXPECT_LT(median(aside), 5);
    }
}

TEST(RSAckermann_Sequence, edges_turn_with_the_camera)
{
    RollingShutterCamera camera(Size(640, 480), Matx33d(500, 0, 320, 0, 500, 240, 0, 0, 1));
    camera.lineDelay = 5e-5;
    camera.setRollPitch(30 * CV_PI / 180, -5 * CV_PI / 180);
    const Point2d at(330, 250), weak(3, 2);
    std::vector<TrackedBearing> bearings;
    addBearings(camera, {PointPair(at, at, weak), PointPair(at + weak, at + weak)}, 0.1, bearings);
    ASSERT_EQ(2u, bearings.size());
    const Point2d way = 500 * (bearings[1].now - bearings[0].now);
    EXPECT_LT(cv::norm(bearings[0].weak - way), 0.05 * cv::norm(weak));
    EXPECT_EQ(Point2d(), bearings[1].weak);
}

// A pixel of an image that was made smaller is in the middle of those that it was made of, by others and by the
// tracker.
TEST(RSAckermann_Sequence, points_of_a_smaller_image)
{
    const Mat texture = randomTexture(Size(400, 300), 1.5);
    for (const size_t maxPixels : {COARSE_PIXELS, COARSE_PIXELS / 4})
        for (const int scale : {2, 4})
        {
            std::vector<PointPair> pairs[2];
            for (int k = 0; k < 2; k++)
            {
                PointTracker tracker(maxPixels);
                for (int i = 0; i < 2; i++)
                    goOn(tracker, texture.colRange(2 * i, 390 + 2 * i).clone(), k ? scale : 1, pairs[k]);
            }
            ASSERT_GT(pairs[0].size(), 100u);
            ASSERT_EQ(pairs[0].size(), pairs[1].size());
            const Point2d shift = Point2d(0.5, 0.5) * (scale - 1);
            for (size_t i = 0; i < pairs[0].size(); i++)
            {
                EXPECT_LT(cv::norm(pairs[0][i].now * scale + shift - pairs[1][i].now), 1e-9);
                EXPECT_LT(cv::norm(pairs[0][i].other * scale + shift - pairs[1][i].other), 1e-9);
            }
        }
}

// What is odd of an image that the tracker makes smaller is left out: no place moves.
TEST(RSAckermann_Sequence, points_of_images_of_odd_sizes)
{
    const Mat texture = randomTexture(Size(1007, 603), 3);
    for (const int parts : {2, 4}) // that become one pixel
    {
        const Size odd(1000 + parts - 1, 600 + parts - 1), even(1000, 600);
        std::vector<PointPair> pairs[2];
        for (int k = 0; k < 2; k++)
        {
            PointTracker tracker(size_t(even.area() / (parts * parts)));
            for (int i = 0; i < 2; i++)
                goOn(tracker, texture(Rect(Point(4 * i, 0), k ? even : odd)).clone(), 1, pairs[k]);
        }
        ASSERT_GT(pairs[1].size(), 50u);
        ASSERT_EQ(pairs[1].size(), pairs[0].size());
        for (size_t i = 0; i < pairs[0].size(); i++)
        {
            EXPECT_EQ(pairs[1][i].now, pairs[0][i].now);
            EXPECT_EQ(pairs[1][i].other, pairs[0][i].other);
        }
    }
}

// What a car comes nearer to isn't shifted as a whole: a displacement belongs to what has the texture of its window.
TEST(RSAckermann_Sequence, points_are_where_their_displacement_is)
{
    const Mat before = randomTexture(Size(640, 400), 1.5);
    const double grown = 1.08;
    const Point2d centre(319.5, 199.5);
    const Matx23d growth(grown, 0, (1 - grown) * centre.x, 0, grown, (1 - grown) * centre.y);
    Mat now;
    warpAffine(before, now, growth, before.size(), INTER_CUBIC, BORDER_REFLECT);
    PointTracker tracker(COARSE_PIXELS);
    std::vector<PointPair> pairs;
    goOn(tracker, before, 1, pairs);
    goOn(tracker, now, 1, pairs);
    ASSERT_GT(pairs.size(), 500u);
    std::vector<double> errors;
    for (size_t i = 0; i < pairs.size(); i++)
        errors.push_back(cv::norm((pairs[i].now - centre) * (1 / grown) + centre - pairs[i].other));
    EXPECT_LT(median(errors), 0.05);
}

}} // namespace
