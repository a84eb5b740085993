// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "estimator_options.hpp"
#include "figures.hpp"
#include "workload.hpp"

#include "opencv2/core/utility.hpp"
#include "opencv2/imgproc.hpp"

namespace benchmark {

using namespace cv::rsackermann;

namespace {

const cv::Size FULL_HD(1920, 1080);

int addCorrect(Benchmark& benchmark, const cv::Size& size, int detector = AckermannEstimator::Params().detector)
{
    return benchmark.work([size, detector]() -> Benchmark::Work {
        const Drive drive(size);
        const cv::Mat image = render(drive);
        RollingShutterCorrector::Params params;
        params.estimator.detector = detector;
        const cv::Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(drive.camera, params);
        cv::Mat corrected(image.size(), image.type());
        return [corrector, image, corrected]() mutable { corrector->correct(image, corrected); };
    });
}

int addDetect(Benchmark& benchmark, const cv::Size& size, int detector)
{
    return benchmark.work([size, detector]() -> Benchmark::Work {
        const cv::Mat image = render(Drive(size));
        return [image, detector]() {
            cv::Mat segments;
            detectSegments(image, segments, detector);
        };
    });
}

int addRemap(Benchmark& benchmark)
{
    return benchmark.work([]() -> Benchmark::Work {
        const Drive drive(FULL_HD);
        const cv::Mat image = render(drive);
        cv::Mat columns, rows, corrected;
        WarpMapGenerator::create(drive.camera)->initRectifyMap(drive.motion, columns, rows);
        return [image, columns, rows, corrected]() mutable {
            cv::remap(image, corrected, columns, rows, cv::INTER_LINEAR);
        };
    });
}

} // namespace

void addCorrectFigures(Benchmark& benchmark)
{
    const int correct = addCorrect(benchmark, FULL_HD);
    const int detect = addDetect(benchmark, FULL_HD, AckermannEstimator::Params().detector);
    const int remap = addRemap(benchmark);
    benchmark.figure("correct_1080p_over_detect_plus_remap", "ratio", {correct, detect, remap}, overOthers);
    for (int detector : {int(DETECTOR_LSD), int(DETECTOR_VERTICALS)})
    {
        const std::string word = rsackermann_samples::DETECTOR_WORDS[detector];
        benchmark.figure("detect_" + word + "_1080p_over_remap", "ratio",
                         {addDetect(benchmark, FULL_HD, detector), remap}, overOthers);
        benchmark.figure("correct_" + word + "_1080p_over_remap", "ratio",
                         {addCorrect(benchmark, FULL_HD, detector), remap}, overOthers);
    }
    benchmark.figure("correct_1080p_fps", "1/s", {correct}, [](const std::vector<double>& t) { return 1 / t[0]; });

    const cv::Size small(640, 480), large(3840, 2160);
    benchmark.figure(
        "growth_pixels_correct", "time per pixel, ratio", {addCorrect(benchmark, large), addCorrect(benchmark, small)},
        [small, large](const std::vector<double>& t) { return t[0] / t[1] * small.area() / large.area(); });

    const cv::Size sizes[] = {small, cv::Size(1280, 720), FULL_HD};
    for (size_t i = 0; i < rsackermann_samples::DETECTOR_WORDS.size(); i++)
        for (const cv::Size& size : sizes)
            benchmark.figure(
                cv::format("detect_%s_%dp_ms", rsackermann_samples::DETECTOR_WORDS[i].c_str(), size.height), "ms",
                {addDetect(benchmark, size, int(i))}, scaled(1e3));
}

} // namespace benchmark
