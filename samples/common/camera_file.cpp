// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "camera_file.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include <cmath>
#include <fstream>
#include <functional>
#include <yaml-cpp/yaml.h>

namespace rsackermann_samples {

using namespace cv::rsackermann;

namespace {

//! Looks a key up; false where the file hasn't it.
typedef std::function<bool(const std::string& key, double& value)> NumberSource;
typedef std::function<bool(const std::string& key, std::string& value)> TextSource;

void require(bool condition, const std::string& message)
{
    if (!condition)
        throw UsageError(message);
}

// The keys that all formats may have.
void readShutterAndMounting(const NumberSource& number, const TextSource& text, CameraSettings& s)
{
    const bool delay = number("line_delay", s.lineDelay), readOut = number("readout", s.readOut);
    require(!delay || !readOut, "line_delay and readout exclude each other");
    require(s.lineDelay >= 0 && s.readOut >= 0, "line_delay and readout must not be negative");
    number("roll", s.roll);
    number("pitch", s.pitch);
    number("heading", s.heading);
    number("camera_height", s.height);
    require(std::abs(s.pitch) < 90, "pitch must be between -90 and 90 degrees");
    require(s.height >= 0, "camera_height must not be negative");
    std::string word;
    if (text("scan", word))
        s.scan = parseWord(word, "scan", SCAN_WORDS);
    text("reference", s.reference);
}

void setIntrinsics(const std::vector<double>& k, CameraSettings& s)
{
    require(k.size() == 9, "the camera matrix hasn't 9 elements");
    for (int i = 0; i < 9; i++)
        s.K.val[i] = k[i];
    s.calibrated = true;
}

void readOpenCv(const std::string& path, CameraSettings& s)
{
    cv::FileStorage fs(path, cv::FileStorage::READ);
    require(fs.isOpened(), "can't be read");
    cv::Mat k, lens;
    fs["camera_matrix"] >> k;
    fs["distortion_coefficients"] >> lens;
    require(!k.empty(), "has no camera_matrix");
    k.convertTo(k, CV_64F);
    setIntrinsics(std::vector<double>(k.reshape(1, 1)), s);
    if (!lens.empty())
    {
        lens.convertTo(lens, CV_64F);
        s.lens = std::vector<double>(lens.reshape(1, 1));
    }
    s.lensModel = int(fs["fisheye_model"]) ? LENS_FISHEYE : LENS_PINHOLE;
    s.size = cv::Size(int(fs["image_width"]), int(fs["image_height"]));
    readShutterAndMounting(
        [&](const std::string& key, double& value) {
            const cv::FileNode node = fs[key];
            if (node.empty())
                return false;
            require(node.isInt() || node.isReal(), key + " is not a number");
            value = double(node);
            return true;
        },
        [&](const std::string& key, std::string& value) {
            const cv::FileNode node = fs[key];
            if (node.empty())
                return false;
            value = node.isString() ? std::string(node) : cv::format("%.17g", double(node));
            return true;
        },
        s);
}

// The first of the nodes that exists.
YAML::Node firstOf(const YAML::Node& root, std::initializer_list<const char*> keys)
{
    for (const char* key : keys)
        if (root[key])
            return root[key];
    return YAML::Node(YAML::NodeType::Undefined);
}

std::vector<double> numbersOf(const YAML::Node& node)
{
    return (node.IsMap() ? node["data"] : node).as<std::vector<double> >();
}

void readRos(const YAML::Node& root, CameraSettings& s)
{
    setIntrinsics(numbersOf(firstOf(root, {"camera_matrix", "K", "k"})), s);
    const YAML::Node lens = firstOf(root, {"distortion_coefficients", "D", "d"}), model = root["distortion_model"];
    const std::string word = model ? model.as<std::string>() : "plumb_bob";
    require(word == "plumb_bob" || word == "rational_polynomial" || word == "equidistant" || word == "fisheye",
            "distortion_model " + word + " isn't known");
    s.lensModel = word == "equidistant" || word == "fisheye" ? LENS_FISHEYE : LENS_PINHOLE;
    if (lens.IsDefined())
        s.lens = numbersOf(lens);
    const YAML::Node width = firstOf(root, {"image_width", "width"}), height = firstOf(root, {"image_height", "height"});
    if (width.IsDefined() && height.IsDefined())
        s.size = cv::Size(width.as<int>(), height.as<int>());
}

void readKalibr(const YAML::Node& camera, CameraSettings& s)
{
    const std::string model = camera["camera_model"].as<std::string>();
    require(model == "pinhole", "camera_model " + model + " isn't known, only pinhole is");
    const std::vector<double> f = camera["intrinsics"].as<std::vector<double> >();
    require(f.size() == 4, "intrinsics haven't 4 elements");
    setIntrinsics({f[0], 0, f[2], 0, f[1], f[3], 0, 0, 1}, s);
    const YAML::Node lens = camera["distortion_model"];
    const std::string word = lens ? lens.as<std::string>() : "none";
    require(word == "none" || word == "radtan" || word == "equidistant", "distortion_model " + word + " isn't known");
    s.lensModel = word == "equidistant" ? LENS_FISHEYE : LENS_PINHOLE;
    if (word != "none")
        s.lens = camera["distortion_coeffs"].as<std::vector<double> >();
    if (camera["resolution"])
    {
        const std::vector<int> size = camera["resolution"].as<std::vector<int> >();
        require(size.size() == 2, "resolution hasn't 2 elements");
        s.size = cv::Size(size[0], size[1]);
    }
}

void readYaml(const std::string& path, CameraSettings& s)
{
    const YAML::Node file = YAML::LoadFile(path);
    require(file.IsMap(), "is neither a calibration of OpenCV nor a camera_info of ROS nor a camchain of Kalibr");
    const YAML::Node root = file["cam0"] ? file["cam0"] : file;
    if (root["intrinsics"])
        readKalibr(root, s);
    else if (firstOf(root, {"camera_matrix", "K", "k"}).IsDefined())
        readRos(root, s);
    else
        throw UsageError("has neither camera_matrix (OpenCV, ROS) nor cam0 (Kalibr)");
    readShutterAndMounting(
        [&](const std::string& key, double& value) {
            if (root[key])
                value = root[key].as<double>();
            return bool(root[key]);
        },
        [&](const std::string& key, std::string& value) {
            if (root[key])
                value = root[key].as<std::string>();
            return bool(root[key]);
        },
        s);
}

// FileStorage knows its files by how they begin.
bool isOpenCvFile(const std::string& path)
{
    std::ifstream file(path.c_str(), std::ios::binary);
    char begin[6] = {0};
    file.read(begin, 5);
    const std::string text = begin;
    return text == "%YAML" || text == "<?xml" || (!text.empty() && text[0] == '{');
}

} // namespace

void readCameraFile(const std::string& path, CameraSettings& settings)
{
    try
    {
        require(cv::utils::fs::exists(path) && !cv::utils::fs::isDirectory(path), "there is no such file");
        if (isOpenCvFile(path))
            readOpenCv(path, settings);
        else
            readYaml(path, settings);
        require(settings.size.width >= 0 && settings.size.height >= 0, "the image's size is negative");
        // A camera of any size shows whether the values make sense.
        settings.makeCamera(settings.size.area() > 0 ? settings.size : cv::Size(640, 480)).check();
    }
    catch (const UsageError& e)
    {
        throw UsageError("camera file " + path + ": " + e.what());
    }
    catch (const YAML::Exception& e)
    {
        throw UsageError("camera file " + path + ": " + e.what());
    }
    catch (const cv::Exception& e)
    {
        throw UsageError("camera file " + path + ": " + e.err);
    }
}

void writeCameraFile(const std::string& path, const CameraSettings& s)
{
    cv::FileStorage fs(path, cv::FileStorage::WRITE);
    if (!fs.isOpened())
        throw InputError(path + " can't be written");
    fs << "image_width" << s.size.width << "image_height" << s.size.height << "camera_matrix" << cv::Mat(s.K);
    fs << "distortion_coefficients" << cv::Mat(1, int(s.lens.size()), CV_64F, const_cast<double*>(s.lens.data()));
    fs << "fisheye_model" << int(s.lensModel == LENS_FISHEYE);
    fs << (s.readOut > 0 ? "readout" : "line_delay") << (s.readOut > 0 ? s.readOut : s.lineDelay);
    fs << "scan" << SCAN_WORDS[s.scan] << "reference" << s.reference;
    fs << "roll" << s.roll << "pitch" << s.pitch << "heading" << s.heading << "camera_height" << s.height;
}

} // namespace rsackermann_samples
