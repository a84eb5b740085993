// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "contestants.hpp"
#include "displacement.hpp"
#include "forward_splat.hpp"
#include "setting.hpp"
#include "study.hpp"

#include "opencv2/imgproc.hpp"

namespace paper {

using namespace cv::rsackermann;

namespace {

// The paper's method splats, the library maps.
cv::Mat correct(const Contestant& contestant, const RollingShutterCamera& camera, const AckermannMotion& motion,
                const cv::Mat& image, cv::Mat& mask)
{
    if (contestant.name.compare(0, 5, "paper") == 0)
        return correctBySplatting(camera, motion, image, mask);
    cv::Mat columns, rows, corrected;
    WarpMapGenerator::create(camera)->initRectifyMap(motion, columns, rows, CV_32FC1, mask);
    cv::remap(image, corrected, columns, rows, cv::INTER_LINEAR);
    return corrected;
}

} // namespace

// Displacement by patch matching, as the paper measures it, beside the true one.
void studyPatches(const StudyOptions& options)
{
    const std::vector<double> speeds = options.quick ? std::vector<double>{60} : std::vector<double>{20, 60, 100, 140};
    const std::vector<double> yawRates = options.quick ? std::vector<double>{40} : std::vector<double>{10, 40, 70};
    std::vector<cv::Vec3d> cases;
    for (int street = 0; street < (options.quick ? 1 : 2); street++)
        for (double speed : speeds)
            for (double yawRate : yawRates)
                cases.push_back(cv::Vec3d(street, speed, yawRate));
    std::vector<Contestant> contestants = mainContestants();
    contestants.push_back(paperContestant("paper_3la", MODEL_3LA));
    contestants.push_back(paperContestant("paper_1la", MODEL_1LA));
    const street::StreetCamera view = paperCamera();
    const auto make = [&](int i, std::vector<std::vector<Row>>& tables) {
        const street::StreetScene scene =
            paperScene(cases[i][1], cases[i][2], unsigned(options.seed + int(cases[i][0])));
        const street::StreetRenderer renderer(view, scene);
        const DenseTruth truth(renderer, view.size);
        const cv::Mat rolling = renderer.rollingShutter(), global = renderer.globalShutter();
        Problem problem = {rsackermann_samples::libraryCamera(view), cv::Mat(), scene.left, MotionPrior(),
                           options.seed + i};
        detectSegments(rolling, problem.segments, DETECTOR);
        const double raw = patchDisplacement(global, rolling, cv::Mat());
        for (const Contestant& contestant : contestants)
        {
            const AckermannMotion motion = contestant.estimate(problem).motion;
            cv::Mat mask;
            const cv::Mat corrected = correct(contestant, problem.camera, motion, rolling, mask);
            tables[0].push_back({contestant.name, number(cases[i][0], 0), number(cases[i][1], 0),
                                 number(cases[i][2], 0), number(truth.raw()),
                                 number(truth.left(problem.camera, motion)), number(raw),
                                 number(patchDisplacement(global, corrected, mask))});
        }
    };
    writeTable(options.folder + "/patches.csv",
               "contestant,street,speed,yaw_rate,raw_px,left_px,raw_patches_px,left_patches_px",
               makeRows("patches", int(cases.size()), 1, make)[0]);
}

} // namespace paper
