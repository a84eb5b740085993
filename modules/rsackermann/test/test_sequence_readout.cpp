// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_drive_simulator.hpp"
#include "../src/sequence/expected_displacement.hpp"
#include "../src/sequence/sequence_filter.hpp"
#include <numeric>

namespace opencv_test { namespace {

using simulation::StreetDrive;

const double READOUT = 0.025; // seconds

RollingShutterCamera cameraOf(int scan, double readout)
{
    RollingShutterCamera camera(Size(960, 540), Matx33d(700, 0, 470, 0, 720, 280, 0, 0, 1));
    camera.scanDirection = scan;
    camera.lineDelay = readout / (camera.isRowShutter() ? 540 : 960);
    camera.height = 1.4;
    camera.setRollPitch(0, 0);
    return camera;
}

// Of the right third of the image, by how much a truck that drives there makes points move and verticals lean.
struct Truck
{
    double motion = 0, lean = 0; // pixels, tangent
};

SeenCamera ratioOf(const RollingShutterCamera& truth, const RollingShutterCamera& given, int frames,
                   const Truck& truck = Truck())
{
    const double left = 640;
    const AckermannEstimator::Params params;
    StreetDrive street(truth, 0, 0, StreetDrive::Options(), 5);
    SequenceFilter filter(given, params);
    FrameFeatures features;
    FitNuisances nuisances;
    SeenCamera ratio;
    for (int i = 0; i < frames; i++)
    {
        StreetDrive::Frame frame = street.frame(i / 30., 1 / 30.);
        std::vector<PointPair> pairs;
        for (int k = 0; k < frame.points.rows; k++)
        {
            const double* p = frame.points.ptr<double>(k);
            const bool isOfTruck = p[2] > left;
            pairs.push_back(PointPair{Point2d(p[0] - isOfTruck * truck.motion, p[1]), Point2d(p[2], p[3])});
        }
        for (int k = 0; k < frame.segments.rows; k++)
        {
            Vec4d& segment = *frame.segments.ptr<Vec4d>(k);
            if (segment[0] > left)
                segment[0] += truck.lean * (segment[1] - segment[3]);
        }
        features.setPoints(given, pairs, 1 / 30.);
        selectCandidates(frame.segments, given, params, features.verticals, features.others);
        filter.advance(frame.seconds, given, params);
        SequenceFit fit(filter.state);
        nuisances.readoutRatio = ratio.readoutRatio();
        if (filter.update(features, given, params, fit, nuisances))
            ratio.add(fit.camera, CameraVector(), 1 / (30 * given.lineDelay * (given.isRowShutter() ? 540 : 960)));
    }
    return ratio;
}

TEST(RSAckermann_Readout, is_found_over_the_given_one)
{
    const RollingShutterCamera truth = cameraOf(SCAN_TOP_TO_BOTTOM, READOUT);
    for (const double ratio : {1., 0.5, 2.})
    {
        const SeenCamera found = ratioOf(truth, cameraOf(SCAN_TOP_TO_BOTTOM, READOUT / ratio), 60);
        EXPECT_NEAR(ratio, found.readoutRatio(), 0.25 * ratio);
        EXPECT_NEAR(ratio, found.readoutRatio(), 3 * found.readoutRatioSigma());
    }
    const SeenCamera reversed = ratioOf(truth, cameraOf(SCAN_BOTTOM_TO_TOP, READOUT), 60);
    EXPECT_NEAR(-1, reversed.readoutRatio(), 0.3);
    EXPECT_EQ(reversed.readoutRatio(), reversed.readoutContradiction());
    const SeenCamera global = ratioOf(cameraOf(SCAN_TOP_TO_BOTTOM, 1e-4 * READOUT), truth, 60);
    EXPECT_NEAR(0, global.readoutRatio(), 0.3);
    EXPECT_EQ(global.readoutRatio(), global.readoutContradiction());
}

// Verticals that a camera passes which looks aside lean all to one side: as by a roll, which the given read-out lets
// the first frames take for true.
TEST(RSAckermann_Readout, of_a_camera_that_looks_aside)
{
    for (const double heading : {-1.57, -1.2, -0.8, 0.6, 1.2, 1.57})
    {
        RollingShutterCamera truth = cameraOf(SCAN_TOP_TO_BOTTOM, READOUT),
                             given = cameraOf(SCAN_TOP_TO_BOTTOM, READOUT / 2);
        truth.heading = given.heading = heading;
        const SeenCamera found = ratioOf(truth, given, 60);
        EXPECT_NEAR(2, found.readoutRatio(), 0.5) << heading;
        EXPECT_NEAR(2, found.readoutRatio(), 3 * found.readoutRatioSigma()) << heading;
    }
}

// A camera that doesn't look quite where it is said to has its read-out nevertheless.
TEST(RSAckermann_Readout, of_a_heading_that_is_not_exact)
{
    for (const double heading : {-1.57, 0., 1.})
        for (const double error : {-4., 4.})
        {
            RollingShutterCamera truth = cameraOf(SCAN_TOP_TO_BOTTOM, READOUT), given = truth;
            truth.heading = heading;
            given.heading = heading + error * CV_PI / 180;
            const SeenCamera found = ratioOf(truth, given, 40);
            EXPECT_NEAR(1, found.readoutRatio(), 0.15) << heading << " " << error;
            EXPECT_EQ(1, found.readoutContradiction()) << heading << " " << error;
        }
}

// What a state owes to the read-out and the heading goes the way of the state.
TEST(RSAckermann_Readout, is_carried_with_the_state)
{
    const RollingShutterCamera camera = cameraOf(SCAN_TOP_TO_BOTTOM, READOUT);
    const AckermannEstimator::Params params;
    SequenceState state(camera, params);
    state.covariance(SEQUENCE_SPEED, SEQUENCE_LEFT) = state.covariance(SEQUENCE_LEFT, SEQUENCE_SPEED) = 0.05;
    for (int i = 0; i < SEQUENCE_VALUES; i++)
        for (int j = 0; j < CAMERA_VALUES; j++)
            state.byCamera(i, j) = 0.1 * (i + 1) * (j + 1);
    const double step = 1e-3;
    const SequenceState before = state;
    for (int j = 0; j < CAMERA_VALUES; j++)
    {
        state = before;
        SequenceState other = before; // of another camera
        for (int i = 0; i < SEQUENCE_VALUES; i++)
            other.value[i] += step * before.byCamera(i, j);
        for (SequenceState* s : {&state, &other})
        {
            s->predict(0.5);
            s->measure(SEQUENCE_SPEED, 12, 2);
            s->change(camera, params, SEQUENCE_ROLL);
        }
        for (int i = 0; i < SEQUENCE_VALUES; i++)
            EXPECT_NEAR((other.value[i] - state.value[i]) / step, state.byCamera(i, j), 1e-9) << i << " " << j;
    }
    EXPECT_GT(state.byCamera(SEQUENCE_LEFT, 0), 0.05);
    EXPECT_EQ(0, state.byCamera(SEQUENCE_PITCH, 0));
}

// A correction by a read-out that is a part of the true one leaves the rest.
TEST(RSAckermann_Readout, decides_whether_a_correction_helps)
{
    RNG rng(8);
    const double given = 2, rest = 0.3; // pixels
    for (const double ratio : {-1., 0., 0.4, 0.6, 1., 2.})
    {
        AckermannMotion motion;
        motion.expectedRaw = given;
        motion.expectedResidual = rest;
        motion.probabilityWorse = 0;
        expectReadout(ratio, motion);
        double raw = 0, left = 0, worse = 0;
        const int trials = 20000;
        for (int i = 0; i < trials; i++)
        {
            const double truth = ratio * given + rng.gaussian(rest * std::sqrt(CV_PI / 2));
            raw += std::abs(truth) / trials;
            left += std::abs(truth - given) / trials;
            worse += (std::abs(truth - given) > std::abs(truth)) / double(trials);
        }
        EXPECT_NEAR(raw, motion.expectedRaw, rest) << ratio;
        EXPECT_NEAR(left, motion.expectedResidual, 0.1) << ratio;
        EXPECT_NEAR(worse, motion.probabilityWorse, 0.02) << ratio;
        EXPECT_EQ(ratio > 0.5, motion.expectedResidual < motion.expectedRaw) << ratio;
    }
}

// Verticals beside points that move otherwise count as little as these.
TEST(RSAckermann_Readout, of_trucks_does_not_count)
{
    const RollingShutterCamera camera = cameraOf(SCAN_TOP_TO_BOTTOM, READOUT);
    for (const double lean : {-0.05, -0.01, 0.05})
    {
        Truck truck;
        truck.motion = 20;
        truck.lean = lean;
        const SeenCamera ratio = ratioOf(camera, camera, 60, truck);
        EXPECT_NEAR(1, ratio.readoutRatio(), 0.1) << lean;
    }
}

// Its standard deviation is that of parts of the drive, of which there are 16 at most.
TEST(RSAckermann_Readout, is_known_after_some_frames)
{
    const RollingShutterCamera camera = cameraOf(SCAN_TOP_TO_BOTTOM, READOUT);
    EXPECT_EQ(1, SeenCamera().readoutRatio());
    for (const int frames : {0, 14, 15, 32, 33, 64, 65, 150})
    {
        const SeenCamera ratio = ratioOf(camera, camera, frames);
        EXPECT_EQ(1, ratio.readoutContradiction()) << frames;
        EXPECT_EQ(frames > 14, ratio.readoutRatioSigma() > 0) << frames;
        EXPECT_NEAR(1, ratio.readoutRatio(), 0.1) << frames;
    }
}

// Where columns are read verticals don't lean.
TEST(RSAckermann_Readout, of_columns_is_not_known)
{
    const RollingShutterCamera camera = cameraOf(SCAN_LEFT_TO_RIGHT, READOUT);
    const SeenCamera ratio = ratioOf(camera, camera, 30);
    EXPECT_EQ(1, ratio.readoutRatio());
    EXPECT_EQ(0, ratio.readoutRatioSigma());
}

// The standard deviation is true of parts that differ at random, and doesn't depend on how many frames they have.
TEST(RSAckermann_Readout, sigma_is_that_of_parts)
{
    RNG rng(3);
    std::vector<double> squares;
    for (int i = 0; i < 500; i++)
    {
        SeenCamera ratio;
        const int frames = rng.uniform(20, 300);
        for (int k = 0; k < frames; k++)
        {
            CameraEvidence frame;
            frame.information(0, 0) = rng.uniform(0.5, 1.5);
            frame.gradient[0] = frame.information(0, 0) * (1 - 0.7 + rng.gaussian(3));
            ratio.add(frame, CameraVector(), 2);
        }
        const double byScene = 0.1,
                     byParts = std::sqrt(ratio.readoutRatioSigma() * ratio.readoutRatioSigma() - byScene * byScene);
        squares.push_back(std::pow((ratio.readoutRatio() - 0.7) / byParts, 2));
    }
    EXPECT_NEAR(1, std::accumulate(squares.begin(), squares.end(), 0.) / double(squares.size()), 0.25);
}

// Of lines that lean as if the read-out took longer than there is time nothing is said, whichever way they lean.
TEST(RSAckermann_Readout, longer_than_the_interval_is_none)
{
    const double longest = 1.2;
    for (const double shown : {60., 1.7, 1.1, -1.1, -1.7, -60.})
    {
        SeenCamera ratio;
        for (int k = 0; k < 40; k++)
        {
            CameraEvidence frame;
            frame.information(0, 0) = 100;
            frame.gradient[0] = (1 - shown) * frame.information(0, 0);
            ratio.add(frame, CameraVector(), k % 2 ? 0.6 * longest : 1.4 * longest); // on average
        }
        const bool isPossible = std::abs(shown) < longest;
        EXPECT_NEAR(isPossible ? shown : 1, ratio.readoutRatio(), 1e-9);
        EXPECT_EQ(isPossible, ratio.readoutRatioSigma() > 0);
        EXPECT_NEAR(shown == -1.1 ? -1.1 : 1, ratio.readoutContradiction(), 1e-9);
    }
}

// Where verticals hardly show it, as beside a road without houses, the most probable one may be far from what is
// possible: that says little against the given one.
TEST(RSAckermann_Readout, most_probable_of_those_that_are_possible)
{
    RNG rng(4);
    const double longest = 1.7, truths[] = {1, longest};
    const int trials = 300;
    int contradictions[2] = {}, beyond = 0;
    for (int i = 0; i < 2 * trials; i++)
    {
        const int which = i / trials;
        const double noise = which == 0 ? 30 : 1; // of a frame
        SeenCamera ratio;
        for (int k = 0; k < 60; k++)
        {
            CameraEvidence frame;
            frame.information(0, 0) = 1;
            frame.gradient[0] = 1 - truths[which] + rng.gaussian(noise);
            ratio.add(frame, CameraVector(), longest);
        }
        EXPECT_LE(std::abs(ratio.readoutRatio()), longest + 1e-9);
        EXPECT_LE(std::abs(ratio.readoutContradiction()), longest + 1e-9);
        contradictions[which] += ratio.readoutContradiction() != 1;
        beyond += ratio.readoutRatio() > longest - 1e-9;
    }
    EXPECT_EQ(0, contradictions[0]);
    EXPECT_GT(contradictions[1], 0.9 * trials);
    EXPECT_GT(beyond, 0.3 * trials);
}

}} // namespace opencv_test
