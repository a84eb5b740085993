// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// How a sequence finds the direction in which its camera moves.

#include "test_precomp.hpp"
#include "test_drive_simulator.hpp"
#include "../src/sequence/sequence_filter.hpp"

namespace opencv_test { namespace {

using namespace cv::rsackermann;
using namespace simulation;

RollingShutterCamera cameraOf(double heading)
{
    RollingShutterCamera camera(Size(960, 540), Matx33d(700, 0, 470, 0, 720, 280, 0, 0, 1));
    camera.lineDelay = 0.02 / 540;
    camera.height = 1.4;
    camera.heading = heading;
    camera.setRollPitch(0, 0);
    return camera;
}

struct Found
{
    SeenCamera seen;
    CameraVector difference;
    double yawSquares = 0; // mean of squared errors over variances
    double yawError = 0;   // rad/s, root mean square
};

// The frames of a drive, each by what those before show of the camera.
Found follow(const RollingShutterCamera& truth, const RollingShutterCamera& given, double lever, int frames, int seed)
{
    const AckermannEstimator::Params params;
    StreetDrive::Options options;
    options.lever = lever;
    StreetDrive street(truth, 0, 0, options, seed);
    SequenceFilter filter(given, params);
    FrameFeatures features;
    FitNuisances nuisances;
    Found found;
    for (int i = 0; i < frames; i++)
    {
        const StreetDrive::Frame frame = street.frame(i / 15., 1 / 15.);
        std::vector<PointPair> pairs;
        for (int k = 0; k < frame.points.rows; k++)
        {
            const double* p = frame.points.ptr<double>(k);
            pairs.push_back(PointPair{Point2d(p[0], p[1]), Point2d(p[2], p[3])});
        }
        features.setPoints(given, pairs, 1 / 15.);
        selectCandidates(frame.segments, given, params, features.verticals, features.others);
        filter.advance(frame.seconds, given, params);
        nuisances.curvature = curvatureOf(filter.state.value[SEQUENCE_YAW_RATE], filter.state.value[SEQUENCE_SPEED]);
        RollingShutterCamera turned = given;
        turned.heading += found.difference[CAMERA_HEADING] + nuisances.curvature * found.difference[CAMERA_LEVER];
        SequenceFit fit(filter.state);
        EXPECT_TRUE(filter.update(features, turned, params, fit, nuisances));
        found.seen.add(fit.camera, found.difference, 3);
        const CameraVector difference = found.seen.difference(given.headingSigma);
        filter.state.change(difference - found.difference);
        found.difference = difference;
        const SequenceState state = filter.state.marginal(found.seen.covariance(given.headingSigma));
        const double error = state.value[SEQUENCE_YAW_RATE] - street.rateAt(frame.seconds - 1 / 30.)[1]; // a mean
        found.yawSquares += error * error / state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE) / frames;
        found.yawError += error * error / frames;
    }
    found.yawError = std::sqrt(found.yawError);
    return found;
}

// Wherever the camera looks; the yaw rates that come with it err as they would if it was known.
TEST(RSAckermann_Heading, is_found_within_its_sigma)
{
    for (const double heading : {-1.5, -0.7, 0., 0.4, 3.1})
        for (const double error : {-0.06, 0.03})
        {
            const RollingShutterCamera truth = cameraOf(heading);
            RollingShutterCamera given = cameraOf(heading + error), exact = truth;
            exact.headingSigma = 0;
            const Found found = follow(truth, given, 0, 30, 3), known = follow(truth, exact, 0, 30, 3);
            SCOPED_TRACE(testing::Message() << heading << " " << error);
            EXPECT_NEAR(-error, found.seen.heading(), 3 * found.seen.headingSigma());
            EXPECT_LT(found.seen.headingSigma(), 0.01);
            EXPECT_NEAR(-error, found.difference[CAMERA_HEADING], 0.015);
            EXPECT_LT(found.yawError, 1.5 * known.yawError + 0.002);
            EXPECT_LT(found.yawSquares, 1.5 * known.yawSquares + 0.5);
        }
}

// Of a camera at the windscreen the yaw rates are wrong in bends unless it is known how far ahead of the axle it is.
TEST(RSAckermann_Heading, lever_is_found_in_bends)
{
    RollingShutterCamera truth = cameraOf(0.1);
    truth.headingSigma = 0;
    double squares = 0;
    const int drives = 6;
    for (int seed = 0; seed < drives; seed++)
    {
        const double lever = 1.5;
        const Found found = follow(truth, truth, lever, 60, 10 + seed);
        const double sigma = std::sqrt(found.seen.covariance(0)(CAMERA_LEVER, CAMERA_LEVER));
        EXPECT_NEAR(lever, found.difference[CAMERA_LEVER], 3 * sigma) << seed;
        EXPECT_LT(sigma, 0.7) << seed;
        EXPECT_EQ(0, cvRound(1e6 * found.difference[CAMERA_HEADING])) << seed;
        squares += found.yawSquares / drives;
    }
    EXPECT_LT(squares, 1.5);
}

// Means and covariances are those of a linear model with a given heading, before and after parts are long.
TEST(RSAckermann_Heading, estimate_is_that_of_a_linear_model)
{
    RNG rng(5);
    const double leverSigma = 1;
    for (const double givenSigma : {0., 0.02, 0.1})
        for (const int frames : {3, 12, 200})
        {
            double squares = 0;
            const int trials = 400;
            for (int i = 0; i < trials; i++)
            {
                const double heading = rng.gaussian(givenSigma), lever = rng.gaussian(leverSigma);
                SeenCamera seen;
                CameraVector used;
                double curvature = 0;
                for (int k = 0; k < frames; k++)
                {
                    curvature = rng.uniform(-0.1, 0.1);
                    // What a frame shows of the direction, beside the ratio, of a camera that was turned.
                    const double sigma = rng.uniform(0.02, 0.06), ofRatio = rng.uniform(-0.05, 0.05), ratio = 1.3,
                                 direction = heading + curvature * lever + ofRatio * (ratio - 1) + rng.gaussian(sigma),
                                 found = direction - used[CAMERA_HEADING] - curvature * used[CAMERA_LEVER];
                    const CameraVector by(ofRatio, 1, curvature);
                    CameraEvidence frame;
                    frame.information = by * by.t() * (1 / (sigma * sigma));
                    frame.gradient = by * (-found / (sigma * sigma));
                    seen.add(frame, used, 2);
                    used = seen.difference(givenSigma);
                }
                const CameraVector by(0, 1, curvature);
                const double error = by.dot(used) - heading - curvature * lever;
                squares += error * error / (by.t() * seen.covariance(givenSigma) * by)(0) / trials;
            }
            // The scatter of parts comes to what each is known to scatter.
            EXPECT_GT(squares, frames < 16 ? 0.8 : 0.4) << givenSigma << " " << frames;
            EXPECT_LT(squares, 1.25) << givenSigma << " " << frames;
        }
}

TEST(RSAckermann_Heading, is_not_known_without_evidence)
{
    SeenCamera seen;
    EXPECT_EQ(0, seen.heading());
    EXPECT_EQ(0, seen.headingSigma());
    EXPECT_EQ(CameraVector(), seen.difference(0.1));
    EXPECT_NEAR(0.1 * 0.1, seen.covariance(0.1)(CAMERA_HEADING, CAMERA_HEADING), 1e-9);
    for (int i = 0; i < 40; i++)
        seen.add(CameraEvidence(), CameraVector(), 2);
    EXPECT_EQ(0, seen.headingSigma());
    EXPECT_EQ(1, seen.readoutRatio());
    EXPECT_EQ(0, seen.readoutRatioSigma());
}

// What the camera's values add to a state, and where the street is expected of another camera.
TEST(RSAckermann_Heading, states_of_another_camera)
{
    const RollingShutterCamera camera = cameraOf(0.2);
    SequenceState state(camera, AckermannEstimator::Params());
    state.byCamera(SEQUENCE_YAW_RATE, CAMERA_HEADING) = 0.5;
    state.byCamera(SEQUENCE_YAW_RATE, CAMERA_LEVER) = 0.01;
    state.byCamera(SEQUENCE_LEFT, CAMERA_HEADING) = -100;
    CameraMatrix covariance = CameraMatrix::eye();
    covariance(CAMERA_HEADING, CAMERA_LEVER) = covariance(CAMERA_LEVER, CAMERA_HEADING) = -0.5;
    const double before = state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE);
    EXPECT_NEAR(before + 0.25 + 0.0001 - 2 * 0.5 * 0.5 * 0.01,
                state.marginal(covariance).covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE), 1e-12);
    const double yawRate = state.value[SEQUENCE_YAW_RATE];
    state.change(CameraVector(0, 0.1, 2));
    EXPECT_NEAR(yawRate + 0.5 * 0.1 + 0.01 * 2, state.value[SEQUENCE_YAW_RATE], 1e-12);
    EXPECT_EQ(0, state.value[SEQUENCE_LEFT]); // no wall is nearer than infinity the other way
    state.predict(1000);
    EXPECT_NEAR(0.3, state.value[SEQUENCE_DIRECTION], 1e-6);
}

}} // namespace opencv_test
