// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Mount and line delay from simulated drives, with and without a log: doc/results.md, "Self-calibration".

#include "opencv2/core.hpp"

namespace opencv_test {
using namespace cv; // as opencv_ts has it
}

#include "options.hpp"
#include "progress.hpp"
#include "test_drive_simulator.hpp"
#include "units.hpp"

#include <cstdio>

namespace {

using namespace rsackermann_samples;
using namespace cv::rsackermann;
using opencv_test::simulation::StreetDrive;

const char* const KEYS =
    "{help     |      | print this message}"
    "{drives   | 50   | number of drives}"
    "{frames   | 300  | of each drive, 30 in a second}"
    "{yaw_rate | 12   | standard deviation of the yaw rate, deg/s}"
    "{tilt     | 0.25 | standard deviation of roll and pitch of the suspension, degrees}"
    "{seed     | 0    | of the first drive}";

const char* const NAMES[] = {"roll, deg", "pitch, deg", "heading, deg", "line delay, %"};
const double ROLL = 1.2 * DEGREE, PITCH = -0.8 * DEGREE, HEADING = 1.5 * DEGREE, DELAY_ERROR = 0.3;

struct Errors
{
    std::vector<double> error, sigma; //!< absolute errors
    int told;

    Errors() : told(0) {}

    void add(double e, double s, bool isObserved)
    {
        error.push_back(std::abs(e));
        sigma.push_back(s);
        told += isObserved;
    }
};

double quantile(std::vector<double> values, double fraction)
{
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1, size_t(fraction * double(values.size())))];
}

void print(const char* title, const Errors errors[4])
{
    for (int i = 0; i < 4; i++)
    {
        const Errors& e = errors[i];
        int within = 0;
        for (size_t k = 0; k < e.error.size(); k++)
            within += e.error[k] <= 2 * e.sigma[k];
        std::printf("| %s | %s | %.3f | %.3f | %.3f | %.3f | %.0f | %d |\n", title, NAMES[i], quantile(e.error, 0.5), quantile(e.error, 0.9),
                    quantile(e.error, 1), quantile(e.sigma, 0.5), 100. * within / double(e.error.size()), e.told);
    }
}

// Simulates a drive and adds the errors of its calibrations, with a log and without.
void calibrate(int seed, int frames, const StreetDrive::Options& options, Errors errors[2][4])
{
    RollingShutterCamera guess(cv::Size(960, 540), cv::Matx33d(700, 0, 479.5, 0, 700, 269.5, 0, 0, 1));
    guess.height = 1.4;
    guess.lineDelay = 0.02 / 540;
    RollingShutterCamera truth = guess;
    truth.heading = HEADING;
    truth.lineDelay *= seed % 2 ? 1 + DELAY_ERROR : 1 - DELAY_ERROR;
    StreetDrive drive(truth, ROLL, PITCH, options, seed);
    cv::RNG rng(seed);
    const cv::Ptr<MountCalibrator> calibrators[] = {MountCalibrator::create(guess), MountCalibrator::create(guess)};
    for (int i = 0; i < frames; i++)
    {
        const StreetDrive::Frame f = drive.frame(i / 30., 1 / 30.);
        MotionPrior log;
        log.yawRateSigma = 0.5 * DEGREE;
        log.yawRate = f.yawRate + rng.gaussian(log.yawRateSigma);
        log.speedSigma = 1 * KMH;
        log.speed = f.speed + rng.gaussian(log.speedSigma);
        calibrators[0]->addPoints(f.points, f.segments, f.seconds, log);
        calibrators[1]->addPoints(f.points, f.segments, f.seconds);
    }
    for (int l = 0; l < 2; l++)
    {
        const MountCalibration c = calibrators[l]->calibrate();
        errors[l][0].add((c.roll - ROLL) / DEGREE, c.rollSigma / DEGREE, c.rollObserved);
        errors[l][1].add((c.pitch - PITCH) / DEGREE, c.pitchSigma / DEGREE, c.pitchObserved);
        errors[l][2].add((c.heading - HEADING) / DEGREE, c.headingSigma / DEGREE, c.headingObserved);
        errors[l][3].add(100 * (c.lineDelay / truth.lineDelay - 1), 100 * c.lineDelaySigma / truth.lineDelay, c.lineDelayObserved);
    }
}

int run(int argc, const char* const* argv)
{
    Options arguments(argc, argv, KEYS);
    if (arguments.given("help"))
    {
        arguments.printHelp("Finds mount and line delay from simulated drives and compares them with the truth.\n");
        return 0;
    }
    StreetDrive::Options options;
    options.yawRate = arguments.number("yaw_rate", 0, 90) * DEGREE;
    options.tilt = arguments.number("tilt", 0, 5) * DEGREE;
    const int drives = arguments.integer("drives", 1, 10000), frames = arguments.integer("frames", 2, 100000), seed = arguments.integer("seed", 0, 1 << 30);
    Errors errors[2][4];
    Progress progress;
    for (int i = 0; i < drives; i++)
    {
        calibrate(seed + i, frames, options, errors);
        progress.update(i + 1, drives, "drives");
    }
    progress.clear();
    std::printf("| told | value | median error | 90 %% | largest | median sigma | within 2 sigma, %% | told by the drive |\n|---|---|---|---|---|---|---|---|\n");
    print("log", errors[0]);
    print("nothing", errors[1]);
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(run, argc, argv);
}
