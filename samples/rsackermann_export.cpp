// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Writes the motion that rsackermann_correct has found in the forms that other tools read.

#include "camera_settings.hpp"
#include "export/exports.hpp"
#include "output/atomic_file.hpp"
#include "output/output_plan.hpp"
#include "output/result_names.hpp"
#include "opencv2/rsackermann/warp.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace {

using namespace rsackermann_samples;

const char* const ABOUT =
    "Writes the motion that rsackermann_correct has found in the forms that other tools read (doc/exports.md).\n"
    "The camera is that of the report.\n"
    "Exit code: 0 done, 1 failed, 2 the command line isn't understood.\n";

const char* const KEYS =
    "{help          |       | print this message}"
    "{report        |       | report of rsackermann_correct}"
    "{motion        |       | instead of a report: file of cv::FileStorage with an AckermannMotion}"
    "{size          |       | WIDTHxHEIGHT of the images in pixels, if neither the camera file nor the report has it}"
    "{row_poses     |       | JSON file: poses of the first and the last line of each frame, and of lines between that shake}"
    "{colmap        |       | folder: cameras.txt and masks of the corrected images}"
    "{stmap         |       | folder: an STMap for each frame and direction, NAME.rectify and NAME.distort}"
    "{stmap_format  | png   | png (16 bits) or exr}"
    "{tracks        |       | CSV file with points of the raw images, columns file, x, y and maybe depth}"
    "{tracks_output |       | CSV file: the same table with the points of the corrected images}"
    "{points        |       | CSV file with points of a lidar in the frame of the camera, columns file, x, y and z in "
    "metres}"
    "{points_output |       | CSV file: the same table with u and v, the places in the raw images}"
    "{gcsv          |       | gyro log of Gyroflow: the rates of a drive's frames at their times}"
    "{mesh          |       | JSON file: a coarse grid with the places of its nodes}"
    "{mesh_size     | 17x10 | nodes in a row and in a column}"
    "{overwrite     |       | replace existing files}";

// That of the report, with what the options say.
cv::rsackermann::RollingShutterCamera readCamera(const Options& options, const std::vector<MotionFrame>& frames)
{
    const bool isOfReport =
        !frames.empty() && frames[0].hasCamera && !options.given("camera") && !options.given("focal");
    CameraSettings settings = readCameraOptions(options);
    settings.needsReadOut = false; // the report has it
    cv::Size size = options.given("size") ? parseSize(options.text("size"), "option --size", 1, 65535) : cv::Size();
    if (size.empty() && !frames.empty())
        size = frames[0].size;
    if (size.empty())
        size = settings.size;
    if (size.area() == 0)
        throw UsageError("--size is missing: the size of the images isn't known");
    const cv::rsackermann::RollingShutterCamera given = settings.makeCamera(size);
    if (!isOfReport)
        return given;
    cv::rsackermann::RollingShutterCamera camera = frames[0].camera;
    camera.imageSize = size;
    camera.uprightRotation = given.uprightRotation;
    if (options.given("line_delay") || options.given("readout"))
        camera.lineDelay = given.lineDelay;
    if (options.given("scan"))
        camera.scanDirection = given.scanDirection;
    if (options.given("reference"))
        camera.referenceRow = given.referenceRow;
    if (options.given("heading"))
        camera.heading = given.heading;
    if (options.given("height"))
        camera.height = given.height;
    return camera;
}

// The report has what was used, which may be of a log instead of an option.
void warnOfOtherTilt(const Options& options, const std::string& name, double MotionFrame::*used,
                     const std::vector<MotionFrame>& frames)
{
    const double rounding = 1e-6, given = options.given(name) ? options.number(name, -MOST_TILT, MOST_TILT) : 0;
    const auto isOther = [&](const MotionFrame& frame) { return std::abs(given - frame.*used) > rounding; };
    const auto other = std::find_if(frames.begin(), frames.end(), isOther);
    if (options.given(name) && other != frames.end())
        options.warn(cv::format("%s was corrected with a %s of %g degrees, which counts, not --%s",
                                other->name().c_str(), name.c_str(), (*other).*used, name.c_str()));
}

// Before anything is written. A point is as good as a map to show whether the motion can be followed.
void checkFrames(const Options& options, const cv::rsackermann::RollingShutterCamera& camera,
                 const std::vector<MotionFrame>& frames)
{
    warnOfOtherTilt(options, "roll", &MotionFrame::roll, frames);
    warnOfOtherTilt(options, "pitch", &MotionFrame::pitch, frames);
    const auto generator = cv::rsackermann::WarpMapGenerator::create(camera);
    for (const MotionFrame& frame : frames)
    {
        generator->setCamera(frame.cameraOf(camera));
        try
        {
            cv::Mat place;
            generator->distortPoints(frame.motion, std::vector<cv::Point2d>(1), place);
        }
        catch (const cv::Exception& e)
        {
            throw InputError(frame.name() + ": " + e.err);
        }
        for (const char* name : {"stmap", "mesh"})
            if (frame.isDepthUsed && options.given(name))
                throw InputError(frame.name() + " was corrected with a depth, which the report doesn't have: --" +
                                 name + " can't follow it");
    }
}

void checkResults(const Options& options)
{
    for (const char* name : {"row_poses", "colmap", "stmap", "tracks", "points", "gcsv", "mesh"})
        if (options.given(name))
            return;
    throw UsageError("nothing to do: give --row_poses, --colmap, --stmap, --tracks, --points, --gcsv or --mesh");
}

// No result may replace an input, an image or video of the report or another result, or, unless that is wanted, a file.
void checkTargets(const Options& options, const std::vector<MotionFrame>& frames)
{
    OutputPlan plan;
    plan.addInputs(options.inputFiles());
    for (const MotionFrame& frame : frames)
        plan.addInput(frame.input);
    for (const char* name : {"tracks", "points"})
        if (options.given(name))
            plan.addInput(options.inputFile(name));
    std::vector<std::string> results;
    const auto addOutput = [&](const std::string& path, const std::string& source) {
        plan.addOutput(path, source);
        results.push_back(path);
    };
    for (const char* name : {"row_poses", "tracks_output", "points_output", "gcsv", "mesh"})
        if (options.given(name))
            addOutput(options.outputFile(name), std::string("--") + name);
    const bool hasMasks = options.given("colmap"), hasStMaps = options.given("stmap");
    if (hasMasks)
        addOutput(options.outputFile("colmap") + "/cameras.txt", "--colmap");
    std::set<std::pair<std::string, int>> planned; // a report may have a frame twice, and the last line counts
    for (const MotionFrame& frame : frames)
    {
        if (!planned.insert(std::make_pair(frame.input, frame.frame)).second)
            continue;
        if (hasMasks)
            addOutput(colmapMask(options.text("colmap"), frame), frame.input);
        for (const char* direction : {"rectify", "distort"})
            if (hasStMaps)
                addOutput(stMapFile(options.outputFile("stmap"), frame, direction, options.text("stmap_format")),
                          frame.input);
    }
    for (const std::string& path : results)
        checkResult(path, options.flag("overwrite"));
    plan.removeLeftovers();
}

typedef std::map<std::string, std::string> Texts; // by their paths

// A table with places instead of points. What it holds is no matter of the command line.
std::string placesOf(const std::string& path, const cv::rsackermann::RollingShutterCamera& camera,
                     const std::vector<MotionFrame>& frames,
                     std::string (*place)(const std::string&, const cv::rsackermann::RollingShutterCamera&,
                                          const std::vector<MotionFrame>&))
{
    try
    {
        return place(path, camera, frames);
    }
    catch (const UsageError& e)
    {
        throw InputError(e.what());
    }
}

// What the files are made from is read, and may be refused, before any of them is written.
Texts textsOf(const Options& options, const cv::rsackermann::RollingShutterCamera& camera,
              const std::vector<MotionFrame>& frames, const cv::Size& nodes)
{
    Texts texts;
    if (options.given("gcsv"))
        texts[options.text("gcsv")] = gyroLogText(camera, frames);
    if (options.given("row_poses"))
        texts[options.text("row_poses")] = rowPosesText(camera, frames);
    if (options.given("tracks"))
        texts[options.text("tracks_output")] = placesOf(options.text("tracks"), camera, frames, correctTracks);
    if (options.given("points"))
        texts[options.text("points_output")] = placesOf(options.text("points"), camera, frames, cloudInRawImages);
    if (options.given("mesh"))
        texts[options.text("mesh")] = warpMeshText(camera, frames, nodes.width, nodes.height);
    return texts;
}

// All of them or none.
void writeTexts(const Texts& texts)
{
    AtomicFiles files;
    for (const auto& text : texts)
        files.add(text.first).write(text.second.data(), text.second.size());
    files.commit();
}

int run(const Options& options)
{
    options.refuseArguments();
    if (options.given("report") == options.given("motion"))
        throw UsageError("either --report or --motion is needed");
    for (const std::string name : {"tracks", "points"})
        if (options.given(name) != options.given(name + "_output"))
            throw UsageError("--" + name + " and --" + name + "_output belong together");
    for (const auto& pair : {std::make_pair("stmap_format", "stmap"), std::make_pair("mesh_size", "mesh")})
        if (options.given(pair.first) && !options.given(pair.second))
            throw UsageError(std::string("--") + pair.first + " needs --" + pair.second);
    const std::string format = options.text("stmap_format");
    if (format != "png" && format != "exr")
        throw UsageError("option --stmap_format: " + format + " is neither png nor exr");
    const cv::Size nodes = parseSize(options.text("mesh_size"), "option --mesh_size", 2, 1000);

    const std::vector<MotionFrame> frames =
        options.given("report") ? readReport(options.inputFile("report")) : readMotionFile(options.inputFile("motion"));
    const cv::rsackermann::RollingShutterCamera camera = readCamera(options, frames);
    checkResults(options);
    checkTargets(options, frames);
    checkFrames(options, camera, frames);
    writeTexts(textsOf(options, camera, frames, nodes));
    if (options.given("colmap"))
        writeColmap(options.text("colmap"), camera, frames);
    if (options.given("stmap"))
        writeStMaps(options.text("stmap"), format, camera, frames);
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, std::string(KEYS) + CAMERA_KEYS, run, argc, argv);
}
