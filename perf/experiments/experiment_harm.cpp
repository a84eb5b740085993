// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Whether single frames are ever made worse, over what a camera in a car meets: doc/trust.md, "Do no harm".

#include "experiment.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "units.hpp"

#include "opencv2/imgproc.hpp"
#include <cstdio>

using namespace cv::rsackermann;
using namespace experiments;
using namespace rsackermann_samples;

namespace {

const char* const ABOUT =
    "Renders frames of streets at random, with motions, scenes, errors of the camera and bad images each as often as\n"
    "in a drive, corrects each alone, and counts those that are made worse. Prints what was expected to be left\n"
    "against what is left next to edges, and how often the yaw rate is within its standard deviations.\n"
    "The estimator takes half of the cameras to be at rest: --standing=0.5 shows whether it expects the truth of images\n"
    "that it leaves as they are.\n";

const char* const KEYS = "{help       |        | print this message}"
                         "{frames     | 1000   | number of frames}"
                         "{seed       | 0      | of the first frame}"
                         "{standing   | 0.1    | share of the frames of a camera at rest}"
                         "{open       | 0.1    | share of the frames in which the right wall is missing}"
                         "{given      | none   | none, yaw (the yaw rate +- 1 deg/s) or both (and the speed +- 2 km/h)}"
                         "{unknown_camera | | the camera is any, and nothing of it is given}"
                         "{quiet      |        | print the summary only}"
                         "{threads    |        | number of threads}";

//! What happens with one frame.
struct Frame
{
    Case street;
    Experiment experiment;
    double blur; //!< pixels
};

bool happens(double probability, cv::RNG& rng)
{
    return rng.uniform(0., 1.) < probability;
}

// Student's t distribution with two degrees of freedom: mostly straight on, and sometimes a junction.
double randomYawRate(double speed, cv::RNG& rng)
{
    const double scale = 5 * DEGREE, comfort = 4; // m/s^2 to the side
    const double any = scale * rng.gaussian(1) / std::sqrt(-std::log(rng.uniform(1e-9, 1.)));
    const double most = std::min(60 * DEGREE, comfort / std::max(speed, 1.));
    return std::min(std::max(any, -most), most);
}

// As uncertain as the library takes it for if nothing of it is given.
void makeAnyCamera(cv::RNG& rng, Frame& frame)
{
    const double rollSigma = 2 * DEGREE, pitchSigma = 5 * DEGREE;
    street::StreetCamera& camera = frame.street.camera;
    AckermannEstimator::Params& params = frame.experiment.params;
    camera.fx = camera.fy = 0.9 * camera.size.width * std::max(1 + rng.gaussian(0.2), 0.5);
    camera.lineDelay =
        params.priorReadoutTime * std::exp(rng.gaussian(params.priorReadoutTimeLogSigma)) / camera.size.height;
    camera.roll = rng.gaussian(rollSigma);
    camera.pitch = rng.gaussian(pitchSigma);
    frame.experiment.knowledge.camera = false;
    params.gravitySigma = params.vehiclePitchSigma = 1e-4; // beside the mount's
}

//! Of which frames are drawn.
struct Population
{
    double standing, open; //!< shares
    int given;
    bool isCameraKnown;
};

Frame randomFrame(int seed, const Population& population)
{
    cv::RNG rng(seed * 7919u + 1);
    rng.next();
    const double height = rng.uniform(1.2, 1.6), lineDelay = rng.uniform(0.01, 0.035) / 380;
    street::StreetCamera camera(cv::Size(640, 380), 620, lineDelay, height);
    camera.pitch = rng.uniform(-3., 3.) * DEGREE;
    street::StreetScene scene;
    const bool rests = happens(population.standing, rng);
    scene.speed = rests ? 0 : std::min(12 * std::exp(rng.gaussian(0.8)), 40.);
    scene.yawRate = rests ? 0 : randomYawRate(scene.speed, rng);
    scene.wallDirection = rng.gaussian(5 * DEGREE);
    scene.left = happens(0.1, rng) ? 0 : 8 * std::exp(rng.gaussian(0.6));
    scene.right = happens(population.open, rng) ? 0 : 8 * std::exp(rng.gaussian(0.6));
    scene.seed = unsigned(seed);
    scene.clutter = happens(0.05, rng) ? 1 : rng.uniform(0., 0.5);
    scene.stagger = happens(0.5, rng) ? rng.uniform(0., 2.) : 0;
    scene.obstacles = happens(0.5, rng) ? rng.uniform(0., 15.) : 0;
    scene.noise = happens(0.2, rng) ? rng.uniform(5., 15.) : rng.uniform(1., 3.);
    Frame frame = {Case("street", camera, scene), Experiment(), happens(0.2, rng) ? rng.uniform(0.5, 2.) : 0};
    // Suspension and road, within the defaults of the estimator.
    Knowledge& knowledge = frame.experiment.knowledge;
    knowledge.rollNoise = 0.7 * DEGREE;
    knowledge.pitchNoise = 0.3 * DEGREE;
    knowledge.focalNoise = happens(0.3, rng) ? 0.05 : 0;
    knowledge.yawRateSigma = population.given > 0 ? 1 * DEGREE : 0;
    knowledge.speedSigma = population.given > 1 ? 2 * KMH : 0;
    if (!population.isCameraKnown)
        makeAnyCamera(rng, frame);
    return frame;
}

struct Score
{
    double left, expectedResidual;
};

// Frames in the order of what was expected to be left, a tenth of them a line.
void printCalibration(std::vector<Score> scores)
{
    std::sort(scores.begin(), scores.end(),
              [](const Score& a, const Score& b) { return a.expectedResidual < b.expectedResidual; });
    std::printf("\ntenth of the frames | expected to be left, px | left, px | expected / left (next to edges)\n");
    for (size_t i = 0; i < 10; i++)
    {
        std::vector<double> expected, left;
        for (size_t k = i * scores.size() / 10; k < (i + 1) * scores.size() / 10; k++)
        {
            expected.push_back(scores[k].expectedResidual);
            left.push_back(scores[k].left);
        }
        std::printf("%19d | %23.3f | %8.3f | %15.2f\n", int(i + 1), mean(expected), mean(left),
                    mean(expected) / mean(left));
    }
}

void printHarm(const std::vector<Result>& results)
{
    int worse = 0, corrected = 0, known = 0, within2 = 0, within3 = 0;
    double most = 0, expectedWorse = 0;
    std::vector<double> raw, left, expectedOfOthers, others;
    for (const Result& r : results)
    {
        if (r.status == MOTION_NOT_SIGNIFICANT)
        {
            expectedOfOthers.push_back(r.expectedResidual);
            others.push_back(r.seenLeft);
        }
        raw.push_back(r.raw);
        left.push_back(r.left);
        worse += r.left > 1.1 * r.raw && r.left > r.raw + 0.1;
        most = std::max(most, r.left - r.raw);
        corrected += r.status == MOTION_OK;
        expectedWorse += r.status == MOTION_OK ? r.probabilityWorse : 0;
        if (r.status != MOTION_OK || !(r.yawRateSigma > 0))
            continue;
        known++;
        within2 += std::abs(r.yawRateError) <= 2 * r.yawRateSigma;
        within3 += std::abs(r.yawRateError) <= 3 * r.yawRateSigma;
    }
    std::printf("%d frames, %d corrected: raw %.3f px, left %.3f px\n", int(results.size()), corrected, mean(raw),
                mean(left));
    std::printf("made worse by more than 10 %% and 0.1 px: %d (%.1f %%), by at most %.2f px; worse by any amount: %.1f "
                "expected\n",
                worse, 100. * worse / results.size(), most, expectedWorse);
    if (!others.empty())
        std::printf("%d left as they are though they have enough segments: %.3f px expected, %.3f px next to edges\n",
                    int(others.size()), mean(expectedOfOthers), mean(others));
    if (known > 0)
        std::printf("yaw rate within 2 sigma in %.1f %%, within 3 sigma in %.1f %% of %d\n", 100. * within2 / known,
                    100. * within3 / known, known);
}

int run(const Options& options)
{
    if (options.given("threads"))
        cv::setNumThreads(options.integer("threads", 1, 1024));
    const int frames = options.integer("frames", 10, 1000000), first = options.integer("seed", 0, 1 << 30);
    const Population population = {options.number("standing", 0, 1), options.number("open", 0, 1),
                                   options.choice("given", {"none", "yaw", "both"}), !options.flag("unknown_camera")};
    if (population.given > 0 && !population.isCameraKnown)
        throw UsageError("--given needs the line delay, which --unknown_camera leaves out");
    std::vector<Result> results;
    std::vector<Score> scores;
    Progress progress;
    for (int i = 0; i < frames; i++)
    {
        const Frame frame = randomFrame(first + i, population);
        cv::Mat image = makeImage(frame.street);
        if (frame.blur > 0)
            cv::GaussianBlur(image, image, cv::Size(), frame.blur);
        results.push_back(evaluate(frame.street, image, frame.experiment, unsigned(first + i)));
        const Result& r = results.back();
        const Score score = {r.seenLeft, r.expectedResidual};
        if (r.status == MOTION_OK)
            scores.push_back(score);
        if (!options.flag("quiet"))
        {
            const street::StreetScene& s = frame.street.scene;
            std::printf(
                "%d: %.0f km/h, %.0f deg/s, walls %.1f %.1f m, houses back by %.1f m, clutter %.2f, obstacles %.0f, "
                "noise %.0f, blur %.1f; status %d "
                "candidates %d raw %.3f left %.3f expected %.3f yaw rate error %.2f sigma %.2f\n",
                first + i, s.speed / KMH, s.yawRate / DEGREE, s.left, s.right, s.stagger, s.clutter, s.obstacles,
                s.noise, frame.blur, r.status, r.candidates, r.raw, r.left, r.expectedResidual, r.yawRateError,
                r.yawRateSigma);
        }
        progress.update(i + 1, frames, "frames");
    }
    progress.clear();
    printHarm(results);
    printCalibration(scores);
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, KEYS, run, argc, argv);
}
