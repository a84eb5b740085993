// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "figures.hpp"
#include "workload.hpp"

#include "opencv2/core/utility.hpp"
#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/imgcodecs.hpp"
#include "opencv2/imgproc.hpp"
#include <cstdlib>
#include <stdexcept>

namespace benchmark {

using namespace cv::rsackermann;

namespace {

const cv::Size FULL_HD(1920, 1080);
const int FRAMES = 300;

//! A temporary folder with JPEG frames, and one for results; both go with it.
class Folder
{
public:
    Folder() : path_(cv::tempfile())
    {
        const int views = 5;
        for (const std::string& folder : {input(), output()})
            if (!cv::utils::fs::createDirectories(folder))
                throw std::runtime_error("the folder " + folder + " can't be made");
        for (int i = 0; i < FRAMES; i++)
        {
            Drive drive(FULL_HD);
            drive.scene.seed = unsigned(1 + i % views);
            if (i < views)
                images_.push_back(render(drive));
            if (!cv::imwrite(frame(input(), i), images_[size_t(i % views)]))
                throw std::runtime_error(frame(input(), i) + " can't be written");
        }
    }
    ~Folder() { cv::utils::fs::remove_all(path_); }

    std::string input() const { return path_ + "/frames"; }
    std::string output() const { return path_ + "/corrected"; }
    static std::string frame(const std::string& folder, int i) { return folder + cv::format("/%03d.jpg", i); }

private:
    Folder(const Folder&);
    Folder& operator=(const Folder&);

    std::string path_;
    std::vector<cv::Mat> images_;
};

int addProgram(Benchmark& benchmark, const std::shared_ptr<std::unique_ptr<Folder>>& folder)
{
    return benchmark.work([folder]() -> Benchmark::Work {
        if (!*folder)
            folder->reset(new Folder);
        return [folder]() {
            const std::string command =
                cv::format("\"%s\" --threads=%d \"%s\" --output=\"%s\" --overwrite 2>/dev/null", CORRECT_PROGRAM,
                           cv::getNumThreads(), (*folder)->input().c_str(), (*folder)->output().c_str());
            if (std::system(command.c_str()) != 0)
                throw std::runtime_error("this has failed: " + command);
        };
    });
}

// What can't be spared, with a frame for each thread.
int addReadRemapWrite(Benchmark& benchmark, const std::shared_ptr<std::unique_ptr<Folder>>& folder)
{
    return benchmark.work([folder]() -> Benchmark::Work {
        if (!*folder)
            folder->reset(new Folder);
        const Drive drive(FULL_HD);
        cv::Mat columns, rows;
        WarpMapGenerator::create(drive.camera)->initRectifyMap(drive.motion, columns, rows);
        return [folder, columns, rows]() {
            cv::parallel_for_(cv::Range(0, FRAMES), [&](const cv::Range& range) {
                for (int i = range.start; i < range.end; i++)
                {
                    const cv::Mat image = cv::imread(Folder::frame((*folder)->input(), i), cv::IMREAD_UNCHANGED);
                    cv::Mat warped;
                    cv::remap(image, warped, columns, rows, cv::INTER_LINEAR);
                    cv::imwrite(Folder::frame((*folder)->output(), i), warped);
                }
            });
        };
    });
}

} // namespace

void addFolderFigures(Benchmark& benchmark)
{
    const auto folder = std::make_shared<std::unique_ptr<Folder>>();
    benchmark.figure("folder_1080p_over_read_remap_write", "ratio",
                     {addProgram(benchmark, folder), addReadRemapWrite(benchmark, folder)}, overOthers);
}

} // namespace benchmark
