// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Compares results of rsackermann_correct with the truth of rsackermann_simulate.

#include "export/frames.hpp"
#include "json_text.hpp"
#include "map_distance.hpp"
#include "options.hpp"
#include "files.hpp"
#include "parsable_text.hpp"
#include "truth_file.hpp"

#include "opencv2/rsackermann/warp.hpp"

#include <cmath>
#include <cstdio>

namespace {

using namespace rsackermann_samples;

const char* const ABOUT =
    "Compares the results of rsackermann_correct with the truth of rsackermann_simulate: motion, and mean\n"
    "displacement of the pixels before and after the correction.\n"
    "Exit code: 0 done, 1 failed, 2 the command line isn't understood.\n";

const char* const KEYS = "{help   | | print this message}"
                         "{truth  | | truth.json of rsackermann_simulate}"
                         "{maps   | | maps of rsackermann_correct}"
                         "{report | | report of rsackermann_correct; its last line counts}";

nlohmann::json lastLine(const std::string& path)
{
    std::ifstream file = openText(path);
    if (!file)
        throw InputError(path + " can't be read");
    std::string last;
    for (std::string line; std::getline(file, line);)
        last = isBlank(line) ? last : line;
    const nlohmann::json json = parseJson(last, false);
    if (!json.is_object())
        throw InputError(path + " is not a report");
    return json;
}

bool isMapOf(const cv::FileNode& node, const cv::Size& size)
{
    if (!node.isMap() || !node["data"].isSeq() || node["data"].size() != size_t(size.area()))
        return false;
    for (const cv::FileNode& element : node["data"])
        if (!element.isInt() && !element.isReal())
            return false;
    return node["rows"].isInt() && node["cols"].isInt() && int(node["rows"]) == size.height &&
           int(node["cols"]) == size.width && node["dt"].isString() && std::string(node["dt"]) == "f";
}

void readMap(const cv::FileStorage& maps, const char* key, const std::string& path, const cv::Size& size, cv::Mat& map)
{
    // Looked at before cv::FileNode takes the memory for the size that is stated.
    if (!isMapOf(maps[key], size))
        throw InputError(cv::format("%s: %s is no matrix of floats of the truth's size, %d x %d", path.c_str(), key,
                                    size.width, size.height));
    maps[key] >> map;
}

void readMaps(const std::string& path, const cv::Size& size, cv::Mat& map1, cv::Mat& map2)
{
    const size_t longestNumber = 64, others = 1 << 16; // characters
    const cv::FileStorage maps = readStorage(path, others + 2 * longestNumber * size_t(size.area()));
    readMap(maps, "map1", path, size, map1);
    readMap(maps, "map2", path, size, map2);
}

// The maps that rsackermann_correct has made of the report's motion are these.
void checkMaps(const Options& options, const nlohmann::json& line, const cv::Mat& map1, const cv::Mat& map2)
{
    const std::string report = options.text("report");
    if (line.value("status", "") == "failed")
        throw InputError("the last input of " + report + " has failed");
    const cv::Size size(line.value("width", map1.cols), line.value("height", map1.rows));
    if (size != map1.size())
        throw InputError(cv::format("the last input of %s has %d x %d pixels, but the truth %d x %d", report.c_str(),
                                    size.width, size.height, map1.cols, map1.rows));
    if (!line.contains("camera")) // as in reports of before 0.2
        return;
    const MotionFrame frame = frameOfLine(line, report);
    if (frame.isDepthUsed)
        return;
    cv::Mat own1, own2, distance;
    cv::rsackermann::WarpMapGenerator::create(frame.cameraOf(frame.camera))->initRectifyMap(frame.motion, own1, own2);
    double largest = 0;
    cv::magnitude(own1 - map1, own2 - map2, distance);
    cv::minMaxLoc(distance, 0, &largest, 0, 0, placesOf(own1, own2) & placesOf(map1, map2));
    if (largest > 0.01)
        throw InputError(cv::format("%s isn't of %s, the last input of %s: the maps of its motion differ by up to %.3g "
                                    "px",
                                    options.text("maps").c_str(), frame.name().c_str(), report.c_str(), largest));
}

void printRow(const char* what, double truth, const nlohmann::json& estimated)
{
    std::printf("%-26s %10.3f ", what, truth);
    if (estimated.is_number())
        std::printf("%10.3f\n", estimated.get<double>());
    else
        std::printf("%10s\n", "-");
}

int run(const Options& options)
try
{
    options.refuseArguments();
    for (const char* name : {"truth", "maps", "report"})
        if (!options.given(name))
            throw UsageError(std::string("--") + name + " is missing");

    const Truth truth = readTruth(options.text("truth"));
    const nlohmann::json report = lastLine(options.text("report"));
    cv::Mat estimated[2], identity[2], exact[2], mask;
    readMaps(options.text("maps"), truth.camera.size, estimated[0], estimated[1]);
    checkMaps(options, report, estimated[0], estimated[1]);
    identityMaps(truth.camera.size, identity[0], identity[1]);
    street::StreetRenderer(truth.camera, truth.scene).rectifyMap(exact[0], exact[1], mask);

    std::printf("status %s, model %s, %d of %d candidates agree\n\n", report.value("status", "?").c_str(),
                report.value("model", "?").c_str(), report.value("inliers", 0), report.value("candidates", 0));
    std::printf("%-26s %10s %10s\n", "", "true", "estimated");
    printRow("yaw rate, deg/s", truth.scene.yawRate * 180 / CV_PI, report.value("yaw_rate_deg_s", nlohmann::json()));
    printRow("speed, km/h", truth.scene.speed * 3.6, report.value("speed_km_h", nlohmann::json()));
    if (std::cos(truth.scene.wallDirection) > 0.5) // the camera looks along the street
    {
        nlohmann::json vanishingPoint = report.value("delta", nlohmann::json());
        if (vanishingPoint.is_number())
            vanishingPoint = vanishingPoint.get<double>() * truth.camera.fx;
        printRow("vanishing point, px", std::tan(truth.scene.wallDirection) * truth.camera.fx, vanishingPoint);
    }
    if (truth.scene.left > 0 && truth.scene.right > 0)
        printRow("wall distances, left/right", truth.scene.left / truth.scene.right,
                 report.value("wall_ratio", nlohmann::json()));
    // Before and after are compared at the same pixels.
    const int seen = cv::countNonZero(mask);
    mask &= placesOf(estimated[0], estimated[1]);
    const int compared = cv::countNonZero(mask);
    std::printf("\n%-26s %10s %10s\n", "", "before", "after");
    if (compared > 0)
        std::printf("%-26s %10.3f %10.3f\n", "mean displacement, px",
                    meanDistance(identity[0], identity[1], exact[0], exact[1], mask),
                    meanDistance(estimated[0], estimated[1], exact[0], exact[1], mask));
    else
        std::printf("%-26s %10s %10s\n", "mean displacement, px", "-", "-");
    if (compared < seen)
        std::printf("%d of %d pixels have no place in the estimated maps and don't count\n", seen - compared, seen);
    return 0;
}
catch (const nlohmann::json::exception& e)
{
    throw InputError("the last line of " + options.text("report") + ": " + messageOf(e));
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, KEYS, run, argc, argv);
}
