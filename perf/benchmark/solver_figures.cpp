// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "figures.hpp"
#include "workload.hpp"

namespace benchmark {

using namespace cv::rsackermann;

namespace {

// Samples of three segments on the left wall and one on the right wall.
std::vector<VerticalSegment> makeSamples(int count)
{
    const Drive drive(cv::Size(640, 380));
    const cv::Matx33d& K = drive.camera.cameraMatrix;
    std::vector<int> walls;
    const cv::Mat ends = verticalSegments(drive, 16 * count, 0, walls);
    std::vector<VerticalSegment> samples;
    for (int i = 0; i < ends.rows && samples.size() < size_t(4 * count); i++)
    {
        if (walls[i] != (samples.size() % 4 < 3 ? -1 : 1))
            continue;
        const cv::Vec4f e = ends.at<cv::Vec4f>(i);
        VerticalSegment s;
        s.u = HorizontalBearing((e[0] - K(0, 2)) / K(0, 0), 1);
        s.v = HorizontalBearing((e[2] - K(0, 2)) / K(0, 0), 1);
        s.timeU = drive.camera.rowTime(cv::Point2d(e[0], e[1]));
        s.timeV = drive.camera.rowTime(cv::Point2d(e[2], e[3]));
        samples.push_back(s);
    }
    return samples;
}

const int SAMPLES = 1000;

template <typename Solver>
void addSolver(Benchmark& benchmark, const std::string& name, Solver solver)
{
    const int work = benchmark.work(
        [solver]() -> Benchmark::Work {
            const std::vector<VerticalSegment> samples = makeSamples(SAMPLES);
            return [samples, solver]() {
                const SolverOptions options;
                MinimalSolution solutions[8];
                for (size_t i = 0; i < samples.size(); i += 4)
                    solver(&samples[i], options, solutions);
            };
        },
        Benchmark::ONE_THREAD);
    benchmark.figure(name, "ns", {work}, scaled(1e9 / SAMPLES));
}

} // namespace

void addSolverFigures(Benchmark& benchmark)
{
    addSolver(benchmark, "solver_1la_ns",
              [](const VerticalSegment* s, const SolverOptions& o, MinimalSolution* r) { solve1LA(s[0], o, r); });
    addSolver(benchmark, "solver_3la_ns", [](const VerticalSegment* s, const SolverOptions& o, MinimalSolution* r) {
        solve3LA(s + 1, true, o, r);
    });
    addSolver(benchmark, "solver_4la_ns",
              [](const VerticalSegment* s, const SolverOptions& o, MinimalSolution* r) { solve4LA(s, true, o, r); });
    addSolver(
        benchmark, "solver_4la_exact_ns",
        [](const VerticalSegment* s, const SolverOptions& o, MinimalSolution* r) { solve4LAExact(s, true, o, r); });
}

} // namespace benchmark
