// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "figures.hpp"
#include "workload.hpp"

#include "opencv2/core/utility.hpp"
#include "opencv2/imgproc.hpp"

namespace benchmark {

using namespace cv::rsackermann;

namespace {

int addEstimate(Benchmark& benchmark, int segmentCount)
{
    return benchmark.work(
        [segmentCount]() -> Benchmark::Work {
            const Drive drive(cv::Size(640, 380));
            std::vector<int> walls;
            const cv::Mat segments = verticalSegments(drive, segmentCount, 0.3, walls);
            AckermannEstimator::Params params;
            params.wallDistance = drive.scene.left;
            const cv::Ptr<AckermannEstimator> estimator = AckermannEstimator::create(drive.camera, params);
            return [estimator, segments]() { estimator->estimate(segments); };
        },
        Benchmark::ONE_THREAD);
}

} // namespace

void addEstimateFigures(Benchmark& benchmark)
{
    const int counts[] = {50, 200, 1000, 10000};
    std::vector<int> works;
    for (const int count : counts)
    {
        works.push_back(addEstimate(benchmark, count));
        benchmark.figure(cv::format("estimate_%d_segments_ms", count), "ms", {works.back()}, scaled(1e3));
    }
    const int lsd = benchmark.work(
        []() -> Benchmark::Work {
            cv::Mat gray;
            cv::cvtColor(render(Drive(cv::Size(1920, 1080))), gray, cv::COLOR_BGR2GRAY);
            const cv::Ptr<cv::LineSegmentDetector> detector = cv::createLineSegmentDetector();
            return [gray, detector]() {
                cv::Mat segments;
                detector->detect(gray, segments);
            };
        },
        Benchmark::ONE_THREAD);
    benchmark.figure("estimate_over_lsd_1080p", "ratio", {works[1], lsd}, overOthers);
    benchmark.figure("growth_segments_50_to_10000", "time per segment, ratio", {works[3], works[0]},
                     [](const std::vector<double>& t) { return t[0] / t[1] * 50 / 10000; });
    benchmark.figure("growth_segments_1000_to_10000", "time per segment, ratio", {works[3], works[2]},
                     [](const std::vector<double>& t) { return t[0] / t[1] * 1000 / 10000; });
}

} // namespace benchmark
