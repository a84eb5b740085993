// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "contestants.hpp"
#include "displacement.hpp"
#include "setting.hpp"
#include "study.hpp"

namespace paper {

using namespace cv::rsackermann;

namespace {

enum Knowledge { NOTHING, SPEED, YAW_RATE, SPEED_AND_YAW_RATE };

struct Condition
{
    std::string factor;
    double value;
    int segments;
    double outliers, readOut, focalError;
    int width;
    int known; // Knowledge

    Condition(const std::string& name, double v)
        : factor(name), value(v), segments(60), outliers(0.2), readOut(READ_OUT), focalError(0), width(520),
          known(NOTHING)
    {
    }
};

std::vector<Condition> makeConditions(bool quick)
{
    std::vector<Condition> conditions;
    const auto sweep = [&](const char* factor, const std::vector<double>& values,
                           const std::function<void(Condition&, double)>& set) {
        for (size_t i = 0; i < values.size(); i++)
            if (!quick || i % 2 == 1)
            {
                conditions.push_back(Condition(factor, values[i]));
                set(conditions.back(), values[i]);
            }
    };
    sweep("segments", {8, 15, 30, 60, 120, 240}, [](Condition& c, double v) { c.segments = int(v); });
    sweep("outliers", {0, 0.2, 0.4, 0.6, 0.7}, [](Condition& c, double v) { c.outliers = v; });
    sweep("readout_ms", {5, 10, 20, 30, 40, 50}, [](Condition& c, double v) { c.readOut = v / 1e3; });
    sweep("focal_error_percent", {-20, -10, 0, 10, 20}, [](Condition& c, double v) { c.focalError = v / 100; });
    sweep("width_px", {260, 520, 1040, 2080}, [](Condition& c, double v) { c.width = int(v); });
    sweep("known", {NOTHING, SPEED, YAW_RATE, SPEED_AND_YAW_RATE}, [](Condition& c, double v) { c.known = int(v); });
    return conditions;
}

// Speed to 2 km/h and yaw rate to 1 deg/s, with errors of that size.
MotionPrior makePrior(int known, const street::StreetScene& scene, cv::RNG& rng)
{
    MotionPrior prior;
    const double speedSigma = 2 * KMH, yawRateSigma = 1 * DEGREE;
    prior.speed = scene.speed + rng.gaussian(speedSigma);
    prior.yawRate = scene.yawRate + rng.gaussian(yawRateSigma);
    prior.speedSigma = known & SPEED ? speedSigma : 0;
    prior.yawRateSigma = known & YAW_RATE ? yawRateSigma : 0;
    return prior;
}

} // namespace

// What the errors depend on, with vertical lines whose ends are off by 0.3 px.
void studyConditions(const StudyOptions& options)
{
    const std::vector<Condition> conditions = makeConditions(options.quick);
    const int cases = options.quick ? 4 : 40;
    const std::vector<Contestant> contestants = mainContestants();
    const auto make = [&](int item, std::vector<std::vector<Row>>& tables) {
        const Condition& c = conditions[item / cases];
        cv::RNG rng(uint64(options.seed) * 1013 + uint64(item % cases) + 7); // the same motions under all conditions
        const double speed = rng.uniform(20., 140.), yawRate = rng.uniform(10., 70.) * (item % 2 ? 1 : -1);
        const street::StreetCamera view = paperCamera(c.readOut, c.width);
        const street::StreetScene scene = paperScene(speed, yawRate, 0);
        const street::StreetRenderer renderer(view, scene);
        const DenseTruth truth(renderer, view.size);
        street::StreetCamera given = view;
        given.fx *= 1 + c.focalError;
        given.fy *= 1 + c.focalError;
        Problem problem = {rsackermann_samples::libraryCamera(given), cv::Mat(), scene.left,
                           makePrior(c.known, scene, rng), options.seed + item};
        std::vector<int> walls;
        verticalLines(renderer, view, c.segments, 0.3, c.outliers, rng, walls).convertTo(problem.segments, CV_32F);
        for (const Contestant& contestant : contestants)
        {
            const AckermannMotion motion = contestant.estimate(problem).motion;
            const MetricEstimate metric(motion, problem.camera);
            tables[0].push_back({contestant.name, c.factor, number(c.value, 1), std::to_string(item % cases),
                                 number(speed), number(yawRate), number(metric.yawRate - yawRate),
                                 number(metric.speed - speed), number(truth.raw()),
                                 number(truth.left(problem.camera, motion)), std::to_string(motion.status)});
        }
    };
    writeTable(options.folder + "/conditions.csv",
               "contestant,factor,value,case,speed,yaw_rate,yaw_rate_error,speed_error,raw_px,left_px,status",
               makeRows("conditions", int(conditions.size()) * cases, 1, make)[0]);
}

} // namespace paper
