// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "camera_of_report.hpp"
#include "camera_settings.hpp"
#include "units.hpp"

#include <cmath>

namespace rsackermann_samples {

using namespace cv::rsackermann;

static const std::vector<std::string> LENS_WORDS = {"pinhole", "fisheye"}; // of cv::rsackermann::LensModel

nlohmann::ordered_json cameraForReport(const RollingShutterCamera& camera)
{
    nlohmann::ordered_json node;
    node["matrix"] = std::vector<double>(camera.cameraMatrix.val, camera.cameraMatrix.val + 9);
    node["distortion"] = camera.distCoeffs;
    node["lens"] = LENS_WORDS[size_t(camera.lensModel)];
    node["scan"] = SCAN_WORDS[size_t(camera.scanDirection)];
    node["line_delay_s"] = camera.lineDelay;
    node["reference_line"] = camera.referenceRow;
    node["heading_deg"] = camera.heading / DEGREE;
    node["height_m"] = camera.height;
    return node;
}

RollingShutterCamera cameraOfReport(const nlohmann::json& node, const cv::Size& size, const std::string& source)
{
    const std::vector<double> matrix = node.at("matrix").get<std::vector<double>>();
    if (matrix.size() != 9)
        throw InputError(source + " has a camera whose matrix doesn't have 9 numbers");
    RollingShutterCamera camera(size, cv::Matx33d(matrix.data()), node.at("distortion").get<std::vector<double>>(),
                                parseWord(node.at("lens").get<std::string>(), source, LENS_WORDS));
    camera.scanDirection = parseWord(node.at("scan").get<std::string>(), source, SCAN_WORDS);
    camera.lineDelay = node.at("line_delay_s").get<double>();
    camera.referenceRow = node.at("reference_line").get<double>();
    camera.heading = node.at("heading_deg").get<double>() * DEGREE;
    camera.height = node.at("height_m").get<double>();
    try
    {
        camera.check();
    }
    catch (const cv::Exception& e)
    {
        throw InputError(source + " has a camera that can't be: " + e.err);
    }
    return camera;
}

std::string differenceOf(const RollingShutterCamera& a, const RollingShutterCamera& b)
{
    const nlohmann::ordered_json nodes[] = {cameraForReport(a), cameraForReport(b)};
    const auto isNear = [](const nlohmann::ordered_json& x, const nlohmann::ordered_json& y) {
        const double rounding = 1e-9; // of degrees
        return x.is_number() ? std::abs(x.get<double>() - y.get<double>()) <= rounding * std::abs(x.get<double>())
                             : x == y;
    };
    for (const auto& value : nodes[0].items())
        if (!isNear(value.value(), nodes[1].at(value.key())))
            return value.key();
    return "";
}

} // namespace rsackermann_samples
