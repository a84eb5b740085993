// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Writes a page to look at from a report of rsackermann_correct and the images.

#include "files.hpp"
#include "output/atomic_file.hpp"
#include "output/output_plan.hpp"
#include "output/result_names.hpp"
#include "page/page_text.hpp"
#include "page/picture_names.hpp"
#include "page/pictures.hpp"
#include "progress.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include <climits>
#include <cstdio>
#include <iostream>
#include <set>

namespace {

using namespace rsackermann_samples;
using nlohmann::json;

const char* const ABOUT =
    "Writes an HTML page of what a report of rsackermann_correct says: the raw image and the corrected one of each\n"
    "frame under a slider, its status, and the motion over time. A browser opens it from the disk.\n"
    "Exit code: 0 done, 1 failed, or pictures are missing on the page, 2 the command line isn't understood.\n";

const char* const KEYS =
    "{help      |     | print this message}"
    "{report    |     | report of rsackermann_correct; it names the raw images}"
    "{corrected |     | corrected images, as --output of rsackermann_correct: a folder, or the file of the only input}"
    "{overlay   |     | pictures of the segments, as --overlay of rsackermann_correct: a folder, or a file}"
    "{output    |     | HTML file to be written}"
    "{width     | 640 | most pixels of a picture's width}"
    "{embed     | 100 | up to so many frames have their pictures in the page; those of more are in the folder NAME_files "
    "beside it}"
    "{overwrite |     | replace an existing page and its pictures}";

struct Picture
{
    size_t frame;
    std::string kind, source, name; //!< the name is that in the folder beside the page
};

struct Task
{
    std::string report, output, folder; //!< folder of the pictures; empty: they are in the page
    std::vector<json> frames;
    std::vector<Picture> pictures;
    std::set<std::string> oldPictures; //!< those beside an older page of this name
    int width;
};

// Where rsackermann_correct has put the result for an input.
std::string resultOf(const std::string& target, const std::string& name, bool isOnly)
{
    const bool isFolder = target.back() == '/' || cv::utils::fs::isDirectory(target);
    if (!isFolder && !isOnly)
        throw UsageError(target + " isn't a folder, but the report has several inputs");
    return resultPath(target, isFolder, name);
}

void listPictures(const Options& options, Task& task)
{
    for (size_t i = 0; i < task.frames.size(); i++)
    {
        const std::string input = task.frames[i]["input"];
        const bool isOnly = task.frames[0]["input"] == input;
        const auto add = [&](const char* kind, const std::string& source) {
            task.pictures.push_back({i, kind, source, pictureName(i, kind)});
        };
        add("raw", input);
        if (task.frames[i]["status"] == "failed")
            continue;
        if (options.given("overlay"))
            add("overlay", resultOf(options.text("overlay"), overlayName(input), isOnly));
        if (options.given("corrected"))
            add("corrected", resultOf(options.text("corrected"), fileName(input), isOnly));
    }
}

Task readTask(const Options& options)
{
    options.refuseArguments();
    for (const char* name : {"report", "output"})
        if (!options.given(name))
            throw UsageError(std::string("--") + name + " is missing");
    Task task;
    task.report = options.inputFile("report");
    task.output = options.outputFile("output");
    task.width = options.integer("width", 16, 65535);
    task.frames = readPageFrames(task.report);
    const std::string folder = task.output.substr(0, task.output.size() - extension(task.output).size()) + "_files";
    if (task.frames.size() > size_t(options.integer("embed", 0, INT_MAX)))
        task.folder = folder;
    listPictures(options, task);
    OutputPlan plan;
    plan.addInputs(options.inputFiles());
    for (const Picture& picture : task.pictures)
        plan.addInput(picture.source);
    plan.addOutput(task.output, "the page");
    if (options.flag("overwrite"))
        for (const std::string& path : picturesIn(folder))
            task.oldPictures.insert(path);
    std::set<std::string> others = task.oldPictures;
    for (const Picture& picture : task.pictures)
        if (!task.folder.empty())
        {
            plan.addOutput(task.folder + "/" + picture.name, picture.source);
            others.erase(task.folder + "/" + picture.name);
        }
    for (const std::string& path : others)
        plan.addOutput(path, "an older page");
    checkResult(task.output, options.flag("overwrite"));
    if (!options.flag("overwrite") && cv::utils::fs::exists(task.folder))
        throw InputError(task.folder + " exists (--overwrite replaces it)");
    plan.removeLeftovers();
    return task;
}

int run(const Options& options)
{
    Task task = readTask(options);
    std::map<std::string, PictureMaker> makers; // by kind: each reads a video of its own
    Progress progress;
    int made = 0, missing = 0;
    for (const Picture& picture : task.pictures)
    {
        json& frame = task.frames[picture.frame];
        try
        {
            const std::vector<uchar> bytes =
                makers[picture.kind].make(picture.source, frame.value("frame", -1), task.width);
            if (!task.folder.empty())
            {
                writeFile(task.folder + "/" + picture.name, std::string(bytes.begin(), bytes.end()));
                task.oldPictures.erase(task.folder + "/" + picture.name);
            }
            frame[picture.kind] = task.folder.empty() ? dataAddress(bytes) : picture.name;
        }
        catch (const std::exception& e)
        {
            if (frame["status"] != "failed" && missing++ == 0) // of failed ones the report says why
                std::cerr << "rsackermann_page: " << picture.source << ": " << e.what() << std::endl;
        }
        progress.update(++made, double(task.pictures.size()), task.output);
    }
    writeFile(task.output,
              pageText({{"report", task.report}, {"folder", fileName(task.folder)}, {"frames", task.frames}}));
    for (const std::string& path : task.oldPictures) // to which the page doesn't lead
        std::remove(path.c_str());
    if (missing > 0)
        std::cerr << "rsackermann_page: " << missing << " pictures are missing on the page" << std::endl;
    return missing > 0 ? 1 : 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, KEYS, run, argc, argv);
}
