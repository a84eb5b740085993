// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "contestants.hpp"
#include "displacement.hpp"
#include "setting.hpp"
#include "study.hpp"

namespace paper {

using namespace cv::rsackermann;

// The distance of the wall and the height of the camera are said to be 10 cm more or less than they are.
void studyDistances(const StudyOptions& options)
{
    struct Mistake
    {
        const char* of;
        double wall, height; // metres
    };
    const std::vector<Mistake> mistakes = {
        {"none", 0, 0}, {"wall", -0.1, 0}, {"wall", 0.1, 0}, {"height", 0, -0.1}, {"height", 0, 0.1}};
    const std::vector<double> speeds =
        options.quick ? std::vector<double>{20, 100} : std::vector<double>{20, 60, 100, 140};
    const std::vector<double> yawRates = options.quick ? std::vector<double>{40} : std::vector<double>{10, 40, 70};
    std::vector<cv::Vec3d> cases;
    for (int street = 0; street < (options.quick ? 1 : 2); street++)
        for (double speed : speeds)
            for (double yawRate : yawRates)
                cases.push_back(cv::Vec3d(street, speed, yawRate));
    const std::vector<Contestant> contestants = mainContestants();
    const street::StreetCamera view = paperCamera();
    const auto make = [&](int i, std::vector<std::vector<Row>>& tables) {
        const street::StreetScene scene =
            paperScene(cases[i][1], cases[i][2], unsigned(options.seed + int(cases[i][0])));
        const street::StreetRenderer renderer(view, scene);
        const DenseTruth truth(renderer, view.size);
        cv::Mat segments;
        detectSegments(renderer.rollingShutter(), segments, DETECTOR);
        for (const Mistake& mistake : mistakes)
        {
            street::StreetCamera given = view;
            given.height += mistake.height;
            const Problem problem = {rsackermann_samples::libraryCamera(given), segments, scene.left + mistake.wall,
                                     MotionPrior(), options.seed + i};
            for (const Contestant& contestant : contestants)
            {
                const AckermannMotion motion = contestant.estimate(problem).motion;
                const MetricEstimate metric(motion, problem.camera);
                tables[0].push_back({contestant.name, mistake.of, number((mistake.wall + mistake.height) * 100, 0),
                                     number(cases[i][0], 0), number(cases[i][1], 0), number(cases[i][2], 0),
                                     number(metric.yawRate - cases[i][2]), number(metric.speed - cases[i][1]),
                                     number(truth.raw()), number(truth.left(problem.camera, motion))});
            }
        }
    };
    writeTable(options.folder + "/distances.csv",
               "contestant,mistake,error_cm,street,speed,yaw_rate,yaw_rate_error,speed_error,raw_px,left_px",
               makeRows("distances", int(cases.size()), 1, make)[0]);
}

} // namespace paper
