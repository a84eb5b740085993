// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "estimator_options.hpp"
#include "figures.hpp"
#include "rendered_drive.hpp"
#include "workload.hpp"

#include "opencv2/core/utility.hpp"
#include "opencv2/imgproc.hpp"

namespace benchmark {

using namespace cv::rsackermann;

namespace {

const cv::Size FULL_HD(1920, 1080), UHD(3840, 2160);

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

// The frames of a drive, from its beginning on.
int addSequence(Benchmark& benchmark, int frames)
{
    return benchmark.work([frames]() -> Benchmark::Work {
        Drive first(FULL_HD);
        first.scene.yawRate = 0.2; // the street is narrow
        street::RenderedDrive drive(first.view, first.scene);
        drive.course = street::RenderedDrive::WEAVING;
        std::vector<cv::Mat> images;
        for (int i = 0; i < frames; i++)
            images.push_back(drive.next().rollingShutter(2));
        RollingShutterCorrector::Params params;
        params.sequence = true;
        params.frameInterval = 1 / street::RenderedDrive::framesPerSecond();
        const cv::Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(first.camera, params);
        cv::Mat corrected(FULL_HD, images[0].type());
        return [corrector, images, corrected]() mutable {
            corrector->reset();
            for (const cv::Mat& image : images)
                corrector->correct(image, corrected);
        };
    });
}

int addRemap(Benchmark& benchmark, const cv::Size& size)
{
    return benchmark.work([size]() -> Benchmark::Work {
        const Drive drive(size);
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
    const int remap = addRemap(benchmark, FULL_HD);
    benchmark.figure("correct_1080p_over_detect_plus_remap", "ratio", {correct, detect, remap}, overOthers);
    benchmark.figure("detect_1080p_over_remap", "ratio", {detect, remap}, overOthers);
    benchmark.figure("correct_1080p_over_remap", "ratio", {correct, remap}, overOthers);
    benchmark.figure("detect_lsd_1080p_over_remap", "ratio", {addDetect(benchmark, FULL_HD, DETECTOR_LSD), remap},
                     overOthers);
    benchmark.figure("correct_lsd_1080p_over_remap", "ratio", {addCorrect(benchmark, FULL_HD, DETECTOR_LSD), remap},
                     overOthers);
    const int frames = 20;
    benchmark.figure("sequence_1080p_over_remap", "ratio, of a frame", {addSequence(benchmark, frames), remap},
                     [frames](const std::vector<double>& t) { return t[0] / (frames * t[1]); });
    benchmark.figure("correct_1080p_fps", "1/s", {correct}, [](const std::vector<double>& t) { return 1 / t[0]; });

    const cv::Size small(640, 480);
    const int correctLarge = addCorrect(benchmark, UHD);
    benchmark.figure("correct_4k_over_remap", "ratio", {correctLarge, addRemap(benchmark, UHD)}, overOthers);
    benchmark.figure("growth_pixels_correct", "time per pixel, ratio", {correctLarge, addCorrect(benchmark, small)},
                     [small](const std::vector<double>& t) { return t[0] / t[1] * small.area() / UHD.area(); });

    const cv::Size sizes[] = {small, cv::Size(1280, 720), FULL_HD};
    for (size_t i = 0; i < rsackermann_samples::DETECTOR_WORDS.size(); i++)
        for (const cv::Size& size : sizes)
            benchmark.figure(
                cv::format("detect_%s_%dp_ms", rsackermann_samples::DETECTOR_WORDS[i].c_str(), size.height), "ms",
                {addDetect(benchmark, size, int(i))}, scaled(1e3));
}

} // namespace benchmark
