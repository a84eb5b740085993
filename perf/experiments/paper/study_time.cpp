// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "contestants.hpp"
#include "setting.hpp"
#include "study.hpp"
#include "vertical_lines.hpp"

#include "opencv2/core/utility.hpp"
#include <algorithm>
#include <ctime>

namespace paper {

using namespace cv::rsackermann;

namespace {

// Median of the seconds of the processor that a piece of work takes: on a busy machine it may have to wait.
template <typename Work>
double secondsOf(int rounds, const Work& work)
{
    std::vector<double> seconds;
    for (int i = 0; i < rounds; i++)
    {
        const std::clock_t start = std::clock();
        work();
        seconds.push_back(double(std::clock() - start) / CLOCKS_PER_SEC);
    }
    std::nth_element(seconds.begin(), seconds.begin() + rounds / 2, seconds.end());
    return seconds[rounds / 2];
}

// One core while it lives.
class OneThread
{
public:
    OneThread() : threads_(cv::getNumThreads()) { cv::setNumThreads(1); }
    ~OneThread() { cv::setNumThreads(threads_); }

private:
    int threads_;
};

} // namespace

// Table 1: time of the estimation in images of 520 x 360 pixels on one core.
void studyTime(const StudyOptions& options)
{
    const OneThread oneThread;
    const std::vector<double> speeds = options.quick ? std::vector<double>{60} : std::vector<double>{20, 60, 100, 140};
    const std::vector<double> yawRates = options.quick ? std::vector<double>{40} : std::vector<double>{10, 40, 70};
    const int rounds = options.quick ? 3 : 9;
    const street::StreetCamera view = paperCamera();
    std::vector<Row> rows;
    for (double speed : speeds)
        for (double yawRate : yawRates)
        {
            const street::StreetScene scene = paperScene(speed, yawRate, unsigned(options.seed));
            const cv::Mat image = street::StreetRenderer(view, scene).rollingShutter();
            Problem problem = {rsackermann_samples::libraryCamera(view), cv::Mat(), scene.left, MotionPrior(),
                               options.seed};
            const double detection = secondsOf(rounds, [&]() { detectSegments(image, problem.segments, DETECTOR); });
            for (const Contestant& contestant : allContestants())
            {
                Answer answer;
                const double estimation = secondsOf(rounds, [&]() { answer = contestant.estimate(problem); });
                rows.push_back({contestant.name, number(speed, 0), number(yawRate, 0),
                                std::to_string(problem.segments.rows), std::to_string(answer.motion.candidates),
                                std::to_string(answer.iterations), number(detection * 1e3), number(estimation * 1e3)});
            }
        }
    writeTable(options.folder + "/time.csv",
               "contestant,speed,yaw_rate,segments,candidates,iterations,detection_ms,estimation_ms", rows);
}

// Time of the minimal solvers alone.
void studySolverTime(const StudyOptions& options)
{
    const OneThread oneThread;
    const int samples = 1000, repeats = 20, rounds = options.quick ? 5 : 25;
    const street::StreetCamera view = paperCamera();
    const street::StreetScene scene = paperScene(60, 40, unsigned(options.seed));
    const RollingShutterCamera camera = rsackermann_samples::libraryCamera(view);
    cv::RNG rng(uint64(options.seed) + 3);
    std::vector<int> walls;
    const cv::Mat lines = verticalLines(street::StreetRenderer(view, scene), view, 16 * samples, 0, 0, rng, walls);
    std::vector<VerticalSegment> left, right, all;
    for (int i = 0; i < lines.rows; i++)
        (walls[i] < 0 ? left : right).push_back(verticalSegment(camera, lines.at<cv::Vec4d>(i)));
    for (size_t i = 0; 3 * i + 2 < left.size() && i < right.size() && all.size() < size_t(4 * samples); i++)
    {
        all.insert(all.end(), left.begin() + 3 * i, left.begin() + 3 * i + 3);
        all.push_back(right[i]);
    }
    SolverOptions global = solverLimits(camera, 90 * DEGREE, 200 * KMH, scene.left), rolling = global;
    rolling.depthModel = DEPTH_ROLLING_SHUTTER;
    MinimalSolution solutions[8];
    std::vector<Row> rows;
    const auto measure = [&](const std::string& name, const std::function<void(const VerticalSegment*)>& solve) {
        const double seconds = secondsOf(rounds, [&]() {
            for (int k = 0; k < repeats; k++)
                for (size_t i = 0; i < all.size(); i += 4)
                    solve(&all[i]);
        });
        rows.push_back({name, number(seconds * 1e9 / double(repeats * (all.size() / 4)), 1)});
    };
    measure("1la", [&](const VerticalSegment* s) { solve1LA(s[0], global, solutions); });
    measure("3la", [&](const VerticalSegment* s) { solve3LA(s + 1, true, global, solutions); });
    measure("4la_rolling", [&](const VerticalSegment* s) { solve4LA(s, true, rolling, solutions); });
    measure("4la_global", [&](const VerticalSegment* s) { solve4LA(s, true, global, solutions); });
    measure("4la_exact", [&](const VerticalSegment* s) { solve4LAExact(s, true, global, solutions); });
    writeTable(options.folder + "/solver_time.csv", "solver,nanoseconds", rows);
}

} // namespace paper
