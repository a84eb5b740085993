// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "figures.hpp"
#include "workload.hpp"

#include "test_box_depth.hpp"
#include "test_lens_models.hpp"
#include "opencv2/core/utility.hpp"
#include <cstring>

namespace benchmark {

using namespace cv::rsackermann;

namespace {

const cv::Size FULL_HD(1920, 1080);

const std::vector<double> NO_LENS, LENS = {-0.28, 0.09, 8e-4, -6e-4, -0.012};

// What is compared writes into the same maps.
struct Maps
{
    cv::Mat columns, rows, mask;
    explicit Maps(const cv::Size& size) : columns(size, CV_32FC1), rows(size, CV_32FC1) {}
};

int addRectifyMap(Benchmark& benchmark, const cv::Size& size, const std::vector<double>& lens,
                  const std::shared_ptr<Maps>& maps)
{
    return benchmark.work([size, lens, maps]() -> Benchmark::Work {
        const Drive drive(size, lens);
        const cv::Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(drive.camera);
        return [generator, drive, maps]() { generator->initRectifyMap(drive.motion, maps->columns, maps->rows); };
    });
}

int addDistortMap(Benchmark& benchmark, const std::vector<double>& lens, const std::shared_ptr<Maps>& maps)
{
    return benchmark.work([lens, maps]() -> Benchmark::Work {
        const Drive drive(FULL_HD, lens);
        const cv::Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(drive.camera);
        return [generator, drive, maps]() { generator->initDistortMap(drive.motion, maps->columns, maps->rows); };
    });
}

// @param camera of the depth: that of the map is the global-shutter one.
int addDepthMap(Benchmark& benchmark, DepthCamera camera, bool masked, const std::shared_ptr<Maps>& maps)
{
    return benchmark.work([camera, masked, maps]() -> Benchmark::Work {
        const Drive drive(FULL_HD, LENS);
        const cv::Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(drive.camera);
        const DepthMap depth(opencv_test::makeBoxDepth(FULL_HD), camera);
        return [generator, drive, depth, masked, maps]() {
            generator->initRectifyMap(drive.motion, maps->columns, maps->rows, CV_32FC1,
                                      masked ? cv::OutputArray(maps->mask) : cv::OutputArray(cv::noArray()), depth);
        };
    });
}

int addInitUndistort(Benchmark& benchmark, const std::vector<double>& lens, const std::shared_ptr<Maps>& maps)
{
    return benchmark.work([lens, maps]() -> Benchmark::Work {
        const cv::Matx33d K = Drive(FULL_HD).camera.cameraMatrix;
        return [lens, maps, K]() {
            cv::initUndistortRectifyMap(K, lens, cv::noArray(), K, FULL_HD, CV_32FC1, maps->columns, maps->rows);
        };
    });
}

int addMemset(Benchmark& benchmark, const std::shared_ptr<Maps>& maps)
{
    return benchmark.work([maps]() -> Benchmark::Work {
        return [maps]() {
            std::memset(maps->columns.data, 1, maps->columns.total() * maps->columns.elemSize());
            std::memset(maps->rows.data, 1, maps->rows.total() * maps->rows.elemSize());
        };
    });
}

} // namespace

void addMapFigures(Benchmark& benchmark)
{
    const std::shared_ptr<Maps> maps = std::make_shared<Maps>(FULL_HD);
    const int rectify = addRectifyMap(benchmark, FULL_HD, NO_LENS, maps),
              rectifyLens = addRectifyMap(benchmark, FULL_HD, LENS, maps);
    benchmark.figure("rectify_map_1080p_ms", "ms", {rectify}, scaled(1e3));
    benchmark.figure("rectify_map_1080p_over_init_undistort", "ratio",
                     {rectify, addInitUndistort(benchmark, NO_LENS, maps)}, overOthers);
    benchmark.figure("rectify_map_lens_1080p_over_init_undistort", "ratio",
                     {rectifyLens, addInitUndistort(benchmark, LENS, maps)}, overOthers);
    benchmark.figure("rectify_map_1080p_over_memset", "ratio", {rectify, addMemset(benchmark, maps)}, overOthers);
    benchmark.figure("distort_map_1080p_ms", "ms", {addDistortMap(benchmark, NO_LENS, maps)}, scaled(1e3));
    benchmark.figure("distort_map_lens_1080p_ms", "ms", {addDistortMap(benchmark, LENS, maps)}, scaled(1e3));

    for (const bool masked : {false, true})
        for (const DepthCamera camera : {DEPTH_CORRECTED, DEPTH_RAW})
            benchmark.figure(std::string("rectify_map_") + (camera == DEPTH_RAW ? "raw_" : "") + "depth_" +
                                 (masked ? "mask_" : "") + "1080p_over_map",
                             "ratio", {addDepthMap(benchmark, camera, masked, maps), rectifyLens}, overOthers);

    const cv::Size small(640, 480), large(3840, 2160);
    const int first = addRectifyMap(benchmark, small, NO_LENS, std::make_shared<Maps>(small));
    const int last = addRectifyMap(benchmark, large, NO_LENS, std::make_shared<Maps>(large));
    benchmark.figure(
        "growth_pixels_rectify_map", "time per pixel, ratio", {last, first},
        [small, large](const std::vector<double>& t) { return t[0] / t[1] * small.area() / large.area(); });
}

} // namespace benchmark
