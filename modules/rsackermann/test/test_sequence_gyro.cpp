// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_drive_simulator.hpp"
#include "test_shaking_camera.hpp"
#include "../src/motion/row_tilt.hpp"
#include "../src/sequence/expected_displacement.hpp"
#include "../src/sequence/row_rates.hpp"
#include "../src/sequence/gyro_rates.hpp"
#include "opencv2/rsackermann/corrector.hpp"

// A gyro on the camera: its bias, axes and clock by the turns of points, and the rates of rows (doc/theory.md, "Gyro").

namespace opencv_test { namespace {

using simulation::ShakingCamera;

const double INTERVAL = 1. / 30, DEGREE = CV_PI / 180;

//! How a car with an arm that shakes turns: angles of small turns about the axes of its camera.
struct Turning
{
    simulation::Oscillation slow[3], fast[3];

    explicit Turning(RNG& rng, double shaking = 0.15 * DEGREE)
        : slow{simulation::Oscillation(0.5 * DEGREE, 0.5, 1, rng), simulation::Oscillation(20 * DEGREE, 3, 10, rng),
               simulation::Oscillation(0.5 * DEGREE, 0.5, 1, rng)},
          fast{simulation::Oscillation(shaking, 0.1, 0.2, rng), simulation::Oscillation(shaking, 0.1, 0.2, rng),
               simulation::Oscillation(shaking, 0.1, 0.2, rng)}
    {
    }

    Vec3d angle(double seconds) const
    {
        Vec3d a;
        for (int i = 0; i < 3; i++)
            a[i] = slow[i].at(seconds) + fast[i].at(seconds);
        return a;
    }
    Vec3d rate(double seconds) const { return (angle(seconds + 1e-5) - angle(seconds - 1e-5)) * (1 / 2e-5); }
};

struct TrueGyro
{
    double delay, noise; // seconds, rad/s
    Vec3d bias, axes;    // rad/s, radians
    double scale;        // of what images show of pitch and yaw to what the gyro does
};

//! What the gyro shows: rate = scale (1 + [axes]) shown + bias.
void measure(const Turning& turning, const TrueGyro& gyro, double end, RNG& rng, Mat& times, Mat& rates)
{
    std::vector<double> t;
    std::vector<Vec3d> r;
    for (double s = -1; s < end + 1; s += 1 / 411.)
    {
        Vec3d a = turning.rate(s) - gyro.bias;
        a[0] /= gyro.scale;
        a[1] /= gyro.scale;
        t.push_back(s + gyro.delay);
        r.push_back(a - gyro.axes.cross(a) +
                    Vec3d(rng.gaussian(gyro.noise), rng.gaussian(gyro.noise), rng.gaussian(gyro.noise)));
    }
    Mat(t).copyTo(times);
    Mat(r).reshape(1).copyTo(rates);
}

//! Points show the turn between frames at their rows. @param noise rad/s.
TurnOfPoints turnOfPoints(const Turning& turning, int frame, double noise, RNG& rng)
{
    const RowSpan rows(-0.016, 0.012);
    const double end = frame * INTERVAL, begin = end - INTERVAL;
    Vec3d sum;
    const int count = 100;
    for (int i = 0; i < count; i++)
    {
        const double row = rows.from + (rows.to - rows.from) * (i + 0.5) / count;
        sum += turning.angle(end + row) - turning.angle(begin + row);
    }
    const Vec3d error(rng.gaussian(noise), rng.gaussian(noise), rng.gaussian(noise));
    return TurnOfPoints(begin, end, rows, sum * (1 / (count * INTERVAL)) + error);
}

const RowSpan IMAGE(-0.016, 0.016);

// The mean rates to the frame before and to the one after, at the rows of the points.
TEST(RSAckermann_Gyro, turns_to_both_neighbours)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.setRollPitch(0.1, -0.2);
    const Matx33d toCamera = camera.uprightRotation.t();
    const double yawRate = 0.3, growth = 2;
    const Vec3d rate(-0.05, 0.02, -0.04); // of pitch, yaw and roll; of yaw beyond that
    for (const double neighbour : {-0.05, 0.04})
        for (const double change : {0., 0.5})
        {
            SCOPED_TRACE(testing::Message() << neighbour << " " << change);
            const bool isEarlier = neighbour < 0;
            double values[FLOW_VALUES] = {0};
            values[SEQUENCE_YAW_RATE] = yawRate;
            values[FLOW_YAW_CHANGE] = growth;
            TrackedBearing bearing = TrackedBearing();
            bearing.pitch = isEarlier ? FLOW_PITCH_BEFORE : FLOW_PITCH_AFTER;
            bearing.timeNow = 0.3;
            // Of the present frame against the other one.
            NeighbourTurns turns;
            RowTurn* const all[3] = {&turns.pitch, &turns.yaw, &turns.roll};
            for (int i = 0; i < 3; i++)
            {
                all[i]->change = (i + 1) * change;
                all[i]->angle = -neighbour * rate[i] - all[i]->change * bearing.timeNow * camera.secondsPerUnitTime();
            }
            const std::vector<TrackedBearing> bearings(1, bearing);
            const TurnOfPoints turn(camera, bearings, values, turns, 7, neighbour);
            EXPECT_EQ(7 + std::min(neighbour, 0.), turn.begin);
            EXPECT_EQ(7 + std::max(neighbour, 0.), turn.end);
            const Vec3d expected(-rate[0], yawRate + growth * neighbour / 2 + rate[1], rate[2]);
            EXPECT_LT(cv::norm(camera.uprightRotation * turn.rate - expected), 1e-12);
            EXPECT_EQ(Vec3d(), turn.variance);
            EXPECT_EQ(Vec3d(), turn.lasting);
            const double sigma = 0.1;
            const TurnOfPoints vague(camera, bearings, values, turns, 7, neighbour, sigma, sigma / 2);
            EXPECT_EQ(turn.rate, vague.rate);
            for (int i = 0; i < 3; i++)
            {
                EXPECT_NEAR(sigma * std::abs(toCamera(i, 1)), std::sqrt(vague.variance[i]), 1e-12) << i;
                EXPECT_NEAR(sigma / 2 * toCamera(i, 1), vague.lasting[i], 1e-12) << i;
            }
            for (int axis = 0; axis < 3; axis++)
            {
                NeighbourTurns uncertain = turns;
                RowTurn* const each[3] = {&uncertain.pitch, &uncertain.yaw, &uncertain.roll};
                each[axis]->sigma = sigma * std::abs(neighbour);
                const TurnOfPoints about(camera, bearings, values, uncertain, 7, neighbour);
                for (int i = 0; i < 3; i++)
                    EXPECT_NEAR(sigma * std::abs(toCamera(i, axis)), std::sqrt(about.variance[i]), 1e-12) << axis << i;
            }
        }
}

// The turn that a sequence's first frame has shown is seen again in the second: once.
TEST(RSAckermann_Gyro, turn_that_is_seen_again_counts_once)
{
    for (int seed = 0; seed < 5; seed++)
    {
        RNG rng(400 + seed);
        const Turning turning(rng);
        Mat times, values;
        measure(turning, {0, 0, Vec3d(), Vec3d(), 1}, 3 * INTERVAL, rng, times, values);
        GyroRates once, again;
        for (GyroRates* gyro : {&once, &again})
            gyro->samples.add(times, values);
        const TurnOfPoints turn = turnOfPoints(turning, 1, 0.3 * DEGREE, rng);
        again.add(turnOfPoints(turning, 1, 0.3 * DEGREE, rng));
        for (GyroRates* gyro : {&once, &again})
            gyro->add(turn);
        const Vec<double, GyroRates::UNKNOWNS> sigma = once.alignmentSigma();
        for (int i = 0; i < GyroRates::UNKNOWNS; i++)
            EXPECT_NEAR(sigma[i], again.alignmentSigma()[i], 0.05 * sigma[i]) << seed << i;
    }
}

// Over many seeds all eight values are found, and their sigmas are true; so are those of the rates.
TEST(RSAckermann_Gyro, alignment_is_found)
{
    int within = 0, count = 0, ratesWithin = 0, rates = 0;
    double squares = 0, shown = 0;
    for (int seed = 0; seed < 40; seed++)
    {
        RNG rng(100 + seed);
        const Turning turning(rng);
        TrueGyro truth;
        truth.delay = rng.uniform(-0.03, 0.03);
        truth.noise = 0.3 * DEGREE;
        for (int i = 0; i < 3; i++)
        {
            truth.bias[i] = rng.gaussian(0.7 * DEGREE);
            truth.axes[i] = rng.gaussian(1.5 * DEGREE);
        }
        truth.scale = 1 + rng.gaussian(0.02);
        const int frames = 120;
        Mat times, values;
        measure(turning, truth, frames * INTERVAL, rng, times, values);
        GyroRates gyro;
        gyro.samples.add(times, values);
        for (int k = 1; k <= frames; k++)
            gyro.add(turnOfPoints(turning, k, 0.5 * DEGREE, rng));
        EXPECT_FALSE(gyro.contradicts()) << seed;
        const GyroAlignment& found = gyro.alignment();
        const Vec<double, 8> sigma = gyro.alignmentSigma();
        const double errors[8] = {found.delay - truth.delay,     found.turn[0] - truth.axes[0],
                                  found.turn[1] - truth.axes[1], found.turn[2] - truth.axes[2],
                                  found.bias[0] - truth.bias[0], found.bias[1] - truth.bias[1],
                                  found.bias[2] - truth.bias[2], found.scale - truth.scale};
        EXPECT_LT(std::abs(errors[0]), 0.002) << seed;
        for (int i = 0; i < 8; i++, count++)
            within += std::abs(errors[i]) < 2 * sigma[i];
        for (int k = frames / 2; k <= frames; k += 5)
        {
            CameraRates now;
            ASSERT_TRUE(gyro.at(k * INTERVAL, RowSpan(-1e-4, 1e-4), now));
            const Vec3d rate = turning.rate(k * INTERVAL), error = now.value - rate;
            squares += error.dot(error);
            shown += rate.dot(rate);
            for (int i = 0; i < 3; i++, rates++)
                ratesWithin += std::abs(error[i]) < 2 * now.sigma[i];
        }
    }
    EXPECT_GE(within, 0.88 * count);
    EXPECT_GE(ratesWithin, 0.9 * rates);
    EXPECT_LT(std::sqrt(squares / shown), 0.05);
}

// Of a bias that changes halfway the last turns tell more than the first ones, in whichever order time passes.
TEST(RSAckermann_Gyro, bias_that_changes)
{
    RNG rng(17);
    const Turning turning(rng);
    const int frames = 270; // within the memory
    const TrueGyro early = {0, 0, Vec3d(), Vec3d(), 1}, late = {0, 0, Vec3d::all(0.4 * DEGREE), Vec3d(), 1};
    Mat times, rates, lateRates;
    measure(turning, early, frames * INTERVAL, rng, times, rates);
    measure(turning, late, frames * INTERVAL, rng, times, lateRates);
    for (int i = 0; i < times.rows; i++)
        if (times.at<double>(i) > frames / 2 * INTERVAL)
            lateRates.row(i).copyTo(rates.row(i));
    for (const bool isBackward : {false, true})
    {
        GyroRates gyro;
        gyro.samples.add(times, rates);
        for (int k = 0; k < frames; k++)
            gyro.add(turnOfPoints(turning, isBackward ? frames - k : k + 1, 0.2 * DEGREE, rng));
        const double ofLast = isBackward ? 0 : 0.4 * DEGREE, ofFirst = 0.4 * DEGREE - ofLast;
        for (int i = 0; i < 3; i++)
            EXPECT_LT(std::abs(gyro.alignment().bias[i] - ofLast), 0.8 * std::abs(gyro.alignment().bias[i] - ofFirst))
                << isBackward << i;
    }
}

//! What a camera's gyro measures, and its points show, in some frames.
struct TurningCamera
{
    enum { FRAMES = 60 };

    RNG rng;
    Turning turning;
    Mat times, values;
    GyroRates gyro;

    explicit TurningCamera(int seed) : rng(seed), turning(rng, 0.3 * DEGREE)
    {
        const TrueGyro truth = {0, 0, Vec3d(), Vec3d(), 1};
        measure(turning, truth, FRAMES * INTERVAL, rng, times, values);
    }

    //! In how many frames the gyro is used, from a first one. @param share of the turns that points show, by axis.
    int used(int first, const Vec3d& share = Vec3d::all(1))
    {
        gyro.samples.add(times, values);
        int count = 0;
        for (int k = 1; k <= FRAMES; k++)
        {
            TurnOfPoints turn = turnOfPoints(turning, k, 0.3 * DEGREE, rng);
            turn.rate = turn.rate.mul(share);
            gyro.add(turn);
            count += k >= first && !gyro.contradicts();
        }
        return count;
    }
};

// What isn't a gyro of this camera isn't used, and is distinguished from one whose clock differs.
TEST(RSAckermann_Gyro, contradictions_are_noticed)
{
    const char* const names[] = {"nothing", "degrees", "wrong sign", "other axes", "noise"};
    for (int kind = 0; kind < 5; kind++)
        for (int seed = 0; seed < 5; seed++)
        {
            SCOPED_TRACE(format("%s %d", names[kind], seed));
            TurningCamera camera(200 + seed);
            if (kind == 0)
                camera.values.setTo(0);
            else if (kind == 1)
                camera.values *= 57.3;
            else if (kind == 2)
                camera.values *= -1;
            else if (kind == 3)
            {
                const Mat x = camera.values.col(0).clone();
                camera.values.col(1).copyTo(camera.values.col(0));
                x.copyTo(camera.values.col(1));
            }
            else
                camera.rng.fill(camera.values, RNG::NORMAL, 0, 0.3);
            EXPECT_LE(camera.used(1), 4); // until what isn't known of a true one explains it no more
            EXPECT_TRUE(camera.gyro.contradicts());
            EXPECT_TRUE(camera.gyro.isWrong());
        }
}

// Of another full scale it explains most of the squares all the same.
TEST(RSAckermann_Gyro, half_of_the_rates)
{
    for (int seed = 0; seed < 5; seed++)
        for (const double share : {0.5, 0.95, 1.05, 1.5})
        {
            TurningCamera camera(300 + seed);
            camera.values *= share;
            camera.used(1);
            EXPECT_EQ(std::abs(share - 1) > 0.1, camera.gyro.contradicts()) << share << " " << seed;
            EXPECT_EQ(camera.gyro.contradicts(), camera.gyro.isWrong()) << share << " " << seed;
        }
}

// About an axis that turns less than the others, too.
TEST(RSAckermann_Gyro, one_axis_with_the_wrong_sign)
{
    const int first = 16;
    for (const int axis : {0, 2})
        for (int seed = 0; seed < 5; seed++)
            for (const double sign : {1., -1.})
            {
                TurningCamera camera(250 + seed);
                Vec3d share = Vec3d::all(1);
                share[axis] = 0.4;
                camera.values.col(axis) *= sign * share[axis];
                EXPECT_EQ(sign > 0 ? TurningCamera::FRAMES + 1 - first : 0, camera.used(first, share))
                    << axis << seed << sign;
            }
}

// A gyro that sticks for a moment isn't used meanwhile, and is afterwards.
TEST(RSAckermann_Gyro, that_sticks_for_a_moment)
{
    const int first = 30, last = 36; // frames
    for (int seed = 0; seed < 5; seed++)
        for (const bool sticks : {false, true})
        {
            SCOPED_TRACE(testing::Message() << seed << sticks);
            TurningCamera camera(260 + seed);
            for (int i = 0; i < camera.times.rows && sticks; i++)
            {
                const double seconds = camera.times.at<double>(i);
                if (seconds > (first - 1) * INTERVAL && seconds < last * INTERVAL)
                    camera.values.row(i).setTo(0);
            }
            camera.gyro.samples.add(camera.times, camera.values);
            int used[2] = {0, 0};
            for (int k = 1; k <= TurningCamera::FRAMES; k++)
            {
                camera.gyro.add(turnOfPoints(camera.turning, k, 0.1 * DEGREE, camera.rng));
                CameraRates rates;
                used[k >= first && k <= last] += camera.gyro.at(k * INTERVAL, IMAGE, rates);
            }
            EXPECT_FALSE(camera.gyro.contradicts());
            EXPECT_EQ(TurningCamera::FRAMES - 7, used[0]);
            EXPECT_EQ(sticks ? 0 : 7, used[1]);
        }
}

// It is used from then on, and what else is between it and the camera is found anew.
TEST(RSAckermann_Gyro, another_clock_is_found)
{
    for (double delay : {-1.7, -0.3, 1.0})
    {
        SCOPED_TRACE(delay);
        RNG rng(300);
        const Turning turning(rng, 0.3 * DEGREE);
        const TrueGyro truth = {delay, 0.2 * DEGREE, Vec3d(0.5, -0.5, 0.3) * DEGREE, Vec3d(), 1};
        Mat times, values;
        measure(turning, truth, 3, rng, times, values);
        GyroRates gyro;
        gyro.samples.add(times, values);
        int found = 0;
        for (int k = 1; k <= 60; k++)
        {
            gyro.add(turnOfPoints(turning, k, 0.3 * DEGREE, rng));
            found += std::abs(gyro.alignment().delay - delay) < 0.01;
            EXPECT_FALSE(found > 0 && gyro.contradicts()) << k;
        }
        EXPECT_GT(found, 30);
        EXPECT_NEAR(delay, gyro.alignment().delay, 0.002);
        EXPECT_LT(cv::norm(gyro.alignment().bias - truth.bias), 0.5 * DEGREE);
        gyro.reset();
        EXPECT_EQ(0, gyro.alignment().delay);
    }
}

// What is known of a clock beforehand counts from where it was found, also of a car that hardly shakes.
TEST(RSAckermann_Gyro, another_clock_is_as_exact)
{
    for (const double shaking : {0.03, 0.1})
    {
        double error[2];
        for (int i = 0; i < 2; i++)
        {
            const double delay = i == 0 ? 0 : 1.1;
            RNG rng(330);
            const Turning turning(rng, shaking * DEGREE);
            Mat times, values;
            measure(turning, {delay, 0.2 * DEGREE, Vec3d(), Vec3d(), 1}, 3, rng, times, values);
            GyroRates gyro;
            gyro.samples.add(times, values);
            for (int k = 1; k <= 60; k++)
                gyro.add(turnOfPoints(turning, k, 0.3 * DEGREE, rng));
            error[i] = gyro.alignment().delay - delay;
        }
        EXPECT_NEAR(error[0], error[1], 2e-4) << shaking;
    }
}

// All rows of an image, whichever comes first.
TEST(RSAckermann_Gyro, rows_of_an_image)
{
    RollingShutterCamera camera(Size(640, 380), Matx33d(400, 0, 319.5, 0, 500, 189.5, 0, 0, 1));
    camera.lineDelay = 2e-5;
    for (int scan : {SCAN_TOP_TO_BOTTOM, SCAN_BOTTOM_TO_TOP})
    {
        camera.scanDirection = scan;
        const RowSpan rows(camera);
        EXPECT_NEAR(-189.5 * 2e-5, rows.from, 1e-12) << scan;
        EXPECT_NEAR(189.5 * 2e-5, rows.to, 1e-12) << scan;
    }
}

// Of another sequence nothing is left, whatever the gyro was in it.
TEST(RSAckermann_Gyro, reset_forgets_every_history)
{
    struct History
    {
        const char* name;
        double delay, factor; // of the gyro, by which it shows too much
        int frames;
    } const histories[] = {
        {"short", 0, 1, 3}, {"right", 0, 1, 60}, {"another clock", 0.8, 1, 60}, {"wrong", 0, -1, 60}};
    for (const History& history : histories)
    {
        SCOPED_TRACE(history.name);
        RNG rng(320);
        const Turning turning(rng, 0.3 * DEGREE);
        Mat times, values;
        measure(turning, {history.delay, 0, Vec3d(), Vec3d(), 1}, 3, rng, times, values);
        GyroRates used, unused;
        used.samples.add(times, values * history.factor);
        for (int k = 1; k <= history.frames; k++)
            used.add(turnOfPoints(turning, k, 0.3 * DEGREE, rng));
        EXPECT_EQ(history.factor < 0, used.isWrong());
        if (history.delay > 0)
        {
            EXPECT_NEAR(history.delay, used.alignment().delay, 0.01);
        }
        used.reset();
        measure(turning, {0.01, 0, Vec3d(), Vec3d(), 1}, 3, rng, times, values);
        used.samples.clear();
        for (GyroRates* gyro : {&used, &unused})
            gyro->samples.add(times, values);
        for (int k = 1; k <= 10; k++)
        {
            const TurnOfPoints turn = turnOfPoints(turning, k, 0.3 * DEGREE, rng);
            for (GyroRates* gyro : {&used, &unused})
                gyro->add(turn);
            EXPECT_EQ(unused.alignment().delay, used.alignment().delay) << k;
            EXPECT_EQ(unused.alignment().bias, used.alignment().bias) << k;
            EXPECT_EQ(unused.alignmentSigma(), used.alignmentSigma()) << k;
            EXPECT_EQ(unused.contradicts(), used.contradicts()) << k;
        }
    }
}

// A camera that looks sideways shows yaw rates that err by several degrees per second, and says so.
TEST(RSAckermann_Gyro, vague_turns_do_not_contradict)
{
    int contradicted[3] = {0, 0, 0}; // exact turns, vague ones, and vague ones with their variance
    for (int seed = 0; seed < 20; seed++)
        for (int kind = 0; kind < 3; kind++)
        {
            RNG rng(500 + seed);
            const Turning turning(rng, 0.3 * DEGREE);
            Mat times, values;
            measure(turning, {0, 0, Vec3d(), Vec3d(), 1}, 3, rng, times, values);
            GyroRates gyro;
            gyro.samples.add(times, values);
            double error = 0;
            for (int k = 1; k <= 40; k++)
            {
                TurnOfPoints turn = turnOfPoints(turning, k, 0.3 * DEGREE, rng);
                const double sigma = 8 * DEGREE, kept = 0.9; // as a sequence's states keep their errors
                error = k == 1 ? rng.gaussian(sigma) : kept * error + rng.gaussian(std::sqrt(1 - kept * kept) * sigma);
                if (kind > 0)
                    turn.rate[1] += error;
                if (kind > 1)
                    turn.variance[1] = sigma * sigma;
                gyro.add(turn);
                CameraRates rates;
                contradicted[kind] += gyro.contradicts() || !gyro.at(k * INTERVAL, IMAGE, rates);
            }
        }
    EXPECT_GE(contradicted[1], contradicted[0] + 30);
    EXPECT_LE(contradicted[2], contradicted[0] + 5);
}

// Turns that all err alike are mistaken for a bias, however many they are.
TEST(RSAckermann_Gyro, lasting_errors_of_turns_are_in_its_sigma)
{
    const int seeds = 40, frames = 40;
    double squares[2] = {0, 0}; // of errors over their sigmas, without and with what is said to last
    for (int seed = 0; seed < seeds; seed++)
        for (const int isSaid : {0, 1})
        {
            RNG rng(600 + seed);
            const Turning turning(rng, 0.3 * DEGREE);
            const double sigma = 3 * DEGREE, error = rng.gaussian(sigma);
            Mat times, values;
            measure(turning, {0, 0, Vec3d(), Vec3d(), 1}, 3, rng, times, values);
            GyroRates gyro;
            gyro.samples.add(times, values);
            for (int k = 1; k <= frames; k++)
            {
                TurnOfPoints turn = turnOfPoints(turning, k, 0.3 * DEGREE, rng);
                turn.rate[1] += error;
                turn.variance[1] = sigma * sigma;
                turn.lasting[1] = isSaid * sigma;
                gyro.add(turn);
            }
            CameraRates rates;
            ASSERT_TRUE(gyro.at(frames * INTERVAL, IMAGE, rates));
            const double z = (rates.value[1] - turning.rate(frames * INTERVAL)[1]) / rates.sigma[1];
            squares[isSaid] += z * z / seeds;
        }
    EXPECT_GT(squares[0], 10);
    EXPECT_NEAR(1, squares[1], 0.5);
}

// Neither if only one axis turns, which some delay fits by chance, nor if the gyro would have a bias as none has.
TEST(RSAckermann_Gyro, another_clock_is_not_made_up)
{
    for (int seed = 0; seed < 3; seed++)
        for (const bool isBiased : {false, true})
        {
            SCOPED_TRACE(testing::Message() << seed << isBiased);
            RNG rng(310 + seed);
            const Turning turning(rng, 0.3 * DEGREE), other(rng, 0.3 * DEGREE);
            const TrueGyro truth = {isBiased ? 0.3 : 0., 0, isBiased ? Vec3d(0, 0, 12 * DEGREE) : Vec3d(), Vec3d(), 1};
            Mat times, values;
            measure(isBiased ? turning : other, truth, 3, rng, times, values);
            GyroRates gyro;
            gyro.samples.add(times, values);
            for (int k = 1; k <= 60; k++)
            {
                TurnOfPoints turn = turnOfPoints(turning, k, 0.1 * DEGREE, rng);
                if (!isBiased)
                    turn.rate = Vec3d(0, turn.rate[1], 0);
                gyro.add(turn);
                EXPECT_LT(std::abs(gyro.alignment().delay), 0.1) << k;
            }
        }
}

// Whatever is taken off the times.
TEST(RSAckermann_Gyro, samples_in_parts_are_in_order)
{
    const Mat rates(2, 3, CV_64F, Scalar(0.1));
    for (const double origin : {0., 100., -100.})
    {
        GyroSamples samples;
        samples.add((Mat_<double>(2, 1) << 100, 100.1), rates, origin);
        EXPECT_THROW(samples.add((Mat_<double>(2, 1) << 100.1, 100.2), rates, origin), cv::Exception) << origin;
        EXPECT_THROW(samples.add((Mat_<double>(2, 1) << 100.05, 100.2), rates, origin), cv::Exception) << origin;
        samples.add((Mat_<double>(2, 1) << 100.11, 100.2), rates, origin);
    }
}

// Of samples that also shake, by 30 deg/s at 7 Hz, and have a gap.
TEST(RSAckermann_Gyro, noise_of_its_angles)
{
    RNG rng(71);
    GyroSamples samples;
    EXPECT_EQ(0, samples.angleNoise());
    const double sigma = 0.002, interval = 0.005;
    Mat times, rates;
    for (int i = 0; i < 4000; i++)
    {
        const double t = i * interval + (i < 2000 ? 0 : 1), shaken = 0.5 * std::sin(14 * CV_PI * t);
        times.push_back(t);
        rates.push_back(Mat(Vec3d(shaken + rng.gaussian(sigma), rng.gaussian(sigma), i < 2000 ? 0 : 3).t()));
    }
    samples.add(times.rowRange(0, 8), rates.rowRange(0, 8));
    EXPECT_EQ(0, samples.angleNoise());
    samples.add(times.rowRange(8, 4000), rates.rowRange(8, 4000));
    EXPECT_NEAR(1, samples.angleNoise() / (2. / 3 * sigma * sigma * interval), 0.1); // the third axis has none
}

// The rates of rows err by the noise of the samples in the read-out.
TEST(RSAckermann_Gyro, noise_of_its_rates)
{
    RNG rng(72);
    const double sigma = 10 * DEGREE;
    Mat times, values;
    for (int i = 0; i < 8000; i++)
    {
        times.push_back(i / 400.);
        values.push_back(Mat(Vec3d(rng.gaussian(sigma), rng.gaussian(sigma), rng.gaussian(sigma)).t()));
    }
    GyroRates gyro;
    GyroSigmas exact;
    exact.delay = exact.axes = exact.bias = exact.scale = 1e-9;
    gyro.setSigmas(exact);
    gyro.samples.add(times, values);
    for (const RowSpan& rows : {RowSpan(-0.015, 0.015), RowSpan(0, 0.02), RowSpan(-0.02, 0)})
    {
        double squares = 0, expected = 0;
        for (double seconds = 1; seconds < 19; seconds += 0.05)
        {
            CameraRates rates;
            ASSERT_TRUE(gyro.at(seconds, rows, rates));
            squares += rates.value.dot(rates.value);
            expected += rates.sigma.dot(rates.sigma);
        }
        EXPECT_NEAR(0.9, squares / expected, 0.15) << rows.from; // samples of 2.5 ms are smooth noise
    }
}

// The integral of straight pieces is exact, and what isn't there isn't made up.
TEST(RSAckermann_Gyro, samples_and_gaps)
{
    GyroSamples samples;
    Vec3d rate;
    EXPECT_FALSE(samples.rowRate(0, -1, 1, rate));
    const double times[] = {0, 0.01, 0.02, 0.5, 0.51, 0.52},
                 values[] = {1, 0, 2, 2, 0, 2, 3, 0, 2, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    const Mat t(6, 1, CV_64F, const_cast<double*>(times)), r(6, 3, CV_64F, const_cast<double*>(values));
    samples.add(t.rowRange(0, 4), r.rowRange(0, 4));
    samples.add(t.rowRange(4, 6), r.rowRange(4, 6));
    ASSERT_TRUE(samples.meanRate(0.004, 0.012, 0, 0, rate));
    EXPECT_NEAR(1.8, rate[0], 1e-12);
    EXPECT_NEAR(2, rate[2], 1e-12);
    ASSERT_TRUE(samples.rowRate(0.01, -0.01, 0.01, rate));
    EXPECT_NEAR(2, rate[0], 1e-12); // what is even about the instant turns the rows as far on both sides
    EXPECT_TRUE(samples.covers(0.5, 0.52));
    EXPECT_FALSE(samples.covers(0.01, 0.51));
    EXPECT_FALSE(samples.covers(0.1, 0.2));
    EXPECT_FALSE(samples.covers(-0.01, 0.01));
    EXPECT_FALSE(samples.covers(0.51, 0.53));
    EXPECT_THROW(samples.add(t, r), cv::Exception); // earlier than the last
    EXPECT_THROW(samples.add(t + 1, r.colRange(0, 2)), cv::Exception);
    EXPECT_THROW(samples.add(t + 1, r * std::numeric_limits<double>::quiet_NaN()), cv::Exception);
    Mat descending = t + 1;
    descending.at<double>(3) = 1;
    EXPECT_THROW(samples.add(descending, r), cv::Exception);
    EXPECT_EQ(0.52, samples.lastTime()); // nothing of it was added
    samples.add(Mat(), Mat());
    samples.forgetBefore(0.01); // that would keep most
    EXPECT_TRUE(samples.covers(0, 0.02));
    samples.forgetBefore(0.505);
    EXPECT_FALSE(samples.covers(0.5, 0.505));
    EXPECT_TRUE(samples.covers(0.51, 0.52));
    samples.forgetBefore(9);
    EXPECT_EQ(0.52, samples.lastTime()); // the next ones follow it
    samples.add(t.rowRange(3, 6) + 0.03, r.rowRange(3, 6));
    EXPECT_TRUE(samples.covers(0.51, 0.55));
}

// Backward in time the same turns come in another order, gaps as well.
TEST(RSAckermann_Gyro, samples_in_reversed_time)
{
    RNG rng(4);
    const int count = 60;
    Mat times(count, 1, CV_64F), rates(count, 3, CV_64F), backTimes, backRates;
    rng.fill(rates, RNG::UNIFORM, -1, 1);
    double seconds = 0;
    for (int i = 0; i < count; i++)
        times.at<double>(i) = seconds += i % 13 == 7 ? 0.3 : rng.uniform(0.002, 0.03);
    flip(-times, backTimes, 0);
    flip(rates, backRates, 0);
    GyroSamples samples, back;
    for (int i = 0; i < count; i += 10)
    {
        samples.add(times.rowRange(i, i + 10), rates.rowRange(i, i + 10));
        back.add(backTimes.rowRange(i, i + 10), backRates.rowRange(i, i + 10));
    }
    int compared = 0;
    for (int i = 0; i < 2000; i++)
    {
        const double begin = rng.uniform(0., seconds), end = begin + rng.uniform(0.001, 0.1);
        Vec3d turn, backTurn, rate, backRate;
        ASSERT_EQ(samples.covers(begin, end), back.covers(-end, -begin));
        if (!samples.turn(begin, end, turn))
            continue;
        compared++;
        ASSERT_TRUE(back.turn(-end, -begin, backTurn));
        EXPECT_LT(cv::norm(turn - backTurn), 1e-9);
        ASSERT_EQ(samples.rowRate(begin, -0.01, 0.02, rate), back.rowRate(-begin, -0.02, 0.01, backRate));
        EXPECT_LT(cv::norm(rate - backRate), 1e-9);
    }
    EXPECT_GT(compared, 400);
}

// What shakes up to five times slower than samples follow isn't lost between them, nor where they come in two parts.
TEST(RSAckermann_Gyro, samples_of_fast_shaking)
{
    const double omega = 2 * CV_PI * 40, step = 1 / 200.;
    Mat times, rates;
    for (int i = 0; i < 60; i++)
    {
        times.push_back(i * step);
        rates.push_back(Mat(Matx13d(omega * std::cos(omega * i * step), 0.3, i * step)));
    }
    GyroSamples samples;
    samples.add(times.rowRange(0, 25), rates.rowRange(0, 25));
    samples.add(times.rowRange(25, 60), rates.rowRange(25, 60));
    double worst = 0;
    for (double begin = 0.02; begin < 0.2; begin += 0.0013)
    {
        Vec3d turn;
        const double end = begin + 0.0117;
        ASSERT_TRUE(samples.turn(begin, end, turn));
        worst = std::max(worst, std::abs(turn[0] - (std::sin(omega * end) - std::sin(omega * begin))));
        EXPECT_NEAR(0.3 * (end - begin), turn[1], 1e-12);
        EXPECT_NEAR((end * end - begin * begin) / 2, turn[2], 1e-12);
    }
    EXPECT_LT(worst, 0.1); // of 2; straight pieces leave 0.25
}

//! From the frame of a camera with these rates, rad/s about its own axes, some seconds after an instant to that of the
//! instant: integrated in small steps.
Matx33d integrated(const std::function<Vec3d(double)>& rate, double instant, double after)
{
    const int steps = 2000;
    Matx33d R = Matx33d::eye();
    for (int i = 0; i < steps; i++)
    {
        Matx33d step;
        Rodrigues(rate(instant + after * (i + 0.5) / steps) * (after / steps), step);
        R = R * step;
    }
    return R;
}

// An engine's shaking turns back within an image: its rows turn as the gyro has turned, about the axes of a camera that
// leans, from whichever side they are read. Rates alone leave most of it.
TEST(RSAckermann_Gyro, rows_follow_what_shakes_fast)
{
    const auto rate = [](double t) {
        return 8 * DEGREE *
               Vec3d(std::sin(2 * CV_PI * 27 * t), 0.5 + std::sin(2 * CV_PI * 35 * t), std::cos(2 * CV_PI * 31 * t));
    };
    Mat times, values;
    for (int i = 0; i < 400; i++)
    {
        times.push_back(i / 400.);
        values.push_back(Mat(rate(i / 400.).t()));
    }
    GyroRates gyro;
    GyroSigmas sigmas;
    sigmas.delay = 1e-5; // at 35 Hz a millisecond is a fifth of a turn
    gyro.setSigmas(sigmas);
    gyro.samples.add(times, values);
    for (int scan : {SCAN_TOP_TO_BOTTOM, SCAN_BOTTOM_TO_TOP})
    {
        RollingShutterCamera camera = simulation::paperCamera();
        camera.scanDirection = scan;
        camera.lineDelay = 0.03 / camera.imageSize.height;
        camera.setRollPitch(0.1, -0.2);
        const double seconds = 0.4, unit = camera.secondsPerUnitTime();
        CameraRates rates;
        ASSERT_TRUE(gyro.at(seconds, RowSpan(camera), rates));
        MeasuredTurns turns;
        rates.about(camera.uprightRotation, turns.pitch, turns.yaw, turns.roll);
        turns.pitch.value = -turns.pitch.value;
        const double first = unit * camera.rowTime(Point2d()),
                     last = unit * camera.rowTime(Point2d(0, camera.imageSize.height - 1));
        turns.curve = gyro.curve(seconds, rates, first, last, camera.uprightRotation);
        RowRates rowRates;
        rowRates.set(turns);
        AckermannMotion motion;
        rowRates.toMotion(camera, motion);
        motion.alpha = turns.yaw.value * unit / 2;
        AckermannMotion steady = motion;
        steady.rotationCurve.release();
        double left = 0, leftBySteady = 0;
        for (int row = 0; row < camera.imageSize.height; row += 10)
        {
            const double time = camera.rowTime(Point2d(0, row));
            const Matx33d truth = integrated(rate, seconds, unit * time);
            Matx33d R;
            Vec3d T;
            motion.pose(camera, time, R, T);
            left += cv::norm(R, truth);
            steady.pose(camera, time, R, T);
            leftBySteady += cv::norm(R, truth);
        }
        EXPECT_LT(left, 0.03 * leftBySteady) << scan;
        // Beyond the samples there is none.
        EXPECT_TRUE(gyro.curve(0.01, rates, first, last, camera.uprightRotation).empty());
        EXPECT_TRUE(gyro.curve(0.995, rates, first, last, camera.uprightRotation).empty());
    }
}

// A bias that is found turns no rows, neither before nor after the reference row.
TEST(RSAckermann_Gyro, rows_without_bias)
{
    RNG rng(7);
    const Turning turning(rng);
    const TrueGyro truth = {0, 0.05 * DEGREE, Vec3d(2, -3, 1) * DEGREE, Vec3d(), 1};
    const int frames = 120;
    Mat times, values;
    measure(turning, truth, frames * INTERVAL, rng, times, values);
    GyroRates gyro;
    GyroSigmas sigmas;
    sigmas.delay = 1e-4;
    gyro.setSigmas(sigmas);
    gyro.samples.add(times, values);
    for (int k = 1; k <= frames; k++)
        gyro.add(turnOfPoints(turning, k, 0.1 * DEGREE, rng));
    for (int k = frames / 2; k <= frames; k += 5)
    {
        const double seconds = k * INTERVAL;
        CameraRates rates;
        ASSERT_TRUE(gyro.at(seconds, IMAGE, rates));
        const Mat curve = gyro.curve(seconds, rates, IMAGE.from, IMAGE.to, Matx33d::eye());
        ASSERT_GT(curve.rows, 2);
        for (int i = 0; i < curve.rows; i++)
        {
            const double later = IMAGE.from + (IMAGE.to - IMAGE.from) * i / (curve.rows - 1);
            const Vec3d got = Vec3d(curve.ptr<double>(i)) + rates.value * later;
            EXPECT_LT(cv::norm(got - (turning.angle(seconds + later) - turning.angle(seconds))), 0.01 * DEGREE)
                << k << " " << i;
        }
    }
}

//! Mean squares of the errors of pitch, roll and yaw rate, (rad/s)^2, over frames that are corrected one after another.
Vec3d errorsOf(const Ptr<RollingShutterCorrector>& corrector, const ShakingCamera& shaking, int frames, int from)
{
    const double unit = shaking.camera.secondsPerUnitTime();
    Vec3d squares;
    for (int i = 0; i < frames; i++)
    {
        Mat corrected;
        corrector->setTimestamp(i * ShakingCamera::interval());
        const AckermannMotion motion = corrector->correctWithSegments(shaking.frame(i), Mat(), corrected);
        if (i < from)
            continue;
        EXPECT_EQ(MOTION_OK, motion.status) << i;
        const Vec3d truth = ShakingCamera::rateAt(i * ShakingCamera::interval()),
                    got(-motion.pitchRate / unit, 2 * motion.alpha / unit, motion.rollRate / unit);
        squares += (got - truth).mul(got - truth);
    }
    return squares * (1. / (frames - from));
}

void gyroOf(double delay, const Vec3d& bias, Mat& times, Mat& rates)
{
    times.create(600, 1, CV_64F);
    rates.create(600, 3, CV_64F);
    for (int i = 0; i < 600; i++)
    {
        const double seconds = i / 300. - 0.5;
        times.at<double>(i) = seconds + delay;
        const Vec3d rate = ShakingCamera::rateAt(seconds) - bias;
        std::copy(rate.val, rate.val + 3, rates.ptr<double>(i));
    }
}

// Signs, clock and bias of images and gyro fit together: the rates of frames are better than without a gyro.
TEST(RSAckermann_Gyro, of_a_camera_that_shakes)
{
    const ShakingCamera shaking;
    RollingShutterCorrector::Params params;
    params.sequence = true;
    const Vec3d without = errorsOf(RollingShutterCorrector::create(shaking.camera, params), shaking, 30, 10);
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(shaking.camera, params);
    Mat times, rates;
    gyroOf(0.015, Vec3d(0.01, -0.008, 0.006), times, rates);
    corrector->addGyro(times.rowRange(0, 200), rates.rowRange(0, 200));
    corrector->addGyro(times.rowRange(200, 600), rates.rowRange(200, 600));
    const Vec3d with = errorsOf(corrector, shaking, 30, 10);
    EXPECT_LT(std::sqrt((with[0] + with[2]) / (without[0] + without[2])), 0.5);
    EXPECT_LT(std::sqrt(with[0]), 0.025); // of 0.18 rad/s

    // And so are their rows beyond the rates.
    Mat corrected;
    double left = 0, all = 0;
    for (int i = 30; i < 38; i++)
    {
        const double seconds = i * ShakingCamera::interval(), unit = shaking.camera.secondsPerUnitTime();
        corrector->setTimestamp(seconds);
        const AckermannMotion motion = corrector->correctWithSegments(shaking.frame(i), Mat(), corrected);
        ASSERT_FALSE(motion.rotationCurve.empty()) << i;
        EXPECT_TRUE(corrector->isGyroUsed()) << i;
        for (int row = 0; row < shaking.camera.imageSize.height; row += 20)
        {
            const double time = shaking.camera.rowTime(Point2d(0, row)),
                         truth = ShakingCamera::pitchAt(seconds + time * unit) - ShakingCamera::pitchAt(seconds) -
                                 motion.pitchRate * time;
            left += std::abs(truth + RotationCurve(shaking.camera, motion.rotationCurve).at(time)[0]);
            all += std::abs(truth);
        }
    }
    EXPECT_LT(left, 0.3 * all);
    double delay;
    Vec3d axes, bias;
    EXPECT_TRUE(corrector->getGyroAlignment(delay, axes, bias));
    EXPECT_NEAR(0.015, delay, 0.003);
    EXPECT_NEAR(0.01, bias[0], 0.005);
}

// A gyro that measures something else changes nothing, and neither does one that was removed.
// What shakes while the clock isn't known is unknown, by as much as it shakes; what lasts isn't.
TEST(RSAckermann_Gyro, clock_that_is_not_known_leaves_what_lasts)
{
    const double amplitude = 8 * DEGREE, steady = 3 * DEGREE, frequency = 7;
    Mat times, values;
    for (int i = 0; i < 2000; i++)
    {
        const double t = i / 400., rate = steady + amplitude * std::sin(2 * CV_PI * frequency * t);
        times.push_back(t);
        values.push_back(Mat(Matx13d(rate, rate, rate)));
    }
    const RowSpan rows(-0.005, 0.005);
    for (const double delay : {0.0001, 0.01, 0.02, 0.1, 0.3})
    {
        GyroRates gyro;
        GyroSigmas sigmas;
        sigmas.delay = delay;
        sigmas.bias = sigmas.axes = sigmas.scale = 1e-6;
        gyro.setSigmas(sigmas);
        gyro.samples.add(times, values);
        const double left = std::exp(-std::pow(2 * CV_PI * frequency * delay, 2) / 2);
        double squares[2] = {0, 0}; // of the error and of its standard deviation
        RNG rng(1);
        const int instants = 300;
        for (int i = 0; i < instants; i++)
        {
            const double seconds = 2 + 0.003 * i, angle = 2 * CV_PI * frequency * seconds,
                         truth = steady + amplitude * std::sin(angle + 2 * CV_PI * frequency * rng.gaussian(delay));
            CameraRates rates;
            ASSERT_TRUE(gyro.at(seconds, rows, rates));
            for (int axis = 0; axis < 3; axis++)
            {
                EXPECT_NEAR(steady + left * amplitude * std::sin(angle), rates.value[axis], 0.03 * amplitude) << delay;
                squares[0] += std::pow(rates.value[axis] - truth, 2) / (3 * instants);
                squares[1] += std::pow(rates.sigma[axis], 2) / (3 * instants);
            }
        }
        const double atLeast = 0.5 * DEGREE; // what any gyro leaves
        EXPECT_NEAR(std::hypot(std::sqrt(squares[0]), atLeast), std::sqrt(squares[1]), 0.1 * std::sqrt(squares[1]))
            << delay;
    }
}

// Rates of pitch and roll displace, and what isn't known of them is left.
TEST(RSAckermann_Gyro, single_image_expects_what_rows_turn)
{
    const RollingShutterCamera camera = simulation::paperCamera();
    const DisplacementField field(camera);
    const auto expected = [&](double rate, double sigma) {
        AckermannMotion motion;
        motion.expectedRaw = 0.4;
        motion.expectedResidual = 0.3;
        motion.pitchRate = rate;
        motion.pitchRateSigma = sigma;
        expectRowTurns(field, camera, motion);
        return Vec2d(std::sqrt(std::pow(motion.expectedRaw, 2) - 0.16),
                     std::sqrt(std::pow(motion.expectedResidual, 2) - 0.09));
    };
    EXPECT_LT(cv::norm(expected(0, 0)), 1e-6);
    const Vec2d known = expected(0.01, 0), unknown = expected(0, 0.01), more = expected(0, 0.02);
    EXPECT_GT(known[0], 0.9);
    EXPECT_LT(known[1], 1e-6);
    EXPECT_NEAR(known[0] * std::sqrt(2 / CV_PI), unknown[0], 0.01 * known[0]); // of a normal distribution
    EXPECT_NEAR(unknown[0], unknown[1], 1e-9);
    EXPECT_NEAR(2 * unknown[1], more[1], 1e-6 * more[1]);
}

TEST(RSAckermann_Gyro, that_is_wrong_changes_nothing)
{
    const ShakingCamera shaking;
    RollingShutterCorrector::Params params;
    params.sequence = true;
    Mat times, rates;
    gyroOf(0, Vec3d(), times, rates);
    const Vec3d without = errorsOf(RollingShutterCorrector::create(shaking.camera, params), shaking, 20, 5);
    for (int kind = 0; kind < 3; kind++)
    {
        const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(shaking.camera, params);
        corrector->addGyro(times, rates * (kind == 0 ? 57.3 : kind == 1 ? -1. : 1.));
        if (kind == 2)
            corrector->clearGyro();
        EXPECT_EQ(without, errorsOf(corrector, shaking, 20, 5)) << kind;
        double delay;
        Vec3d axes, bias;
        EXPECT_EQ(kind == 2, corrector->getGyroAlignment(delay, axes, bias));
        EXPECT_FALSE(corrector->isGyroUsed()) << kind;
    }
}

// Without anything to see, in a sequence or alone, the rows turn as the gyro says.
TEST(RSAckermann_Gyro, in_the_dark)
{
    const ShakingCamera shaking;
    Mat times, rates;
    gyroOf(0, Vec3d(), times, rates);
    const double seconds = 0.1, unit = shaking.camera.secondsPerUnitTime();
    const Mat dark(shaking.camera.imageSize, CV_8U, Scalar(0));
    for (bool sequence : {false, true})
    {
        RollingShutterCorrector::Params params;
        params.sequence = sequence;
        params.gyroDelaySigma = 0.001;
        const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(shaking.camera, params);
        corrector->addGyro(times, rates);
        MotionPrior prior;
        prior.speedSigma = 0.01;
        corrector->setPrior(prior);
        corrector->setTimestamp(seconds);
        Mat corrected;
        const AckermannMotion motion = corrector->correct(dark, corrected);
        ASSERT_EQ(MOTION_OK, motion.status);
        EXPECT_TRUE(corrector->isGyroUsed());
        const Vec3d truth = ShakingCamera::rateAt(seconds);
        EXPECT_NEAR(-truth[0] * unit, motion.pitchRate, 0.1 * std::abs(truth[0]) * unit);
        EXPECT_NEAR(truth[1] * unit, 2 * motion.alpha, 0.1 * std::abs(truth[1]) * unit);
        EXPECT_NEAR(truth[2] * unit, motion.rollRate, 0.1 * std::abs(truth[2]) * unit);
        EXPECT_LT(motion.expectedResidual, motion.expectedRaw);
        Mat x, y, distance;
        corrector->getMaps(x, y);
        for (int row = 0; row < x.rows; row++)
            for (int column = 0; column < x.cols; column++)
            {
                x.at<float>(row, column) -= float(column);
                y.at<float>(row, column) -= float(row);
            }
        magnitude(x, y, distance);
        EXPECT_NEAR(mean(distance)[0], motion.expectedRaw, 0.1 * motion.expectedRaw);
        EXPECT_GT(motion.pitchRateSigma, 0);
        EXPECT_LT(motion.probabilityWorse, 0.05);
        corrector->correctWithMotion(dark, motion, corrected);
        EXPECT_FALSE(corrector->isGyroUsed());
        // A car that drives displaces what it passes: a turn alone leaves that, and may even add to it.
        prior.speed = 20;
        prior.speedSigma = 0.5;
        corrector->setPrior(prior);
        corrector->reset();
        corrector->setTimestamp(seconds);
        const AckermannMotion driving = corrector->correct(dark, corrected);
        AckermannMotion still = driving;
        for (double* const expected : {&still.expectedRaw, &still.expectedResidual, &still.probabilityWorse})
            *expected = 0;
        AckermannMotion turned = motion;
        for (double* const expected : {&turned.expectedRaw, &turned.expectedResidual, &turned.probabilityWorse})
            *expected = 0;
        expectSame(turned, still);
        EXPECT_GT(driving.expectedResidual, motion.expectedRaw);
        EXPECT_GT(driving.probabilityWorse, 0.2);
        EXPECT_LT(driving.probabilityWorse, 0.5);
        // An image beyond the samples
        corrector->setTimestamp(10);
        EXPECT_NE(MOTION_OK, corrector->correct(dark, corrected).status);
    }
}

// What is known of a gyro stays as it is, and what isn't makes its rates uncertain: each sigma of both.
TEST(RSAckermann_Gyro, is_known_as_well_as_its_sigmas_say)
{
    typedef RollingShutterCorrector::Params Params;
    const ShakingCamera shaking;
    Mat times, rates;
    const Vec3d trueBias(0.01, -0.008, 0.006);
    gyroOf(0.015, trueBias, times, rates);
    double Params::*const sigmas[] = {&Params::gyroDelaySigma, &Params::gyroAxesSigma, &Params::gyroBiasSigma,
                                      &Params::gyroScaleSigma};
    const Mat dark(shaking.camera.imageSize, CV_8U, Scalar(0));
    for (bool sequence : {false, true})
    {
        Params params;
        params.sequence = sequence;
        for (double Params::*const sigma : sigmas)
            params.*sigma = 1e-6;
        for (int i = -1; i < 4; i++)
        {
            SCOPED_TRACE(testing::Message() << sequence << i);
            Params one = params;
            if (i >= 0)
                one.*sigmas[i] = 0.02;
            const Ptr<RollingShutterCorrector> corrector =
                RollingShutterCorrector::create(shaking.camera, i == 1 ? one : params);
            corrector->setParams(one);
            corrector->addGyro(times, rates);
            corrector->setTimestamp(0.1);
            Mat corrected;
            const AckermannMotion motion = corrector->correct(dark, corrected);
            const double unit = shaking.camera.secondsPerUnitTime();
            // Of points' errors there are 0.5 deg/s.
            const double least = 0.5 * CV_PI / 180 * unit;
            if (i < 0)
                EXPECT_NEAR(least, motion.pitchRateSigma, 1e-3 * least);
            else
                EXPECT_GT(motion.pitchRateSigma, 1.001 * least);
        }
    }
    // A bias that isn't possible isn't found, nor a delay.
    for (const bool isKnown : {false, true})
    {
        Params params;
        params.sequence = true;
        if (isKnown)
            params.gyroDelaySigma = params.gyroBiasSigma = 1e-6;
        const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(shaking.camera, params);
        corrector->addGyro(times, rates);
        errorsOf(corrector, shaking, 20, 5);
        double delay;
        Vec3d axes, bias;
        corrector->getGyroAlignment(delay, axes, bias);
        EXPECT_EQ(!isKnown, std::abs(delay - 0.015) < 0.005) << delay;
        EXPECT_EQ(!isKnown, std::abs(bias[0] - trueBias[0]) < 0.007) << bias;
    }
    for (double Params::*const sigma : sigmas)
        for (double bad : {0., -1., std::numeric_limits<double>::quiet_NaN()})
        {
            Params params;
            params.*sigma = bad;
            EXPECT_THROW(params.check(), cv::Exception);
        }
}

}} // namespace
