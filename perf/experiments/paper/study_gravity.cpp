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

struct Tilt
{
    const char* kind;   // roll, pitch or both
    double roll, pitch; // degrees by which the camera is said to be tilted while it is upright
};

std::vector<Tilt> makeTilts(const StudyOptions& options)
{
    const int draws = options.quick ? 10 : 100;
    const double sigma = 1;
    cv::RNG rng(uint64(options.seed) + 2);
    rng.next(); // the first normal deviate of a small seed is 0
    std::vector<Tilt> tilts;
    for (int i = 0; i < draws; i++)
    {
        const double roll = rng.gaussian(sigma), pitch = rng.gaussian(sigma);
        tilts.push_back({"roll", roll, 0});
        tilts.push_back({"pitch", 0, pitch});
        tilts.push_back({"both", roll, pitch});
    }
    return tilts;
}

} // namespace

// Errors of the direction of gravity, at several read-out times.
void studyGravity(const StudyOptions& options)
{
    const std::vector<double> all = {0.005, 0.01, READ_OUT, 0.02, 0.03, 0.05};
    const std::vector<double> readOuts = options.quick ? std::vector<double>{READ_OUT, 0.03} : all;
    const std::vector<Tilt> tilts = makeTilts(options);
    const std::vector<Contestant> contestants = mainContestants();
    const int parts = 10; // of the draws, for the sake of threads
    const auto make = [&](int item, std::vector<std::vector<Row>>& tables) {
        const double readOut = readOuts[item / parts];
        const street::StreetCamera view = paperCamera(readOut);
        const street::StreetScene scene = paperScene(60, 40, unsigned(options.seed));
        const street::StreetRenderer renderer(view, scene);
        const DenseTruth truth(renderer, view.size);
        cv::Mat segments;
        detectSegments(renderer.rollingShutter(), segments, DETECTOR);
        for (size_t k = item % parts; k < tilts.size(); k += parts)
        {
            street::StreetCamera given = view;
            given.roll = tilts[k].roll * DEGREE;
            given.pitch = tilts[k].pitch * DEGREE;
            const Problem problem = {rsackermann_samples::libraryCamera(given), segments, scene.left, MotionPrior(),
                                     options.seed + int(k)};
            for (const Contestant& contestant : contestants)
            {
                const AckermannMotion motion = contestant.estimate(problem).motion;
                const MetricEstimate metric(motion, problem.camera);
                tables[0].push_back({contestant.name, number(readOut * 1e3, 2), tilts[k].kind, number(tilts[k].roll),
                                     number(tilts[k].pitch), number(metric.yawRate - scene.yawRate / DEGREE),
                                     number(metric.speed - scene.speed / KMH), number(truth.raw()),
                                     number(truth.left(problem.camera, motion)), std::to_string(motion.status)});
            }
        }
    };
    writeTable(options.folder + "/gravity.csv",
               "contestant,readout_ms,kind,roll_deg,pitch_deg,yaw_rate_error,speed_error,raw_px,left_px,status",
               makeRows("gravity", int(readOuts.size()) * parts, 1, make)[0]);
}

} // namespace paper
