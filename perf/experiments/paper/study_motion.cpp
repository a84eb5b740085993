// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "contestants.hpp"
#include "displacement.hpp"
#include "setting.hpp"
#include "study.hpp"
#include "vertical_lines.hpp"

#include <cmath>

namespace paper {

using namespace cv::rsackermann;

namespace {

// The paper's simulated motions: what is set, and what a noise of 2 km/h and 2 deg/s makes of it.
struct Motion
{
    const char* part; // 1la: turning on the spot, 3la: straight ahead, 4la: both
    double speed, yawRate, noisySpeed, noisyYawRate;
    double gyro; // yaw rate as a gyro measures it to 1 deg/s
    int street;
};

std::vector<Motion> makeMotions(const StudyOptions& options)
{
    const std::vector<double> speeds =
        options.quick ? std::vector<double>{20, 100} : std::vector<double>{20, 60, 100, 140};
    const std::vector<double> yawRates =
        options.quick ? std::vector<double>{10, 40, 70} : std::vector<double>{10, 20, 30, 40, 50, 60, 70};
    const int streets = options.quick ? 1 : 10;
    cv::RNG rng(uint64(options.seed) + 1);
    rng.next(); // the first normal deviate of a small seed is 0
    std::vector<Motion> motions;
    const auto add = [&](const char* part, double speed, double yawRate, int street) {
        const double noisySpeed = speed + rng.gaussian(2), noisyYawRate = yawRate + rng.gaussian(2);
        motions.push_back({part, speed, yawRate, noisySpeed, noisyYawRate, noisyYawRate + rng.gaussian(1), street});
    };
    for (int street = 0; street < streets; street++)
    {
        for (double yawRate : yawRates)
            add("1la", 0, yawRate, street);
        for (double speed : speeds)
            add("3la", speed, 0, street);
        for (double speed : speeds)
            for (double yawRate : yawRates)
                add("4la", speed, yawRate, street);
    }
    return motions;
}

// The segments whose ends the true motion brings into one column to half a pixel, as it does those of images of
// vertical lines.
int countInliers(const RollingShutterCamera& camera, const cv::Mat& segments, const AckermannMotion& motion)
{
    const MinimalSolution truth = {motion.alpha, motion.wallSlope, motion.wallOffset, motion.wallRatio};
    int count = 0;
    for (int i = 0; i < segments.rows; i++)
    {
        const VerticalSegment s = verticalSegment(camera, cv::Vec4d(segments.at<cv::Vec4f>(i)));
        count += std::abs(columnDifference(s, truth, camera.heading)) * camera.cameraMatrix(0, 0) < 0.5;
    }
    return count;
}

} // namespace

void studyMotion(const StudyOptions& options)
{
    const std::vector<Motion> motions = makeMotions(options);
    const std::vector<Contestant> contestants = allContestants();
    const Contestant withGyro = libraryContestant("ours_gyro", MODEL_AUTO, false);
    const street::StreetCamera view = paperCamera();
    const auto make = [&](int i, std::vector<std::vector<Row>>& tables) {
        const Motion& m = motions[i];
        const street::StreetScene scene = paperScene(m.noisySpeed, m.noisyYawRate, unsigned(options.seed + m.street));
        const street::StreetRenderer renderer(view, scene);
        const DenseTruth truth(renderer, view.size);
        Problem problem = {rsackermann_samples::libraryCamera(view), cv::Mat(), scene.left, MotionPrior(),
                           options.seed + i};
        detectSegments(renderer.rollingShutter(), problem.segments, DETECTOR);
        const int inliers =
            countInliers(problem.camera, problem.segments, rsackermann_samples::libraryMotion(view, scene));
        const std::string image = cv::format("street_%d_%s_%.0f_%.0f", m.street, m.part, m.speed, m.yawRate);
        const auto add = [&](const Contestant& contestant) {
            const Answer answer = contestant.estimate(problem);
            const MetricEstimate metric(answer.motion, problem.camera);
            const double delta = answer.motion.wallSlope != 0 ? answer.motion.delta() * view.fx : 0;
            const std::string left = number(truth.left(problem.camera, answer.motion)), raw = number(truth.raw());
            tables[0].push_back({contestant.name, image, m.part, number(m.speed, 0), number(m.yawRate, 0),
                                 number(m.noisySpeed), number(m.noisyYawRate), number(metric.speed),
                                 number(metric.yawRate), raw, left, std::to_string(answer.motion.status),
                                 std::to_string(answer.motion.inliers), std::to_string(answer.iterations),
                                 std::to_string(inliers), number(delta, 1), number(answer.motion.wallRatio)});
            if (std::string(m.part) == "4la")
                tables[1].push_back(
                    {contestant.name, image, number(m.noisySpeed, 2), number(m.noisyYawRate, 2), raw, left});
        };
        for (const Contestant& contestant : contestants)
            add(contestant);
        problem.prior.yawRate = m.gyro * DEGREE;
        problem.prior.yawRateSigma = 1 * DEGREE;
        add(withGyro);
    };
    const std::vector<std::vector<Row>> tables = makeRows("motion", int(motions.size()), 2, make);
    writeTable(options.folder + "/displacement.csv", "contestant,image,speed_kmh,yaw_rate_deg_s,raw_px,left_px",
               tables[1]);
    writeTable(options.folder + "/motion.csv",
               "contestant,image,part,set_speed,set_yaw_rate,speed,yaw_rate,estimated_speed,"
               "estimated_yaw_rate,raw_px,left_px,status,"
               "inliers,iterations,true_inliers,line_at_infinity_px,wall_ratio",
               tables[0]);
}

} // namespace paper
