// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "photo_sets.hpp"
#include "cases.hpp"
#include "drive.hpp"
#include "map_distance.hpp"
#include "table.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/imgcodecs.hpp"
#include "opencv2/imgproc.hpp"
#include <algorithm>
#include <fstream>

namespace paper {

using namespace cv::rsackermann;
using namespace rsackermann_samples;

namespace {

cv::Mat readImage(const std::string& file)
{
    const cv::Mat image = cv::imread(file);
    if (image.empty())
        throw InputError(file + " can't be read");
    return image;
}

PhotoSet distortedPhotographs(const std::string& folder)
{
    const std::string option = "--photos=" + folder;
    const char* const arguments[] = {"", option.c_str()};
    const std::vector<experiments::Case> cases = experiments::makeCases(Options(2, arguments, experiments::CASE_KEYS));
    const auto at = [cases](int i) {
        const experiments::Case c = cases[i];
        PhotoCase result;
        result.name =
            cv::format("%s %.0f km/h %.0f deg/s", c.name.c_str(), c.scene.speed * 3.6, c.scene.yawRate * 180 / CV_PI);
        result.camera = libraryCamera(c.camera);
        result.wallDistance = c.scene.left;
        result.image = experiments::makeImage(c);
        result.global = c.photo;
        result.measure = [c](const cv::Mat& columns, const cv::Mat& rows, double& before, double& after) {
            cv::Mat identity[2], truth[2], mask;
            identityMaps(c.camera.size, identity[0], identity[1]);
            street::StreetRenderer(c.camera, c.scene).rectifyMap(truth[0], truth[1], mask);
            before = meanDistance(identity[0], identity[1], truth[0], truth[1], mask);
            after = meanDistance(columns, rows, truth[0], truth[1], mask);
        };
        return result;
    };
    return {"photographs", "displacement_px", folder, int(cases.size()), at};
}

PhotoSet framesWithTruth(const std::string& folder)
{
    const std::vector<std::vector<std::string>> table =
        experiments::readTable(folder + "/frames.csv", {"name", "focal_px", "roll_deg", "pitch_deg", "heading_deg"});
    const auto at = [folder, table](int i) {
        double values[4];
        for (int k = 0; k < 4; k++)
            values[k] = parseNumber(table[i][k + 1], "frames.csv");
        const std::string files = folder + "/" + table[i][0];
        PhotoCase result;
        result.name = table[i][0];
        result.image = readImage(files + "/rolling.png");
        result.global = readImage(files + "/global_middle.png");
        result.camera = RollingShutterCamera::fromFocal(result.image.size(), values[0]);
        result.camera.setRollPitch(values[1] * CV_PI / 180, values[2] * CV_PI / 180);
        result.camera.heading = values[3] * CV_PI / 180;
        result.wallDistance = 0;
        const cv::Mat image = result.image, global = result.global;
        result.measure = [image, global](const cv::Mat& columns, const cv::Mat& rows, double& before, double& after) {
            cv::Mat corrected = image.clone();
            cv::remap(image, corrected, columns, rows, cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
            before = cv::PSNR(image, global);
            after = cv::PSNR(corrected, global);
        };
        return result;
    };
    return {"frames", "psnr_db", folder, int(table.size()), at};
}

PhotoSet drive(const std::string& folder)
{
    const int every = 6;
    const std::vector<experiments::DriveFrame> frames = experiments::readDrive(folder);
    const auto at = [frames, every](int i) {
        const experiments::DriveFrame& frame = frames[i * every];
        PhotoCase result;
        result.name = frame.file.substr(frame.file.find_last_of('/') + 1);
        result.camera = frame.camera;
        result.wallDistance = 0;
        result.image = readImage(frame.file);
        const experiments::FlowTruth truth(frame, result.image, readImage(frames[i * every + 1].file));
        result.measure = [truth](const cv::Mat& columns, const cv::Mat& rows, double& before, double& after) {
            truth.measure(columns, rows, before, after);
        };
        return result;
    };
    return {"drive", "displacement_px", folder, std::max(0, int(frames.size()) - 2) / every + 1, at};
}

void addSet(const std::string& folder, std::vector<PhotoSet>& sets)
{
    std::ifstream file((folder + "/frames.csv").c_str());
    std::string header;
    std::getline(file, header);
    if (header.find("line_at_infinity_px") != std::string::npos)
        sets.push_back(distortedPhotographs(folder));
    else if (header.find("line_delay_s") != std::string::npos)
        sets.push_back(drive(folder));
    else if (header.compare(0, 13, "name,focal_px") == 0)
        sets.push_back(framesWithTruth(folder));
}

} // namespace

std::vector<PhotoSet> findPhotoSets(const std::string& folder)
{
    if (!cv::utils::fs::isDirectory(folder))
        throw InputError(folder + " isn't a folder");
    std::vector<cv::String> tables;
    cv::utils::fs::glob(folder, "frames.csv", tables, true);
    std::sort(tables.begin(), tables.end());
    std::vector<PhotoSet> sets;
    for (const cv::String& table : tables)
        addSet(cv::utils::fs::getParent(table), sets);
    if (sets.empty())
        throw InputError(folder + " has no frames.csv of a known kind");
    return sets;
}

} // namespace paper
