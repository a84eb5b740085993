// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "experiment.hpp"
#include "options.hpp"

#include "opencv2/imgcodecs.hpp"
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

using namespace cv::rsackermann;
using namespace experiments;
using namespace rsackermann_samples;

namespace {

const char* const ABOUT = "Measures the estimator on rendered streets, or on photographs with simulated motion: displacement\n"
                          "left after the correction and errors of the motion, a line for each case and a summary.\n";

const char* const KEYS =
    "{help       |        | print this message}"
    "{photos     |        | folder with frames.csv (name,focal_px,roll_deg,pitch_deg,line_at_infinity_px) and global-shutter photographs "
    "of streets, to be used instead of renderings}"
    "{rest       |        | the car is at rest}"
    "{scenes     | 3      | number of rendered streets}"
    "{seed       | 0      | of the first rendered street and of the errors of gravity}"
    "{speeds     |        | km/h, with commas between (default 10,53,97,140; with photographs 40,100)}"
    "{yaw_rates  |        | deg/s, with commas between (default 10,-30,50,-70; with photographs 30,-50)}"
    "{roll       | 0      | of the rendered camera, degrees}"
    "{pitch      | 0      | of the rendered camera, degrees}"
    "{direction  | 0      | of the rendered street and the car's motion, degrees to the right of the optical axis}"
    "{clutter    | 0      | share of slanted lines in the rendered streets, 0..1}"
    "{noise      | 1      | of the rendered images, grey levels}"
    "{gravity_noise | 0   | standard deviation of the errors of the roll and the pitch that the estimator is told, degrees}"
    "{gravity_sigma |     | what the estimator is told of these errors, degrees (default: the truth, or the estimator's default "
    "where there are none)}"
    "{speed_sigma | 0     | km/h; the estimator is told the speed with errors of this standard deviation; 0: it isn't told}"
    "{yaw_rate_sigma | 0  | deg/s; the same for the yaw rate}"
    "{focal_error | 0     | of the focal length that the estimator is told, percent}"
    "{model      | auto   | auto, 4la, 3la, 1la or none}"
    "{detector   | lsd    | lsd, fld or edlines}"
    "{quiet      |        | print the summary only}"
    "{save       |        | folder for the rolling-shutter images}"
    "{threads    |        | number of threads}";

const double DEGREE = CV_PI / 180, KMH = 1 / 3.6;
const double READ_OUT = 0.4 / 30; // seconds: 40 % of the time between two frames at 30 frames/s

std::vector<double> numbersOr(const Options& options, const std::string& name, const std::vector<double>& otherwise)
{
    return options.given(name) ? options.numbers(name) : otherwise;
}

std::vector<street::StreetScene> makeMotions(const Options& options, const std::vector<double>& speeds,
                                             const std::vector<double>& yawRates)
{
    std::vector<street::StreetScene> motions;
    if (options.flag("rest"))
        return std::vector<street::StreetScene>(1);
    for (double speed : numbersOr(options, "speeds", speeds))
        for (double yawRate : numbersOr(options, "yaw_rates", yawRates))
        {
            street::StreetScene scene;
            scene.speed = speed * KMH;
            scene.yawRate = yawRate * DEGREE;
            motions.push_back(scene);
        }
    return motions;
}

// The paper's camera and street.
std::vector<Case> renderedCases(const Options& options)
{
    street::StreetCamera camera(cv::Size(640, 380), 816, READ_OUT / 380, 1.2);
    camera.roll = options.number("roll") * DEGREE;
    camera.pitch = options.number("pitch") * DEGREE;
    camera.heading = options.number("direction") * DEGREE;
    const int first = options.integer("seed", 0, 1 << 20), count = options.integer("scenes", 1, 10000);
    std::vector<Case> cases;
    for (int i = 0; i < count; i++)
        for (street::StreetScene scene : makeMotions(options, {10, 53, 97, 140}, {10, -30, 50, -70}))
        {
            scene.wallDirection = camera.heading;
            scene.seed = unsigned(first + i);
            scene.clutter = options.number("clutter", 0, 1);
            scene.noise = options.number("noise", 0, 100);
            cases.push_back(Case(cv::format("street_%d", first + i), camera, scene));
        }
    return cases;
}

// A line of comma-separated values; empty at the end.
std::vector<std::string> readFields(std::istream& file)
{
    std::string line;
    std::getline(file, line);
    if (!line.empty() && line.back() == '\r')
        line.pop_back();
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');)
        fields.push_back(field);
    return fields;
}

// Walls at 2.5 m and 3 m, camera at 1.6 m, the car follows the street.
std::vector<Case> photoCases(const Options& options)
{
    const std::string folder = options.text("photos") + "/";
    std::ifstream list((folder + "frames.csv").c_str());
    static const std::vector<std::string> columns = {"name", "focal_px", "roll_deg", "pitch_deg", "line_at_infinity_px"};
    if (readFields(list) != columns)
        throw InputError(folder + "frames.csv can't be read or has other columns than name,focal_px,roll_deg,pitch_deg,"
                                  "line_at_infinity_px");
    std::vector<Case> cases;
    for (std::vector<std::string> fields = readFields(list); !fields.empty(); fields = readFields(list))
    {
        if (fields.size() != columns.size())
            throw InputError(folder + "frames.csv: a line hasn't five columns");
        const cv::Mat photo = cv::imread(folder + fields[0]);
        if (photo.empty())
            throw InputError(folder + fields[0] + " can't be read");
        double values[4];
        for (int i = 0; i < 4; i++)
            values[i] = parseNumber(fields[i + 1], "frames.csv");
        street::StreetCamera camera(photo.size(), values[0], READ_OUT / photo.rows, 1.6);
        camera.roll = values[1] * DEGREE;
        camera.pitch = values[2] * DEGREE;
        camera.heading = std::atan(values[3] / values[0]);
        for (street::StreetScene scene : makeMotions(options, {40, 100}, {30, -50}))
        {
            scene.wallDirection = camera.heading;
            Case c(fields[0], camera, scene);
            c.photo = photo;
            cases.push_back(c);
        }
    }
    return cases;
}

void printCase(const Case& c, const Result& r)
{
    static const char* const statuses[] = {"ok", "not_significant", "too_few_segments", "no_consensus", "not_observable"};
    std::printf("%s\t%.0f\t%.0f\t%s\t%d\t%d\t%d\t%.3f\t%.3f\t%.2f\t%.2f\t%.2f\t%.2f\t%.1f\n", c.name.c_str(), c.scene.speed / KMH,
                c.scene.yawRate / DEGREE, statuses[r.status], r.model, r.candidates, r.inliers, r.raw, r.left, r.yawRateError, r.yawRateSigma,
                r.speedError, r.speedSigma, r.deltaError);
}

// How often the truth lies within two and three of the estimator's standard deviations.
void printCoverage(const char* name, const std::vector<double>& ratios)
{
    int within2 = 0, within3 = 0, known = 0;
    for (double ratio : ratios)
        if (!std::isnan(ratio))
        {
            known++;
            within2 += ratio <= 2;
            within3 += ratio <= 3;
        }
    if (known)
        std::printf("%-28s truth within 2 sigma in %.1f %%, within 3 sigma in %.1f %% of %d cases\n", name, 100. * within2 / known,
                    100. * within3 / known, known);
}

void printSummary(const std::vector<Result>& results)
{
    std::vector<double> values[5], ratios[2];
    int ok = 0, worse = 0;
    for (const Result& r : results)
    {
        const double row[5] = {r.raw, r.left, std::abs(r.yawRateError), std::abs(r.speedError), std::abs(r.deltaError)};
        for (int i = 0; i < 5; i++)
            values[i].push_back(row[i]);
        ratios[0].push_back(std::abs(r.yawRateError) / r.yawRateSigma);
        ratios[1].push_back(std::abs(r.speedError) / r.speedSigma);
        ok += r.status == MOTION_OK;
        worse += r.left > r.raw + 1e-6;
    }
    static const char* const names[] = {"displacement raw, px", "displacement left, px", "yaw rate error, deg/s", "speed error, km/h",
                                        "line at infinity error, px"};
    std::printf("\n%d cases, %d with status ok, %d worse than the raw image\n", int(results.size()), ok, worse);
    std::printf("%-28s %8s %8s %8s %8s\n", "", "median", "p90", "mean", "max");
    for (int i = 0; i < 5; i++)
        std::printf("%-28s %8.3f %8.3f %8.3f %8.3f\n", names[i], quantile(values[i], 0.5), quantile(values[i], 0.9), mean(values[i]),
                    quantile(values[i], 1));
    printCoverage("yaw rate", ratios[0]);
    printCoverage("speed", ratios[1]);
}

int run(int argc, const char* const* argv)
{
    Options options(argc, argv, KEYS);
    if (options.given("help"))
    {
        options.printHelp(ABOUT);
        return 0;
    }
    if (!options.arguments().empty())
        throw UsageError("unknown argument " + options.arguments()[0]);
    if (options.given("threads"))
        cv::setNumThreads(options.integer("threads", 1, 1024));
    const std::vector<Case> cases = options.given("photos") ? photoCases(options) : renderedCases(options);

    Knowledge knowledge;
    knowledge.gravityNoise = options.number("gravity_noise", 0, 45) * DEGREE;
    knowledge.speedSigma = options.number("speed_sigma", 0, 1000) * KMH;
    knowledge.yawRateSigma = options.number("yaw_rate_sigma", 0, 1000) * DEGREE;
    knowledge.focalError = options.number("focal_error", -90, 1000) / 100;
    AckermannEstimator::Params params;
    static const int models[] = {MODEL_AUTO, MODEL_4LA, MODEL_3LA, MODEL_1LA, MODEL_NONE};
    params.model = models[options.choice("model", {"auto", "4la", "3la", "1la", "none"})];
    params.detector = options.choice("detector", {"lsd", "fld", "edlines"});
    params.wallDistance = cases.empty() ? 0 : cases[0].scene.left;
    if (options.given("gravity_sigma"))
        params.gravitySigma = options.number("gravity_sigma", 0, 45) * DEGREE;
    else if (knowledge.gravityNoise > 0)
        params.gravitySigma = knowledge.gravityNoise;
    const unsigned seed = unsigned(options.integer("seed", 0, 1 << 20));
    const std::string save = options.given("save") ? options.text("save") + "/" : "";

    std::vector<Result> results(cases.size());
    cv::parallel_for_(cv::Range(0, int(cases.size())), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; i++)
        {
            const cv::Mat image = makeImage(cases[i]);
            if (!save.empty())
                cv::imwrite(save + cv::format("%03d_", i) + cases[i].name + ".png", image);
            results[i] = evaluate(cases[i], image, params, knowledge, seed + unsigned(i));
        }
    }, double(cases.size()));

    if (!options.flag("quiet"))
    {
        std::printf("case\tspeed\tyaw_rate\tstatus\tmodel\tcandidates\tinliers\traw_px\tleft_px\tyaw_rate_error\tyaw_rate_sigma\tspeed_error\t"
                    "speed_sigma\tdelta_error_px\n");
        for (size_t i = 0; i < cases.size(); i++)
            printCase(cases[i], results[i]);
    }
    printSummary(results);
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(run, argc, argv);
}
