// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "depth_source.hpp"
#include "files.hpp"
#include "options.hpp"

#include "opencv2/core/utils/filesystem.hpp"

namespace rsackermann_samples {

namespace {

const char* const EXTENSIONS[] = {".png", ".tif", ".tiff", ".exr", ".npy", ".csv"};

// The file in a folder that has this name and an extension of its own.
std::string fileIn(const std::string& folder, const std::string& name)
{
    const std::string path = folder + (folder.back() == '/' ? "" : "/") + name;
    for (const char* format : EXTENSIONS)
        if (cv::utils::fs::exists(path + format))
            return path + format;
    return path + EXTENSIONS[0];
}

std::vector<std::string> filesFor(const std::string& path, const InputList& inputs)
{
    std::vector<std::string> files;
    for (const Input& input : listInputs({path}).inputs)
    {
        if (!input.isFile())
            throw UsageError("option --depth: " + path + ": " + input.error);
        files.push_back(input.name);
    }
    if (files.size() != inputs.inputs.size())
        throw UsageError(cv::format("option --depth: %s stands for %zu files; there are %zu inputs", path.c_str(),
                                    files.size(), inputs.inputs.size()));
    return files;
}

} // namespace

DepthSource::DepthSource(const Options& options, const InputList& inputs)
{
    if (!options.given("depth"))
    {
        for (const char* name : {"depth_kind", "depth_camera", "depth_scale", "depth_scale_sigma", "baseline"})
            if (options.given(name))
                throw UsageError(std::string("--") + name + " needs --depth");
        return;
    }
    meaning_.kind = DepthMeaning::Kind(options.choice("depth_kind", {"metric", "disparity", "relative"}));
    meaning_.camera = options.choice("depth_camera", {"raw", "corrected"}) == 0 ? cv::rsackermann::DEPTH_RAW
                                                                                : cv::rsackermann::DEPTH_CORRECTED;
    if (options.given("depth_scale"))
        meaning_.scale = options.positive("depth_scale", 1e6);
    if (options.given("depth_scale_sigma"))
        meaning_.scaleSigma = options.number("depth_scale_sigma", 0, 1);
    if (options.given("baseline"))
        meaning_.baseline = options.positive("baseline", 1e3);
    if ((meaning_.kind == DepthMeaning::DISPARITY) != options.given("baseline"))
        throw UsageError("--depth_kind=disparity and --baseline need each other");
    if (meaning_.kind == DepthMeaning::RELATIVE &&
        (options.given("depth_scale") || meaning_.camera != cv::rsackermann::DEPTH_RAW))
        throw UsageError("--depth_kind=relative is of the raw camera, and has no --depth_scale: it can't go with "
                         "--depth_camera=corrected or --depth_scale");
    if (meaning_.kind == DepthMeaning::RELATIVE && options.given("depth_scale_sigma"))
        throw UsageError("--depth_scale_sigma is of metres: it can't go with --depth_kind=relative");
    const std::string path = options.inputFile("depth");
    if (cv::utils::fs::isDirectory(path))
        folder_ = path;
    else
        files_ = filesFor(path, inputs);
    for (const Input& input : inputs.inputs)
    {
        const bool isVideoFile = input.isFile() && isVideo(input.name);
        if (isVideoFile && folder_.empty())
            throw UsageError("--depth of a video is a folder with a file for each frame: " + stem(input.name) +
                             "_000000.png for the first one");
        if (isVideoFile)
        {
            std::vector<cv::String> frames;
            cv::utils::fs::glob(folder_, stem(input.name) + "_*", frames);
            files_.insert(files_.end(), frames.begin(), frames.end());
        }
        else if (!folder_.empty())
            files_.push_back(fileOf(input));
    }
}

std::string DepthSource::fileOf(const Input& image) const
{
    if (!folder_.empty())
        return fileIn(folder_, stem(image.name));
    return files_.empty() ? "" : files_.at(size_t(image.number));
}

std::string DepthSource::fileOfFrame(const std::string& video, int frame) const
{
    return folder_.empty() ? "" : fileIn(folder_, stem(video) + cv::format("_%06d", frame));
}

} // namespace rsackermann_samples
