// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "contestants.hpp"
#include "information_bound.hpp"
#include "setting.hpp"
#include "study.hpp"

namespace paper {

using namespace cv::rsackermann;

// Errors of the motion from noisy vertical lines beside the Cramer-Rao bound.
void studyBound(const StudyOptions& options)
{
    const int draws = options.quick ? 10 : 60, count = 60;
    const double noise = 0.3;
    const std::vector<double> speeds = options.quick ? std::vector<double>{60} : std::vector<double>{20, 60, 100, 140};
    const std::vector<double> yawRates =
        options.quick ? std::vector<double>{10, 40, 70} : std::vector<double>{10, 25, 40, 55, 70};
    const std::vector<Contestant> contestants = mainContestants();
    const street::StreetCamera view = paperCamera();
    const auto make = [&](int i, std::vector<std::vector<Row>>& tables) {
        const double speed = speeds[i / yawRates.size()], yawRate = yawRates[i % yawRates.size()];
        const street::StreetScene scene = paperScene(speed, yawRate, 0);
        cv::RNG rng(uint64(options.seed) * 1009 + uint64(i) + 6);
        std::vector<int> walls;
        const cv::Mat lines = verticalLines(street::StreetRenderer(view, scene), view, count, 0, 0, rng, walls);
        Problem problem = {rsackermann_samples::libraryCamera(view), cv::Mat(), scene.left, MotionPrior(),
                           options.seed};
        const InformationBound bound =
            informationBound(problem.camera, lines, rsackermann_samples::libraryMotion(view, scene), scene.left, noise);
        for (int draw = 0; draw < draws; draw++)
        {
            cv::Mat errors(lines.size(), CV_64F);
            rng.fill(errors, cv::RNG::NORMAL, 0, noise);
            cv::Mat(lines + errors).convertTo(problem.segments, CV_32F);
            problem.seed = options.seed + draw;
            for (const Contestant& contestant : contestants)
            {
                const MetricEstimate metric(contestant.estimate(problem).motion, problem.camera);
                tables[0].push_back({contestant.name, number(speed, 0), number(yawRate, 0), std::to_string(draw),
                                     number(metric.yawRate - yawRate), number(metric.speed - speed),
                                     number(bound.yawRate / DEGREE), number(bound.speed / KMH)});
            }
        }
    };
    writeTable(options.folder + "/bound.csv",
               "contestant,speed,yaw_rate,draw,yaw_rate_error,speed_error,yaw_rate_bound,speed_bound",
               makeRows("bound", int(speeds.size() * yawRates.size()), 1, make)[0]);
}

} // namespace paper
