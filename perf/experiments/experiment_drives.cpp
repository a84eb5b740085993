// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "drive.hpp"
#include "experiment.hpp"
#include "map_distance.hpp"
#include "options.hpp"
#include "table.hpp"

#include "opencv2/imgcodecs.hpp"
#include <cstdio>

using namespace cv::rsackermann;
using namespace experiments;
using namespace rsackermann_samples;

namespace {

const char* const ABOUT =
    "Measures the correction of single frames of real drives against the optical flow to the next frame, and what\n"
    "becomes of frames of global-shutter cameras, of which every motion is false.\n"
    "usage: rsackermann_experiment_drives [FOLDER...] [--option=value]...\n"
    "FOLDER has consecutive frames and frames.csv (calibration, time to the next frame, speed and yaw rate).\n";

const char* const KEYS =
    "{help       |        | print this message}"
    "{controls   |        | folder with frames of global-shutter cameras and frames.csv "
    "(file,width,fx,pitch_deg,roll_deg,heading_deg)}"
    "{given      | none   | what the estimator is given of the drives: none, yaw_rate, speed or both}"
    "{gravity_sigma |     | degrees, in the place of the default}"
    "{drive      |        | a folder is one drive: each frame with what those before say}"
    "{smooth     |        | the same, and what the next frame says}"
    "{every      | 3      | measure every N-th frame}"
    "{quiet      |        | print the summary only}"
    "{threads    |        | number of threads}";

const double DEGREE = CV_PI / 180;

struct Outcome
{
    std::string name;
    AckermannMotion motion;
    double raw, left;      // pixels
    double yawRate, sigma; // deg/s
    double yawRateError;   // deg/s
    double deviation;      // of the yaw rate in standard deviations, with those of the log
};

cv::Mat readImage(const std::string& file)
{
    const cv::Mat image = cv::imread(file);
    if (image.empty())
        throw InputError(file + " can't be read");
    return image;
}

AckermannMotion estimateAndMap(const cv::Mat& image, const RollingShutterCamera& camera,
                               const AckermannEstimator::Params& params, const MotionPrior& prior, cv::Mat maps[2])
{
    const AckermannMotion motion =
        AckermannEstimator::create(camera, params)->estimateFromImage(image, cv::noArray(), cv::noArray(), prior);
    WarpMapGenerator::create(camera)->initRectifyMap(motion, maps[0], maps[1]);
    return motion;
}

void addYawRate(const RollingShutterCamera& camera, double truth, double truthSigma, Outcome& outcome)
{
    double yawRate = 0;
    outcome.motion.yawRate(camera, yawRate);
    const double variance = outcome.motion.metricCovariance(camera)(0, 0);
    outcome.yawRate = yawRate / DEGREE;
    outcome.sigma = std::sqrt(variance) / DEGREE;
    outcome.yawRateError = std::abs(yawRate - truth) / DEGREE;
    outcome.deviation = variance > 0 ? std::abs(yawRate - truth) / std::hypot(std::sqrt(variance), truthSigma) : 0;
}

// The motion with its maps against the flow to the next frame.
Outcome measureFrame(const DriveFrame& frame, const AckermannMotion& motion, const cv::Mat maps[2],
                     const FlowTruth& truth)
{
    Outcome o;
    o.name = frame.file;
    o.motion = motion;
    truth.measure(maps[0], maps[1], o.raw, o.left);
    // The log's own errors: 0.6 deg/s and 15 %.
    addYawRate(frame.camera, frame.yawRate, 0.6 * DEGREE + 0.15 * std::abs(frame.yawRate), o);
    return o;
}

// All frames in their order, by one corrector; every N-th is measured.
std::vector<Outcome> measureWholeDrive(const std::string& folder, int given, int every, bool smooth,
                                       const AckermannEstimator::Params& params)
{
    const std::vector<DriveFrame> frames = readDrive(folder);
    RollingShutterCorrector::Params all;
    all.estimator = params;
    all.sequence = true;
    const cv::Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(frames[0].camera, all);
    std::vector<Outcome> outcomes;
    double time = 0;
    for (size_t i = 0; i + 1 < frames.size(); i++)
    {
        const cv::Mat image = readImage(frames[i].file);
        cv::Mat corrected, maps[2];
        corrector->setTimestamp(time);
        corrector->setPrior(priorOf(frames[i], given));
        // The second frame says what the first one can't say alone.
        if (i == 0 || smooth)
            corrector->setNextFrame(readImage(frames[i + 1].file), time + frames[i].secondsToNext);
        const AckermannMotion motion = corrector->correct(image, corrected);
        time += frames[i].secondsToNext;
        if (i % every != 0)
            continue;
        corrector->getMaps(maps[0], maps[1]);
        outcomes.push_back(
            measureFrame(frames[i], motion, maps, FlowTruth(frames[i], image, readImage(frames[i + 1].file))));
    }
    return outcomes;
}

std::vector<Outcome> measureDrive(const std::string& folder, int given, int every,
                                  const AckermannEstimator::Params& params)
{
    const std::vector<DriveFrame> frames = readDrive(folder);
    std::vector<Outcome> outcomes((frames.size() - 1 + every - 1) / every);
    cv::parallel_for_(
        cv::Range(0, int(outcomes.size())),
        [&](const cv::Range& range) {
            for (int k = range.start; k < range.end; k++)
            {
                const DriveFrame& frame = frames[k * every];
                const cv::Mat image = readImage(frame.file);
                const FlowTruth truth(frame, image, readImage(frames[k * every + 1].file));
                cv::Mat maps[2];
                const AckermannMotion motion = estimateAndMap(image, frame.camera, params, priorOf(frame, given), maps);
                outcomes[k] = measureFrame(frame, motion, maps, truth);
            }
        },
        double(outcomes.size()));
    return outcomes;
}

// Pixels are counted for a width of 1000.
std::vector<Outcome> measureControls(const std::string& folder, const AckermannEstimator::Params& params)
{
    const double readOut = 0.03; // seconds, as the estimator is given
    std::vector<Outcome> outcomes;
    for (const std::vector<std::string>& row :
         readTable(folder + "/frames.csv", {"file", "width", "fx", "pitch_deg", "roll_deg", "heading_deg"}))
    {
        const cv::Mat image = readImage(folder + "/" + row[0]);
        RollingShutterCamera camera = RollingShutterCamera::fromFocal(image.size(), parseNumber(row[2], "frames.csv"));
        double angles[3];
        for (int i = 0; i < 3; i++)
            angles[i] = row[3 + i].empty() ? 0 : parseNumber(row[3 + i], "frames.csv") * DEGREE;
        camera.setRollPitch(angles[1], angles[0]);
        camera.heading = angles[2];
        camera.lineDelay = readOut / image.rows;
        cv::Mat maps[2], identity[2];
        Outcome o;
        o.name = row[0];
        o.motion = estimateAndMap(image, camera, params, MotionPrior(), maps);
        identityMaps(image.size(), identity[0], identity[1]);
        o.raw = 0;
        o.left = 1000. / image.cols * meanDistance(maps[0], maps[1], identity[0], identity[1], maps[0] > -1e3);
        addYawRate(camera, 0, 0, o);
        outcomes.push_back(o);
    }
    return outcomes;
}

void printOutcomes(const std::vector<Outcome>& outcomes)
{
    for (const Outcome& o : outcomes)
        std::printf(
            "%-40s raw %6.2f left %6.2f expected %6.2f yaw rate %7.2f +- %6.2f error %6.2f status %d model %d\n",
            o.name.substr(o.name.size() > 40 ? o.name.size() - 40 : 0).c_str(), o.raw, o.left,
            o.motion.expectedResidual, o.yawRate, o.sigma, o.yawRateError, o.motion.status, o.motion.model);
}

double percentBeyond(const std::vector<Outcome>& outcomes, double sigmas)
{
    int beyond = 0;
    for (const Outcome& o : outcomes)
        beyond += o.deviation > sigmas;
    return 100. * beyond / outcomes.size();
}

void summariseDrives(const char* name, const std::vector<Outcome>& outcomes)
{
    std::vector<double> raw, left, yawRate;
    double worst = 0;
    int worse = 0;
    for (const Outcome& o : outcomes)
    {
        raw.push_back(o.raw);
        left.push_back(o.left);
        yawRate.push_back(o.yawRateError);
        worse += o.left > 1.1 * o.raw && o.left > o.raw + 0.2;
        worst = std::max(worst, o.left / std::max(o.raw, 0.3));
    }
    std::printf(
        "%-32s n %3d raw %.2f left %.2f ratio %.3f worse %.1f %% worst ratio %.2f yaw rate %.2f beyond 2 sigma %.1f %% "
        "3 sigma %.1f %%\n",
        name, int(outcomes.size()), quantile(raw, 0.5), quantile(left, 0.5), mean(left) / mean(raw),
        100. * worse / outcomes.size(), worst, quantile(yawRate, 0.5), percentBeyond(outcomes, 2),
        percentBeyond(outcomes, 3));
}

void summariseControls(const std::vector<Outcome>& outcomes)
{
    double largest = 0, sum = 0;
    int changed = 0;
    for (const Outcome& o : outcomes)
    {
        changed += o.left > 0.5;
        largest = std::max(largest, o.left);
        sum += o.left;
    }
    std::printf("controls n %d changed %.1f %% largest %.2f mean %.2f beyond 3 sigma %.1f %%\n", int(outcomes.size()),
                100. * changed / outcomes.size(), largest, sum / outcomes.size(), percentBeyond(outcomes, 3));
}

int run(const Options& options)
{
    if (options.given("threads"))
        cv::setNumThreads(options.integer("threads", 1, 1024));
    AckermannEstimator::Params params;
    if (options.given("gravity_sigma"))
        setGravitySigma(options.number("gravity_sigma", 0, 45) * DEGREE, params);
    const int given = options.choice("given", {"none", "yaw_rate", "speed", "both"}),
              every = options.integer("every", 1, 1000000);
    const bool smooth = options.flag("smooth"), isDrive = smooth || options.flag("drive");
    const bool quiet = options.flag("quiet");
    std::vector<Outcome> all;
    for (const std::string& folder : options.arguments())
    {
        const std::vector<Outcome> part = isDrive ? measureWholeDrive(folder, given, every, smooth, params)
                                                  : measureDrive(folder, given, every, params);
        if (!quiet)
            printOutcomes(part);
        summariseDrives(folder.substr(folder.find_last_of('/') + 1).c_str(), part);
        all.insert(all.end(), part.begin(), part.end());
    }
    if (!all.empty())
        summariseDrives("all", all);
    if (options.given("controls"))
    {
        const std::vector<Outcome> controls = measureControls(options.text("controls"), params);
        if (!quiet)
            printOutcomes(controls);
        summariseControls(controls);
    }
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, KEYS, run, argc, argv);
}
