// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_drive_simulator.hpp"
#include "test_shaking_camera.hpp"
#include "../src/sequence/row_rates.hpp"
#include "../src/sequence/sequence_filter.hpp"
#include "opencv2/rsackermann/corrector.hpp"

#include <numeric>

// How fast a camera pitches and rolls at the instant of a frame, from its mean rates between frames (doc/theory.md,
// "Rates of rows").

namespace opencv_test { namespace {

using simulation::ShakingCamera;

const double INTERVAL = ShakingCamera::interval();

//! @param unit seconds per unit of row time.
RollingShutterCamera cameraOf(double unit)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.lineDelay = unit / camera.cameraMatrix(1, 1);
    return camera;
}

//! A tilt that swings, with the rates that a gyro would measure.
struct Swing
{
    simulation::Sway tilt;

    double mean(int frame) const { return (tilt(frame * INTERVAL) - tilt((frame - 1) * INTERVAL)) / INTERVAL; }
    double at(int frame) const
    {
        const double h = 1e-5;
        return (tilt(frame * INTERVAL + h) - tilt(frame * INTERVAL - h)) / (2 * h);
    }
};

// Root mean squares of what differs from the truth, and how often that is within two sigmas.
struct Errors
{
    double raw, ofMean, predicted, between; // of the rate, the last mean, without the next frame and with it
    int within, count;
};

// What the rows of points show beside the changes: independent errors, and what the scene always adds.
struct ShownChanges
{
    bool shown;
    double noise, bias;
};

Errors errorsOf(const Swing& swing, int frames, const ShownChanges& rows)
{
    Errors e = {0, 0, 0, 0, 0, 0};
    RNG rng(1);
    RateProcess process;
    const auto change = [&](int now, int other) {
        return rows.shown ? swing.at(now) - swing.at(other) + rows.bias + rng.gaussian(rows.noise) : 0;
    };
    for (int i = 1; i <= frames; i++)
    {
        process.add(InstantRate(swing.mean(i)), change(i, i - 1), INTERVAL);
        const InstantRate now = process.now(0), both = process.now(swing.mean(i + 1), change(i, i + 1), 0.5, 0);
        if (i < frames / 4)
            continue;
        const double truth = swing.at(i);
        e.raw += truth * truth;
        e.ofMean += std::pow(swing.mean(i) - truth, 2);
        e.predicted += std::pow(now.value - truth, 2);
        e.between += std::pow(both.value - truth, 2);
        e.within += (std::abs(now.value - truth) < 2 * now.sigma) + (std::abs(both.value - truth) < 2 * both.sigma);
        e.count++;
    }
    for (double* sum : {&e.raw, &e.ofMean, &e.predicted, &e.between})
        *sum = std::sqrt(*sum / e.count);
    return e;
}

// Where shaking begins the means before let expect nothing.
TEST(RSAckermann_RateProcess, begins_with_the_last_mean)
{
    for (const double first : {4., -8.})
    {
        RNG rng(4);
        RateProcess process;
        for (int i = 0; i < 6; i++)
            process.add(InstantRate(rng.gaussian(0.01), 0.01), rng.gaussian(0.01), 0.1);
        process.add(InstantRate(first, 0.01), 0, 0.1);
        const InstantRate now = process.now(0.1);
        EXPECT_GT(now.value / first, 0.3);
        EXPECT_LT(now.value / first, 1.2);
        EXPECT_LT(std::abs(now.value - first), 3 * now.sigma);
    }
}

// A rate that grows evenly: one that wanders has to grow by sqrt(2) of that for means that differ as much.
TEST(RSAckermann_RateProcess, learns_how_it_grows)
{
    const double usual = 0.05, growth = 0.4, noise = 1e-4;
    RateProcess rate;
    rate.expectChange(1e-6, INTERVAL);
    EXPECT_NEAR(usual, rate.expectedGrowth(INTERVAL, usual), 1e-12);
    const int frames = 200;
    for (int i = 0; i < frames; i++)
        rate.add(InstantRate(growth * i * INTERVAL, noise), 0, INTERVAL);
    EXPECT_NEAR(std::sqrt(2.) * growth, rate.expectedGrowth(INTERVAL, usual), 0.03 * growth);
    EXPECT_NEAR(rate.expectedGrowth(INTERVAL, usual), rate.expectedGrowth(-INTERVAL, usual), 1e-12);
}

// By how much a level car seems to pitch and roll between frames, radians, root mean square.
double turnsOfLevelCar(double yawRate, bool learns)
{
    const RollingShutterCamera camera = cameraOf(0.03);
    const AckermannEstimator::Params params;
    simulation::StreetDrive::Options options;
    options.yawRate = yawRate;
    options.tilt = 0;
    simulation::StreetDrive street(camera, 0, 0, options, 3);
    SequenceFilter filter(camera, params);
    RowRates rates(RowRates::usualSteering(params));
    FrameFeatures features;
    const int frames = 100, first = 10;
    const double interval = 0.1;
    double squares = 0;
    for (int i = 0; i < frames; i++)
    {
        const simulation::StreetDrive::Frame frame = street.frame(i * interval, interval);
        std::vector<PointPair> pairs;
        for (int k = 0; k < frame.points.rows; k++)
        {
            const double* p = frame.points.ptr<double>(k);
            pairs.push_back(PointPair{Point2d(p[0], p[1]), Point2d(p[2], p[3])});
        }
        features.setPoints(camera, pairs, interval);
        selectCandidates(frame.segments, camera, params, features.verticals, features.others);
        filter.advance(frame.seconds, camera, params);
        FitNuisances nuisances;
        if (learns)
            rates.expectChanges(interval, nuisances);
        SequenceFit fit(filter.state);
        EXPECT_TRUE(filter.update(features, camera, params, fit, nuisances)) << i;
        rates.update(fit, interval, 0, camera.lineDelay * camera.imageSize.height);
        if (i >= first)
            squares += std::pow(fit.values[FLOW_PITCH_BEFORE], 2) + std::pow(fit.values[FLOW_ROLL_BEFORE], 2);
    }
    return std::sqrt(squares / (frames - first));
}

// A yaw rate that grows isn't a turn about another axis.
TEST(RSAckermann_RowRates, in_bends)
{
    const double bends = turnsOfLevelCar(40 * degree, true), unlearned = turnsOfLevelCar(40 * degree, false);
    RecordProperty("bends", std::to_string(bends));
    RecordProperty("unlearned", std::to_string(unlearned));
    EXPECT_LT(bends, 0.7 * unlearned);
}

// A suspension, and an arm of 5 Hz: with the next frame better than without, without better than the last mean, and
// better still if the rows show changes, whatever the scene adds to all of them.
TEST(RSAckermann_RowRates, of_oscillations)
{
    RNG rng(5);
    for (int k = 0; k < 6; k++)
    {
        SCOPED_TRACE(k);
        const simulation::Oscillation fast(0.002, 0.15, 0.25, rng);
        const Swing swing = {k % 2 ? simulation::Sway([fast](double seconds) { return fast.at(seconds); })
                                   : simulation::onSprings(0.004, rng)};
        const ShownChanges none = {false, 0, 0}, exact = {true, 0, 0.1};
        const Errors e = errorsOf(swing, 200, none), ofRows = errorsOf(swing, 200, exact);
        EXPECT_LT(e.predicted, 0.8 * e.ofMean);
        EXPECT_LT(e.between, e.predicted);
        EXPECT_LT(e.between, 0.25 * e.raw);
        EXPECT_LT(ofRows.predicted, e.predicted);
        EXPECT_LT(ofRows.between, e.between);
        for (const Errors& errors : {e, ofRows})
            EXPECT_GE(errors.within, 0.9 * 2 * errors.count);
        // What shows next to nothing hardly counts.
        const ShownChanges noise = {true, 20 * e.ofMean, 0};
        const Errors ofNoise = errorsOf(swing, 200, noise);
        EXPECT_LT(ofNoise.predicted, 1.1 * e.predicted);
        EXPECT_LT(ofNoise.between, 1.5 * e.between);
        EXPECT_GE(ofNoise.within, 0.9 * 2 * ofNoise.count);
    }
}

//! A rate that wanders, read for a part of the interval, and the errors of its means.
class RSAckermann_WanderingRate : public testing::TestWithParam<std::tuple<bool, double, double>>
{
};

// Of one that is known at both ends of an interval the mean tells by how much less it is uncertain.
TEST_P(RSAckermann_WanderingRate, has_a_true_sigma)
{
    const bool isShown = std::get<0>(GetParam());
    const double read = std::get<1>(GetParam()), noise = std::get<2>(GetParam());
    RNG rng(6);
    const int steps = 20, frames = 1500, half = cvRound(read * steps);
    std::vector<double> rate(1, 0.), means(1, 0.), rows(1, 0.);
    for (int i = 0; i < steps * (frames + 2); i++)
        rate.push_back(rate.back() + rng.gaussian(0.01));
    const auto mean = [&](int from, int to) { return std::accumulate(&rate[from], &rate[to], 0.) / (to - from); };
    for (int k = 1; k <= frames + 1; k++)
    {
        means.push_back(mean((k - 1) * steps, k * steps) + rng.gaussian(noise));
        rows.push_back(half > 0 ? mean(k * steps - half, k * steps + half) : rate[k * steps]);
    }
    RateProcess process;
    int within[2][2] = {{0, 0}, {0, 0}}, count = 0;
    for (int k = 1; k <= frames; k++)
    {
        const double before = isShown ? rows[k] - rows[k - 1] : 0, after = isShown ? rows[k] - rows[k + 1] : 0;
        process.add(InstantRate(means[k], noise), before, INTERVAL);
        if (k < 200)
            continue;
        const InstantRate rates[] = {process.now(read), process.now(means[k + 1], after, 0.5, read)};
        for (int i = 0; i < 2; i++)
            for (int n = 0; n < 2; n++)
                within[i][n] += std::abs(rates[i].value - rows[k]) < (n + 1) * rates[i].sigma;
        count++;
    }
    const double change = 0.01 * std::sqrt(double(steps));
    EXPECT_NEAR(change, process.expectedChange(INTERVAL, 1), (noise > 0 ? 0.3 : 0.1) * change);
    for (int i = 0; i < 2; i++)
        for (int n = 0; n < 2; n++)
        {
            const double expected = n == 0 ? 0.73 : 0.965, tolerance = n == 0 ? 0.12 : 0.025;
            EXPECT_GT(within[i][n] / double(count), expected - tolerance) << i << n;
            // Means hardly confirm what rows show: cautious.
            const bool isExact = !isShown || half == 0;
            EXPECT_LT(within[i][n] / double(count), isExact ? expected + tolerance : 1.1) << i << n;
        }
}

INSTANTIATE_TEST_CASE_P(, RSAckermann_WanderingRate,
                        testing::Combine(testing::Bool(), testing::Values(0, 0.25, 0.5), testing::Values(0, 0.03)));

// The mean over a gap says little of the instant after it: how little, a suspension, an arm, and a car that weaves
// show.
TEST(RSAckermann_RateProcess, is_uncertain_after_missing_frames)
{
    RNG rng(12);
    for (int k = 0; k < 3; k++)
        for (const int gap : {2, 4, 9})
        {
            SCOPED_TRACE(cv::format("%d %d", k, gap));
            double error = 0, variance = 0, ofNext = 0, varianceOfNext = 0;
            for (int n = 0; n < 60; n++)
            {
                const simulation::Oscillation fast(0.002, 0.15, 0.25, rng);
                const double phase = rng.uniform(0., 2 * CV_PI);
                const auto weave = [phase](double seconds) { return 0.1 * std::sin(CV_PI / 2 * seconds + phase); };
                const Swing swing = {k == 0   ? simulation::onSprings(0.004, rng)
                                     : k == 1 ? simulation::Sway([fast](double seconds) { return fast.at(seconds); })
                                              : simulation::Sway(weave)};
                RateProcess process;
                const int last = 40;
                for (int i = 1; i <= last; i++)
                    process.add(InstantRate(swing.mean(i)), 0, INTERVAL);
                double mean = 0;
                for (int i = 1; i <= gap; i++)
                    mean += swing.mean(last + i) / gap;
                process.add(InstantRate(mean), 0, gap * INTERVAL);
                const InstantRate now = process.now(0);
                error += std::pow(now.value - swing.at(last + gap), 2);
                variance += now.sigma * now.sigma;
                // Of the next frame it is what it would be without.
                process.add(InstantRate(swing.mean(last + gap + 1)), 0, INTERVAL);
                const InstantRate next = process.now(0);
                ofNext += std::pow(next.value - swing.at(last + gap + 1), 2);
                varianceOfNext += next.sigma * next.sigma;
            }
            EXPECT_LT(error, 4 * variance);
            EXPECT_LT(variance, 4 * error);
            EXPECT_LT(ofNext, 1.5 * varianceOfNext);
        }
}

// What can't be predicted isn't applied in full: half of the last mean is on average as good as can be.
TEST(RSAckermann_RowRates, of_noise)
{
    RNG rng(8);
    RateProcess process;
    double applied = 0, last = 0;
    for (int i = 0; i < 400; i++)
    {
        const double rate = rng.gaussian(1);
        process.add(InstantRate(rate), rng.gaussian(1), INTERVAL);
        if (i < 100)
            continue;
        applied += std::pow(process.now(0).value, 2);
        last += rate * rate;
    }
    EXPECT_NEAR(0.25, applied / last, 0.05);
}

// A rate that nothing predicts: rows show how it has changed, and a bias of theirs doesn't count.
TEST(RSAckermann_RowRates, of_jolts_that_rows_show)
{
    RNG rng(9);
    RateProcess process, ofRows;
    const double bias = 0.5;
    double before = 0, error = 0, errorOfRows = 0;
    for (int i = 0; i < 400; i++)
    {
        const double rate = rng.gaussian(1), mean = (rate + before) / 2;
        process.add(InstantRate(mean), 0, INTERVAL);
        ofRows.add(InstantRate(mean), rate - before + bias, INTERVAL);
        before = rate;
        if (i < 20)
            continue;
        error += std::pow(process.now(0).value - rate, 2);
        errorOfRows += std::pow(ofRows.now(0).value - rate, 2);
    }
    EXPECT_LT(errorOfRows, 0.75 * error);
}

TEST(RSAckermann_RowRates, nothing_is_known_at_first)
{
    RateProcess process;
    EXPECT_EQ(0, process.now(0).value);
    EXPECT_EQ(0, process.now(0).sigma);
    EXPECT_EQ(0, process.now(1, 0, 0.5, 0).value);
    EXPECT_EQ(2, process.expectedChange(INTERVAL, 2));
    process.add(InstantRate(0.3), 0, INTERVAL);
    EXPECT_EQ(0, process.now(0).value); // how much it changes isn't known
    EXPECT_NEAR(0.4, process.now(0.5, 0, 0.5, 0).value, 1e-15);
    EXPECT_NEAR(0.35, process.now(0.5, 0, 0.25, 0).value, 1e-15);
    EXPECT_GT(process.now(0.5, 0, 0.5, 0).sigma, 0);
    // At rest, and after it
    for (int i = 0; i < 5; i++)
        process.add(InstantRate(), 0, INTERVAL);
    EXPECT_EQ(0, process.now(0).value);
    EXPECT_TRUE(std::isfinite(process.now(0).sigma));
    process.interrupt();
    EXPECT_EQ(0, process.now(0).value);
}

//! One whose state is known exactly.
SequenceFit exactFit()
{
    SequenceFit fit{SequenceState(simulation::paperCamera(), AckermannEstimator::Params())};
    fit.state.covariance = fit.state.covariance.zeros();
    return fit;
}

double yawSigmaOf(const RowRates& rates)
{
    SequenceState state = exactFit().state;
    rates.toInstant(MotionPrior(), state);
    return std::sqrt(state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE));
}

SequenceFit turnsToNextFrame(double pitch, double roll)
{
    SequenceFit fit = exactFit();
    fit.after.pitch.angle = pitch;
    fit.after.roll.angle = roll;
    return fit;
}

// The yaw rate of the first frame is that of the whole interval to the next one: by how much the instant's may differ
// is told by the other axes. With a variance of two squares, 82 % are within two sigmas (Student's t).
TEST(RSAckermann_RowRates, of_a_first_frame)
{
    RNG rng(3);
    int within = 0;
    const int count = 400;
    for (int k = 0; k < count; k++)
    {
        const simulation::Oscillation pitch(0.002, 0.15, 0.25, rng), roll(0.002, 0.15, 0.25, rng),
            yaw(0.002, 0.15, 0.25, rng);
        const Swing swing = {[&](double seconds) { return yaw.at(seconds); }};
        RowRates rates;
        rates.begin(turnsToNextFrame(pitch.at(INTERVAL) - pitch.at(0), roll.at(INTERVAL) - roll.at(0)), INTERVAL, 0);
        within += std::abs(swing.mean(1) - swing.at(0)) < 2 * yawSigmaOf(rates);
    }
    EXPECT_GE(within, 0.82 * count);
}

// Of pitch and roll the first frames know what the first turns let expect.
TEST(RSAckermann_RowRates, of_the_first_frames)
{
    RNG rng(9);
    const int count = 400, frames = 4;
    int within[frames] = {};
    double left[frames] = {}, raw = 0, sigmas = 0;
    for (int k = 0; k < count; k++)
    {
        const simulation::Oscillation pitch(0.002, 0.15, 0.25, rng), roll(0.002, 0.15, 0.25, rng);
        const Swing swing = {[&](double seconds) { return pitch.at(seconds); }};
        const auto fitOf = [&](int frame) { // turns are counted from a frame to one that was taken later
            SequenceFit fit = exactFit();
            const double now = frame * INTERVAL;
            fit.before.pitch.angle = pitch.at(now) - pitch.at(now - INTERVAL);
            fit.before.roll.angle = roll.at(now) - roll.at(now - INTERVAL);
            fit.after.pitch.angle = pitch.at(now + INTERVAL) - pitch.at(now);
            fit.after.roll.angle = roll.at(now + INTERVAL) - roll.at(now);
            return fit;
        };
        RowRates rates;
        for (int i = 0; i < frames; i++)
        {
            if (i == 0)
                rates.begin(fitOf(0), INTERVAL, 0);
            else
                rates.update(fitOf(i), INTERVAL, 0, 0);
            AckermannMotion motion;
            rates.toMotion(cameraOf(1), motion);
            const double error = motion.pitchRate - swing.at(i);
            within[i] += std::abs(error) < 2 * motion.pitchRateSigma;
            sigmas += i == 0 ? std::pow(motion.pitchRateSigma, 2) : 0;
            EXPECT_GT(motion.rollRateSigma, 0);
            left[i] += error * error;
        }
        raw += std::pow(swing.at(0), 2);
    }
    EXPECT_LT(sigmas, 3 * std::exp(1.5) * raw);
    for (int i = 0; i < frames; i++)
    {
        EXPECT_GE(within[i], 0.93 * count) << i;
        EXPECT_LE(left[i], i == 0 ? raw : 0.55 * raw) << i;
    }
}

// Where a camera shakes too fast for the means of few turns to show it, rows do.
TEST(RSAckermann_RowRates, of_first_frames_that_shake_fast)
{
    RNG rng(10);
    const int count = 400;
    int yaws[2] = {}, pitches[2] = {}; // within two sigmas
    for (int k = 0; k < count; k++)
    {
        const simulation::Oscillation angles[3] = {simulation::Oscillation(0.002, 0.08, 0.12, rng),
                                                   simulation::Oscillation(0.002, 0.08, 0.12, rng),
                                                   simulation::Oscillation(0.002, 0.08, 0.12, rng)};
        const Swing yaw = {[&](double seconds) { return angles[0].at(seconds); }},
                    pitch = {[&](double seconds) { return angles[1].at(seconds); }},
                    roll = {[&](double seconds) { return angles[2].at(seconds); }};
        RowRates rates;
        for (int i = 0; i < 2; i++)
        {
            SequenceFit fit = exactFit();
            NeighbourTurns& turns = i == 0 ? fit.after : fit.before;
            turns.pitch.angle = INTERVAL * pitch.mean(1);
            turns.roll.angle = INTERVAL * roll.mean(1);
            turns.yaw.change = yaw.at(i) - yaw.at(1 - i);
            turns.pitch.change = pitch.at(i) - pitch.at(1 - i);
            if (i == 0)
                rates.begin(fit, INTERVAL, 0);
            else
                rates.update(fit, INTERVAL, 0, 0);
            AckermannMotion motion;
            rates.toMotion(cameraOf(1), motion);
            yaws[i] += std::abs(yaw.mean(1) - yaw.at(i)) < 2 * yawSigmaOf(rates);
            pitches[i] += std::abs(motion.pitchRate - pitch.at(i)) < 2 * motion.pitchRateSigma;
        }
    }
    for (int i = 0; i < 2; i++)
    {
        EXPECT_GE(yaws[i], 0.93 * count) << i;
        EXPECT_GE(pitches[i], 0.93 * count) << i;
    }
}

// What means don't confirm was of the scene.
TEST(RSAckermann_RowRates, changes_that_are_not_confirmed)
{
    SequenceFit fit = exactFit();
    RowRates rates;
    double sigma[100] = {};
    for (int i = 0; i < 100; i++)
    {
        const double sign = i % 2 ? 1 : -1;
        fit.before.pitch.angle = 1e-4 * ((i / 2) % 2 ? 1 : -1);
        fit.before.pitch.change = sign;
        rates.update(fit, INTERVAL, 0, 0);
        AckermannMotion motion;
        rates.toMotion(cameraOf(1), motion);
        sigma[i] = motion.pitchRateSigma;
    }
    EXPECT_NEAR(0.4, sigma[0], 0.01); // a half, without a fifth that may be their mean
    EXPECT_LT(sigma[99], 0.05);
}

// Errors that all means have, as of one house that is farther away than others, don't scatter.
TEST(RSAckermann_RowRates, errors_that_means_share)
{
    const double sigma = 1e-3;
    for (const double after : {0., INTERVAL})
    {
        SequenceFit fit = exactFit();
        for (RowTurn* turn : {&fit.before.pitch, &fit.after.pitch})
        {
            turn->angle = turn == &fit.before.pitch ? 1e-3 : -1e-3;
            turn->sigma = sigma;
        }
        RowRates rates;
        for (int i = 0; i < 20; i++)
            rates.update(fit, INTERVAL, after, 0);
        AckermannMotion motion;
        rates.toMotion(cameraOf(1), motion);
        // Half of the last mean is that of the next one, or what is predicted, of which nothing is known to be wrong.
        EXPECT_NEAR(std::sqrt(after > 0 ? 0.5 : 0.25) * sigma / INTERVAL, motion.pitchRateSigma,
                    0.05 * sigma / INTERVAL);
    }
}

// Shaking is alike about all axes: half of the mean square by which neighbouring means differ is about the last one.
TEST(RSAckermann_RowRates, first_yaw_rates_shake_as_about_other_axes)
{
    SequenceFit fit = exactFit();
    fit.before.pitch.angle = 0.003;
    fit.before.roll.angle = -0.004;
    RowRates rates;
    rates.update(fit, INTERVAL, 0, 0);
    EXPECT_NEAR(0.005 / INTERVAL * std::sqrt(0.5), rates.aboutFit(INTERVAL, 0, 0).yawRate, 1e-9);
}

TEST(RSAckermann_RowRates, first_changes_are_as_large_as_other_rates)
{
    for (double interval : {0.1, -0.1})
    {
        RowRates rates;
        rates.begin(turnsToNextFrame(0.03, -0.04), interval, 0);
        EXPECT_NEAR(0.5 / std::sqrt(2.), yawSigmaOf(rates), 1e-12);
        FitNuisances nuisances;
        rates.expectChanges(interval, nuisances);
        EXPECT_NEAR(0.5 * std::sqrt(1.5), nuisances.pitchChange, 1e-12);
        EXPECT_NEAR(0.5 * std::sqrt(1.5), nuisances.rollChange, 1e-12);
        // The next frame knows no change yet; then those that are seen count as well.
        SequenceFit fit = turnsToNextFrame(0, 0);
        rates.update(fit, interval, 0, 0);
        EXPECT_NEAR(0.5 / std::sqrt(2.), yawSigmaOf(rates), 1e-12);
        for (int i = 0; i < 9; i++)
            rates.update(fit, interval, 0, 0);
        EXPECT_NEAR(0.5 / std::sqrt(20.), yawSigmaOf(rates), 0.01);
        // Those that are known aren't forgotten where the camera begins anew.
        rates.begin(turnsToNextFrame(3, 4), interval, 0);
        EXPECT_NEAR(0.5 / std::sqrt(20.), yawSigmaOf(rates), 0.01);
    }
}

// A recording that is played backward has the same rates.
TEST(RSAckermann_RowRates, forward_and_backward)
{
    SequenceFit fit{SequenceState(simulation::paperCamera(), AckermannEstimator::Params())};
    fit.before.pitch.angle = 0.01;
    fit.after.pitch.angle = -0.03; // counted from the later frame
    fit.before.roll.angle = -0.02;
    fit.after.roll.angle = 0.04;
    RowRates forward, backward;
    forward.update(fit, 0.1, 0.2, 0);
    backward.update(fit, -0.2, -0.1, 0);
    AckermannMotion a, b;
    forward.toMotion(cameraOf(0.03), a);
    backward.toMotion(cameraOf(0.03), b);
    // Means of 0.1 and 0.15; the instant is a third of the way from one middle to the other.
    EXPECT_NEAR((0.1 + 0.05 / 3) * 0.03, a.pitchRate, 1e-12);
    EXPECT_NEAR(-0.2 * 0.03, a.rollRate, 1e-12);
    EXPECT_NEAR(a.pitchRate, b.pitchRate, 1e-12);
    EXPECT_NEAR(a.rollRate, b.rollRate, 1e-12);
    EXPECT_GT(a.pitchRateSigma, 0);
    forward.interrupt();
    forward.toMotion(cameraOf(0.03), a);
    EXPECT_EQ(0, a.pitchRate);
    EXPECT_EQ(0, a.rollRateSigma);
}

// Rates about all axes that grow evenly, by turns to both neighbours: rows turn as they do, in either order of frames.
// Without one of the neighbours, nothing is known of it.
TEST(RSAckermann_RowRates, that_grow)
{
    const double past = 0.03, future = 0.05;
    const Vec3d rate(0.2, -0.1, 0.05), growth(3, 2, -1); // about x, y and z
    for (const ScanDirection scan : {SCAN_TOP_TO_BOTTOM, SCAN_BOTTOM_TO_TOP})
    {
        RollingShutterCamera camera = cameraOf(0.03);
        camera.scanDirection = scan;
        camera.referenceRow = 100;
        const double unit = camera.secondsPerUnitTime();
        SequenceFit fit{SequenceState(camera, AckermannEstimator::Params())};
        // A mean, and a change that is too small
        fit.values[SEQUENCE_YAW_RATE] = rate[1];
        fit.values[FLOW_YAW_CHANGE] = growth[1] / 3;
        for (NeighbourTurns* turns : {&fit.before, &fit.after})
        {
            const double interval = turns == &fit.before ? past : -future; // to the present
            const Vec3d turned = rate * interval - growth * (interval * interval / 2);
            turns->pitch.angle = -turned[0];
            turns->roll.angle = turned[2];
            turns->yaw.angle = turned[1] - rate[1] * interval + growth[1] / 3 * interval * interval / 2;
        }
        for (const bool isForward : {true, false})
        {
            RowRates rates;
            if (isForward)
                rates.update(fit, past, future, 0);
            else
                rates.update(fit, -future, -past, 0);
            AckermannMotion motion;
            rates.toMotion(camera, motion);
            ASSERT_FALSE(motion.rotationCurve.empty());
            const auto curve = rotationCurveOf(camera, motion);
            const double last = camera.rowTime(Point2d(0, camera.imageSize.height - 1.)) * unit,
                         most = cv::norm(growth) * last * last / 2;
            for (int row = 0; row < camera.imageSize.height; row += 10)
            {
                const double time = camera.rowTime(Point2d(0, row)) * unit;
                EXPECT_LT(cv::norm(curve(time / unit) - growth * (time * time / 2)), 0.01 * most) << row << isForward;
            }
            if (isForward)
                rates.update(fit, past, 0, 0);
            else
                rates.begin(fit, future, 0);
            rates.toMotion(camera, motion);
            EXPECT_TRUE(motion.rotationCurve.empty());
        }
    }
}

// The same with what rows show, with the next frame and without it.
TEST(RSAckermann_RowRates, shown_forward_and_backward)
{
    const SequenceState state(simulation::paperCamera(), AckermannEstimator::Params());
    for (const double next : {0., 1.5 * INTERVAL})
    {
        RNG rng(4);
        RowRates forward, backward, without;
        double distance = 0, last = 0, errorOfYaw = 0, errorOfMeans = 0;
        for (int i = 0; i < 60; i++)
        {
            SequenceFit before(state), after(state);
            const double rate = rng.gaussian(0.1), mean = (rate + last) / 2, change = rate - last,
                         nextRate = rng.gaussian(0.1), nextMean = (rate + nextRate) / 2;
            last = rate;
            before.before.pitch.angle = mean * INTERVAL;
            before.before.pitch.change = after.after.pitch.change = change;
            after.after.pitch.angle = -mean * INTERVAL;
            before.after.pitch.angle = -nextMean * next;
            before.after.pitch.change = after.before.pitch.change = rate - nextRate;
            after.before.pitch.angle = nextMean * next;
            // The same of yaw, of which the state has the mean.
            const double yaw = next > 0 ? mean + (nextMean - mean) / 2.5 : mean, turned = mean - yaw;
            before.values[SEQUENCE_YAW_RATE] = after.values[SEQUENCE_YAW_RATE] = yaw;
            before.before.yaw.angle = turned * INTERVAL;
            after.after.yaw.angle = -turned * INTERVAL;
            before.before.yaw.change = after.after.yaw.change = change;
            before.after.yaw.change = after.before.yaw.change = rate - nextRate;
            SequenceFit still = before;
            for (NeighbourTurns* turns : {&still.before, &still.after})
                turns->yaw.change = turns->pitch.change = turns->roll.change = 0;
            forward.update(before, INTERVAL, next, 0);
            backward.update(after, -INTERVAL, -next, 0);
            without.update(still, INTERVAL, next, 0);
            AckermannMotion a, b, c;
            forward.toMotion(cameraOf(1), a);
            backward.toMotion(cameraOf(1), b);
            without.toMotion(cameraOf(1), c);
            EXPECT_NEAR(a.pitchRate, b.pitchRate, 1e-12) << i;
            EXPECT_NEAR(a.pitchRateSigma, b.pitchRateSigma, 1e-12) << i;
            distance = std::max(distance, std::abs(a.pitchRate - c.pitchRate));
            SequenceState ofForward(state), ofBackward(state);
            ofForward.value[SEQUENCE_YAW_RATE] = ofBackward.value[SEQUENCE_YAW_RATE] = yaw;
            forward.toInstant(MotionPrior(), ofForward);
            backward.toInstant(MotionPrior(), ofBackward);
            EXPECT_NEAR(ofForward.value[SEQUENCE_YAW_RATE], ofBackward.value[SEQUENCE_YAW_RATE], 1e-12) << i;
            errorOfYaw += std::pow(ofForward.value[SEQUENCE_YAW_RATE] - rate, 2);
            errorOfMeans += std::pow(yaw - rate, 2);
        }
        EXPECT_GT(distance, 0.005) << next;
        EXPECT_LT(errorOfYaw, 0.8 * errorOfMeans) << next;
    }
}

// What a gyro has measured in one frame is nothing to the next one, whether that shows turns or not.
TEST(RSAckermann_RowRates, of_a_gyro_are_those_of_its_frame)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const SequenceState state(camera, AckermannEstimator::Params());
    SequenceFit fit(state);
    MeasuredTurns measured;
    measured.pitch.value = measured.roll.value = measured.yaw.value = 0.3;
    measured.pitch.sigma = measured.roll.sigma = measured.yaw.sigma = 0.01;
    measured.curve = Mat(4, 3, CV_64F, Scalar(0.01));
    for (const bool isSeen : {false, true})
    {
        RowRates used, unused;
        used.set(measured);
        for (RowRates* const rates : {&used, &unused})
            if (isSeen)
                rates->update(fit, 0.1, 0.1, 0);
            else
                rates->interrupt();
        AckermannMotion a, b;
        SequenceState c = state, d = state;
        used.toMotion(cameraOf(0.03), a);
        unused.toMotion(cameraOf(0.03), b);
        expectSame(a, b);
        used.toInstant(MotionPrior(), c);
        unused.toInstant(MotionPrior(), d);
        EXPECT_EQ(d.value, c.value);
        EXPECT_EQ(d.covariance, c.covariance);
    }
}

// They replace the yaw rate of the frame, as well as it is known then, but not what it has to do with other values.
TEST(RSAckermann_RowRates, of_a_gyro_in_the_state)
{
    SequenceState state(simulation::paperCamera(), AckermannEstimator::Params());
    for (int i = 0; i < SEQUENCE_VALUES; i++)
        for (int j = 0; j < i; j++)
            state.covariance(i, j) = state.covariance(j, i) =
                (i + j) % 3 * 0.3 * std::sqrt(state.covariance(i, i) * state.covariance(j, j));
    const SequenceState before = state;
    MeasuredTurns measured;
    measured.yaw.value = 0.3;
    measured.yaw.sigma = 0.01;
    RowRates rates;
    rates.set(measured);
    rates.toInstant(MotionPrior(), state);
    EXPECT_EQ(0.3, state.value[SEQUENCE_YAW_RATE]);
    EXPECT_NEAR(0.01, std::sqrt(state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE)), 1e-9);
    const auto correlation = [](const SequenceState& s, int i, int j) {
        return s.covariance(i, j) / std::sqrt(s.covariance(i, i) * s.covariance(j, j));
    };
    for (int i = 0; i < SEQUENCE_VALUES; i++)
        for (int j = 0; j < SEQUENCE_VALUES; j++)
            EXPECT_NEAR(correlation(before, i, j), correlation(state, i, j), 1e-9) << i << " " << j;
    SequenceVector others = state.value;
    others[SEQUENCE_YAW_RATE] = before.value[SEQUENCE_YAW_RATE];
    EXPECT_EQ(before.value, others);
}

// The variance of a yaw rate is that of its means between frames, half of it between two neighbours; less if the rows
// are read for a part of the interval, and what the means' errors explain isn't counted twice.
TEST(RSAckermann_RowRates, of_a_yaw_rate_that_changes)
{
    for (const double before : {0.1, -0.1})
        for (const double after : {0., before})
            for (const double read : {0., 0.5})
                for (const double error : {0., 0.04, 1.})
                {
                    RowRates rates;
                    SequenceFit fit = exactFit();
                    fit.before.yaw.sigma = fit.after.yaw.sigma = error * std::abs(before);
                    fit.values[SEQUENCE_YAW_RATE] = 0.1;
                    fit.values[FLOW_YAW_CHANGE] = 0;
                    rates.update(fit, before, after, 0.2 * read);
                    fit.values[SEQUENCE_YAW_RATE] = 0.2;
                    fit.values[FLOW_YAW_CHANGE] = before > 0 ? 0.8 : -0.8;
                    rates.update(fit, before, after, 0.2 * read);
                    const double change = 0.16 - 0.1, // of the means
                        square = std::max(change * change - 2 * error * error, 0.),
                                 share = after != 0 ? (read > 0 ? 1. / 16 : 1. / 4) : (read > 0 ? 5. / 16 : 1. / 2);
                    EXPECT_NEAR(share * square, std::pow(yawSigmaOf(rates), 2), 1e-12) << read << error;
                }
}

// Of points, which show the mean, and of a rate of the instant: as if both had been measured at once.
TEST(RSAckermann_RowRates, of_a_given_yaw_rate)
{
    const double ofPoints = 0.2, pointsSigma = 0.01, beyond = 0.06 / std::sqrt(2.);
    for (const double sigma : {0.005, 0.03, 0.2})
    {
        RowRates rates;
        SequenceFit fit = exactFit();
        fit.values[SEQUENCE_YAW_RATE] = 0.1;
        rates.update(fit, 0.1, 0, 0);
        fit.values[SEQUENCE_YAW_RATE] = 0.16;
        rates.update(fit, 0.1, 0, 0);
        EXPECT_NEAR(beyond, rates.aboutFit(0.1, 0, 0).yawRate, 1e-12);
        MotionPrior given;
        given.yawRate = 0.1;
        given.yawRateSigma = sigma;
        SequenceState state = fit.state;
        state.value[SEQUENCE_YAW_RATE] = ofPoints;
        state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE) = pointsSigma * pointsSigma;
        state.covariance(SEQUENCE_SPEED, SEQUENCE_SPEED) = 1;
        state.covariance(SEQUENCE_SPEED, SEQUENCE_YAW_RATE) = state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_SPEED) =
            0.5 * pointsSigma;
        state.measure(SEQUENCE_YAW_RATE, given.yawRate, std::hypot(sigma, beyond));
        rates.toInstant(given, state);
        const double a = pointsSigma * pointsSigma + beyond * beyond, b = sigma * sigma;
        EXPECT_NEAR((ofPoints * b + given.yawRate * a) / (a + b), state.value[SEQUENCE_YAW_RATE], 1e-9) << sigma;
        EXPECT_NEAR(a * b / (a + b), state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE), 1e-9) << sigma;
        EXPECT_NEAR(0.5 * pointsSigma * b / (a + b), state.covariance(SEQUENCE_SPEED, SEQUENCE_YAW_RATE), 1e-9)
            << sigma;
    }
}

// Points show the mean since the frame before, which a car that brakes exceeds by half of the change.
TEST(RSAckermann_RowRates, of_a_speed_that_changes)
{
    const double change = 0.6;
    RowRates rates;
    SequenceFit fit = exactFit();
    fit.state.covariance(SEQUENCE_SPEED, SEQUENCE_SPEED) = 0;
    for (int i = 0; i < 10; i++)
    {
        fit.values[SEQUENCE_SPEED] = 10 - change * i;
        rates.update(fit, 0.5, 0, 0);
        EXPECT_NEAR(i > 0 ? change / std::sqrt(2.) : 0, rates.aboutFit(0.5, 0, 0).speed, 1e-9);
        EXPECT_EQ(0, rates.aboutFit(0.5, 0.5, 0).speed);
        SequenceState state = fit.state;
        rates.toInstant(MotionPrior(), state);
        EXPECT_EQ(fit.state.value[SEQUENCE_SPEED], state.value[SEQUENCE_SPEED]);
        EXPECT_NEAR(i > 0 ? change * change / 2 : 0, state.covariance(SEQUENCE_SPEED, SEQUENCE_SPEED), 1e-9);
    }
}

// Until frames show it cars steer as usual: over longer intervals the instant may differ more from the mean.
TEST(RSAckermann_RowRates, of_a_car_that_steers_as_usual)
{
    const AckermannEstimator::Params params;
    const RowRates rates(RowRates::usualSteering(params));
    const SequenceState stationary(simulation::paperCamera(), params);
    for (const double interval : {0.03, 0.1, -0.1})
    {
        // Of the process of the state, with a third of its sigma: its mean over an interval has a third of the
        // variance.
        SequenceState state = stationary;
        for (int i = 0; i < SEQUENCE_VALUES; i++)
            state.covariance(i, i) = 0;
        state.predict(std::abs(interval));
        const double increment = std::sqrt(state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE)) / 3;
        EXPECT_NEAR(increment / std::sqrt(3.), rates.aboutFit(interval, 0, 0).yawRate, 0.03 * increment) << interval;
        EXPECT_NEAR(increment / std::sqrt(6.), rates.aboutFit(interval, interval, 0).yawRate, 0.03 * increment)
            << interval;
    }
}

// Whatever a frame has shown: one after it without turns has no rates, and nothing is added to its yaw rate.
TEST(RSAckermann_RowRates, interrupted)
{
    const SequenceState state(simulation::paperCamera(), AckermannEstimator::Params());
    const auto fitWith = [&](double yawRate, double angle) {
        SequenceFit fit(state);
        fit.values[SEQUENCE_YAW_RATE] = yawRate;
        for (NeighbourTurns* turns : {&fit.before, &fit.after})
            for (RowTurn* turn : {&turns->yaw, &turns->pitch, &turns->roll})
                turn->angle = turn->change = angle;
        return fit;
    };
    const std::function<void(RowRates&)> frames[] = {[&](RowRates& r) { r.update(fitWith(0.2, 0.02), 0.1, 0, 0); },
                                                     [&](RowRates& r) { r.update(fitWith(0.2, 0.02), 0.1, 0.1, 0); },
                                                     [&](RowRates& r) { r.update(fitWith(0.2, 0.02), -0.1, -0.1, 0); },
                                                     [&](RowRates& r) { r.begin(fitWith(0.2, 0.02), 0.1, 0); }};
    for (const auto& frame : frames)
    {
        RowRates rates;
        rates.update(fitWith(0.1, 0.01), 0.1, 0, 0);
        frame(rates);
        EXPECT_GT(yawSigmaOf(rates), 0);
        rates.interrupt();
        AckermannMotion none;
        rates.toMotion(cameraOf(0.03), none);
        expectSame(AckermannMotion(), none);
        SequenceState same = state;
        rates.toInstant(MotionPrior(), same);
        EXPECT_EQ(state.value, same.value);
        EXPECT_EQ(state.covariance, same.covariance);
    }
}

// Predicted or between both neighbours: what the camera does is found and applied, and its sigma is true.
TEST(RSAckermann_RowRates, of_a_camera_that_shakes)
{
    const ShakingCamera shaking;
    const double unit = shaking.camera.secondsPerUnitTime(), h = 1e-4;
    for (int mode = 0; mode < 2; mode++)
    {
        RollingShutterCorrector::Params params;
        params.sequence = true;
        params.frameInterval = INTERVAL;
        const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(shaking.camera, params);
        double squares[2] = {0, 0}, errors[2] = {0, 0}, bent = 0, left = 0;
        int within = 0, count = 0;
        for (int i = 0; i < 30; i++)
        {
            Mat corrected;
            if (mode == 1)
                corrector->setNextFrame(shaking.frame(i + 1), std::numeric_limits<double>::quiet_NaN());
            const AckermannMotion motion = corrector->correctWithSegments(shaking.frame(i), Mat(), corrected);
            if (i < 10)
                continue;
            ASSERT_EQ(MOTION_OK, motion.status) << i;
            const double t = i * INTERVAL,
                         truth[2] = {(ShakingCamera::pitchAt(t + h) - ShakingCamera::pitchAt(t - h)) / (2 * h),
                                     (ShakingCamera::rollAt(t + h) - ShakingCamera::rollAt(t - h)) / (2 * h)},
                         got[2] = {motion.pitchRate / unit, motion.rollRate / unit},
                         sigma[2] = {motion.pitchRateSigma / unit, motion.rollRateSigma / unit};
            for (int k = 0; k < 2; k++, count++)
            {
                squares[k] += truth[k] * truth[k];
                errors[k] += std::pow(got[k] - truth[k], 2);
                within += std::abs(got[k] - truth[k]) < 2 * sigma[k];
            }
            EXPECT_EQ(mode == 0, motion.rotationCurve.empty()) << i;
            // How rows pitch beyond the rate
            const double first = shaking.camera.rowTime(Point2d()) * unit,
                         truly = ShakingCamera::pitchAt(t + first) - ShakingCamera::pitchAt(t) - truth[0] * first,
                         found = mode == 1 ? -motion.rotationCurve.at<double>(0, 0) : 0;
            bent += std::abs(truly);
            left += std::abs(found - truly);
        }
        EXPECT_LT(left, mode == 1 ? 0.3 * bent : 1.01 * bent);
        for (int k = 0; k < 2; k++)
            EXPECT_LT(std::sqrt(errors[k] / squares[k]), mode == 0 ? 0.4 : 0.25) << mode << " " << k;
        EXPECT_GE(within, 0.9 * count) << mode;
    }
}

}} // namespace
