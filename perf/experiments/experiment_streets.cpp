// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "cases.hpp"
#include "estimator_options.hpp"
#include "summary.hpp"

#include "opencv2/imgcodecs.hpp"

using namespace cv::rsackermann;
using namespace experiments;
using namespace rsackermann_samples;

namespace {

const char* const ABOUT =
    "Measures the estimator on rendered streets, or on photographs with simulated motion: displacement\n"
    "left after the correction and errors of the motion, a line for each case and a summary.\n";

const char* const KEYS =
    "{help       |        | print this message}"
    "{gravity_noise | 0   | standard deviation of the errors of the roll and the pitch that the estimator is given, "
    "degrees}"
    "{gravity_sigma |     | what the estimator is given of these errors, degrees (default: the truth, or the "
    "estimator's default if there are none)}"
    "{usual_yaw_rate |    | deg/s, how fast the estimator takes cars to turn usually (default: its own)}"
    "{speed_sigma | 0     | km/h; the estimator is given the speed with errors of this standard deviation; 0: it isn't "
    "given}"
    "{yaw_rate_sigma | 0  | deg/s; the same for the yaw rate}"
    "{wall_direction_sigma | 0 | degrees; the same for the direction of the walls}"
    "{exact_priors |      | these values are given without errors, but with their standard deviations}"
    "{focal_error | 0     | of the focal length that the estimator is given, percent}"
    "{focal_noise | 0    | standard deviation of further errors of it, of a size that the estimator is given, percent}"
    "{wall_factor |       | given over true distance of the wall, which is then known to 10 percent (default: exact)}"
    "{model      | auto   | auto, 4la, 3la, 1la or none}"
    "{only_verticals |    | the estimator gets no segments but those that may be vertical}"
    "{exact_segments |    | segments of the global-shutter image, moved by the true motion, in the place of detected "
    "ones}"
    "{floor      | 0      | number of motions drawn from the covariance of each estimate to predict the displacement "
    "left}"
    "{quiet      |        | print the summary only}"
    "{save       |        | folder for the rolling-shutter images}"
    "{threads    |        | number of threads}";

const double DEGREE = CV_PI / 180, KMH = 1 / 3.6;

Experiment makeExperiment(const Options& options, const std::vector<Case>& cases)
{
    Experiment experiment;
    Knowledge& knowledge = experiment.knowledge;
    knowledge.rollNoise = knowledge.pitchNoise = options.number("gravity_noise", 0, 45) * DEGREE;
    knowledge.speedSigma = options.number("speed_sigma", 0, 1000) * KMH;
    knowledge.yawRateSigma = options.number("yaw_rate_sigma", 0, 1000) * DEGREE;
    knowledge.wallDirectionSigma = options.number("wall_direction_sigma", 0, 90) * DEGREE;
    knowledge.exactPriors = options.flag("exact_priors");
    knowledge.focalError = options.number("focal_error", -90, 1000) / 100;
    knowledge.focalNoise = options.number("focal_noise", 0, 50) / 100;
    AckermannEstimator::Params& params = experiment.params;
    params.model = readModel(options);
    params.detector = readDetector(options);
    if (!cases.empty())
    {
        params.wallDistance = cases[0].scene.left > 0 ? cases[0].scene.left : cases[0].scene.right;
        if (options.given("wall_factor"))
            params.wallDistance *= options.positive("wall_factor", 100);
        else
            params.wallDistanceLogSigma = 0; // they are plane
    }
    if (options.given("gravity_sigma"))
        setGravitySigma(options.number("gravity_sigma", 0, 45) * DEGREE, params);
    else if (knowledge.rollNoise > 0)
        setGravitySigma(knowledge.rollNoise, params);
    if (options.given("usual_yaw_rate"))
        params.priorYawRate = options.positive("usual_yaw_rate", 1e4) * DEGREE;
    experiment.segments.verticalsOnly = options.flag("only_verticals");
    experiment.segments.exact = options.flag("exact_segments");
    experiment.floorSamples = options.integer("floor", 0, 1000);
    return experiment;
}

int run(const Options& options)
{
    options.refuseArguments();
    if (options.given("threads"))
        cv::setNumThreads(options.integer("threads", 1, 1024));
    const std::vector<Case> cases = makeCases(options);

    const Experiment experiment = makeExperiment(options, cases);
    const unsigned seed = unsigned(options.integer("seed", 0, 1 << 20));
    const std::string save = options.given("save") ? options.text("save") + "/" : "";

    std::vector<Result> results(cases.size());
    cv::parallel_for_(
        cv::Range(0, int(cases.size())),
        [&](const cv::Range& range) {
            for (int i = range.start; i < range.end; i++)
            {
                const cv::Mat image = makeImage(cases[i]);
                if (!save.empty())
                    cv::imwrite(save + cv::format("%03d_", i) + cases[i].name + ".png", image);
                results[i] = evaluate(cases[i], image, experiment, seed + unsigned(i));
            }
        },
        double(cases.size()));

    if (!options.flag("quiet"))
        printCases(cases, results);
    printSummary(results);
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, std::string(KEYS) + DETECTOR_KEY + CASE_KEYS, run, argc, argv);
}
