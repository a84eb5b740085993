// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Mount and line delay from simulated or rendered drives, with and without a log: doc/results.md, "Self-calibration".

#include "opencv2/core.hpp"
#include "opencv2/rsackermann/calibration.hpp"

namespace opencv_test {
using namespace cv; // as opencv_ts has it
}

#include "options.hpp"
#include "progress.hpp"
#include "rendered_drive.hpp"
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
    "{tilt     | 0.1  | standard deviation of roll and pitch of the suspension, degrees}"
    "{memory   | 0    | seconds after which a tilt of the suspension is forgotten; 0: a rough road shakes it}"
    "{shake    | 0    | deg/s, standard deviation of the rates at which an arm shakes the camera instead}"
    "{hertz    | 7    | about which it does}"
    "{rendered |      | rendered images of a car that weaves through a street instead of simulated points and segments}"
    "{width    | 640  | of rendered images, pixels}"
    "{clutter  | 0.2  | share of slanted lines in the rendered street}"
    "{stagger  | 1.5  | metres by which rendered houses stand back}"
    "{seed     | 0    | of the first drive}";

const char* const NAMES[] = {"roll, deg", "pitch, deg", "heading, deg", "line delay, %"};
const double ROLL = 1.2 * DEGREE, PITCH = -0.8 * DEGREE, HEADING = 1.5 * DEGREE, DELAY_ERROR = 0.3;

struct Errors
{
    std::vector<double> error, sigma; //!< absolute errors
    int observed;

    Errors() : observed(0) {}

    void add(double e, double s, bool isObserved)
    {
        error.push_back(std::abs(e));
        sigma.push_back(s);
        observed += isObserved;
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
        std::printf("| %s | %s | %.3f | %.3f | %.3f | %.3f | %.0f | %d |\n", title, NAMES[i], quantile(e.error, 0.5),
                    quantile(e.error, 0.9), quantile(e.error, 1), quantile(e.sigma, 0.5),
                    100. * within / double(e.error.size()), e.observed);
    }
}

// Calibrates with a log and without.
class Contest
{
public:
    //! @param delay seconds for a line. @param scale_ by which the true one is larger.
    Contest(const cv::Size& size, double focal, double delay, double height, double scale_, int seed)
        : guess(RollingShutterCamera::fromFocal(size, focal)), scale(scale_), rng(seed)
    {
        guess.height = height;
        guess.lineDelay = delay;
        for (cv::Ptr<MountCalibrator>& c : calibrators)
            c = MountCalibrator::create(guess);
    }

    //! @param addFrame of a calibrator and what it is given.
    template <class AddFrame>
    void add(double yawRate, double speed, const AddFrame& addFrame)
    {
        MotionPrior log;
        log.yawRateSigma = 0.5 * DEGREE;
        log.yawRate = yawRate + rng.gaussian(log.yawRateSigma);
        log.speedSigma = 1 * KMH;
        log.speed = speed + rng.gaussian(log.speedSigma);
        addFrame(*calibrators[0], log);
        addFrame(*calibrators[1], MotionPrior());
    }

    void addErrors(Errors errors[2][4]) const
    {
        for (int l = 0; l < 2; l++)
        {
            const MountCalibration c = calibrators[l]->calibrate();
            const double delay = scale * guess.lineDelay;
            errors[l][0].add((c.roll - ROLL) / DEGREE, c.rollSigma / DEGREE, c.rollObserved);
            errors[l][1].add((c.pitch - PITCH) / DEGREE, c.pitchSigma / DEGREE, c.pitchObserved);
            errors[l][2].add((c.heading - HEADING) / DEGREE, c.headingSigma / DEGREE, c.headingObserved);
            errors[l][3].add(100 * (c.lineDelay / delay - 1), 100 * c.lineDelaySigma / delay, c.lineDelayObserved);
        }
    }

    const RollingShutterCamera& camera() const { return guess; }

private:
    RollingShutterCamera guess;
    double scale;
    cv::RNG rng;
    cv::Ptr<MountCalibrator> calibrators[2];
};

double delayScale(int seed)
{
    return seed % 2 ? 1 + DELAY_ERROR : 1 - DELAY_ERROR;
}

void simulate(int seed, int frames, const StreetDrive::Options& options, Errors errors[2][4])
{
    Contest contest(cv::Size(960, 540), 700, 0.02 / 540, 1.4, delayScale(seed), seed);
    RollingShutterCamera truth = contest.camera();
    truth.heading = HEADING;
    truth.lineDelay *= delayScale(seed);
    StreetDrive drive(truth, ROLL, PITCH, options, seed);
    for (int i = 0; i < frames; i++)
    {
        const StreetDrive::Frame f = drive.frame(i / 30., 1 / 30.);
        contest.add(f.yawRate, f.speed, [&](MountCalibrator& calibrator, const MotionPrior& log) {
            calibrator.addPoints(f.points, f.segments, f.seconds, log);
        });
    }
    contest.addErrors(errors);
}

void render(int seed, int frames, int width, const StreetDrive::Options& options, street::StreetScene scene,
            Errors errors[2][4])
{
    const cv::Size size(width, width * 19 / 32);
    const double focal = width * 31. / 32;
    Contest contest(size, focal, 0.025 / size.height, 1.3, delayScale(seed), seed);
    street::StreetCamera camera(size, focal, delayScale(seed) * contest.camera().lineDelay, 1.3);
    camera.roll = ROLL;
    camera.pitch = PITCH;
    camera.heading = HEADING;
    scene.seed = unsigned(seed);
    scene.speed = 12;
    scene.yawRate = 10 * CV_PI / 180;
    scene.left = 6;
    scene.right = 11;
    street::RenderedDrive drive(camera, scene);
    drive.course = street::RenderedDrive::WEAVING;
    drive.phase = seed;
    cv::RNG rng(seed);
    for (opencv_test::simulation::Sway& sway : drive.sway)
        sway = options.sway(options.tilt, rng);
    for (int i = 0; i < frames; i++)
    {
        const cv::Mat image = drive.next().rollingShutter(2, street::StreetRenderer::STAGGERED);
        contest.add(drive.yawRate(), drive.speed(), [&](MountCalibrator& calibrator, const MotionPrior& log) {
            calibrator.addFrame(image, drive.seconds(), log);
        });
    }
    contest.addErrors(errors);
}

int run(const Options& arguments)
{
    StreetDrive::Options options;
    options.yawRate = arguments.number("yaw_rate", 0, 90) * DEGREE;
    options.tilt = arguments.number("tilt", 0, 5) * DEGREE;
    const double memory = arguments.number("memory", 0, 60);
    options.sway = opencv_test::simulation::onSprings;
    if (memory > 0)
        options.sway = [memory](double size, cv::RNG& rng) {
            return opencv_test::simulation::wandering(size, memory, rng);
        };
    const double shake = arguments.number("shake", 0, 100) * DEGREE, hertz = arguments.number("hertz", 1, 100);
    if (shake > 0)
    {
        options.rowsTurn = true;
        options.tilt = shake / (2 * CV_PI * hertz);
        options.yawTilt = 0.4 * options.tilt;
        options.sway = [hertz](double size, cv::RNG& rng) { return opencv_test::simulation::onArm(size, hertz, rng); };
    }
    const int drives = arguments.integer("drives", 1, 10000), frames = arguments.integer("frames", 2, 100000),
              seed = arguments.integer("seed", 0, 1 << 30), width = arguments.integer("width", 320, 4096);
    const bool rendered = arguments.flag("rendered");
    street::StreetScene scene;
    scene.clutter = arguments.number("clutter", 0, 1);
    scene.stagger = arguments.number("stagger", 0, 10);
    Errors errors[2][4];
    Progress progress;
    for (int i = 0; i < drives; i++)
    {
        if (rendered)
            render(seed + i, frames, width, options, scene, errors);
        else
            simulate(seed + i, frames, options, errors);
        progress.update(i + 1, drives, "drives");
    }
    progress.clear();
    std::printf("| given | value | median error | 90 %% | largest | median sigma | within 2 sigma, %% | observable |\n"
                "|---|---|---|---|---|---|---|---|\n");
    print("log", errors[0]);
    print("nothing", errors[1]);
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(
        "Finds mount and line delay from simulated or rendered drives and compares them with the truth.\n", KEYS, run,
        argc, argv);
}
