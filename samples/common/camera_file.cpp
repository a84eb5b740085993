// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "camera_file.hpp"
#include "files.hpp"
#include "lens_profile.hpp"
#include "output/atomic_file.hpp"
#include "parsable_text.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <yaml-cpp/yaml.h>

namespace rsackermann_samples {

using namespace cv::rsackermann;

namespace {

//! Of the formats, and without effect here: what they say of the calibration itself and of other uses of the camera.
const std::set<std::string> OTHER_KEYS = {
    // samples of OpenCV
    "calibration_time", "calibration_date", "nframes", "nr_of_frames", "board_width", "board_height", "square_size",
    "marker_size", "aspectRatio", "fix_aspect_ratio", "flags", "avg_reprojection_error", "per_view_reprojection_errors",
    "extrinsic_parameters", "image_points", "grid_points",
    // camera_info of ROS
    "header", "camera_name", "rectification_matrix", "projection_matrix", "R", "P", "r", "p", "binning_x", "binning_y",
    "roi",
    // camchain of Kalibr
    "cam_overlaps", "rostopic", "T_cn_cnm1", "T_cam_imu", "timeshift_cam_imu"};

//! The uppermost map of a file, which remembers what it was asked for. @tparam Node of cv::FileStorage or yaml-cpp.
template <class Node>
class KeyedValues
{
public:
    explicit KeyedValues(const Node& map) : map_(map) {}

    Node operator[](const std::string& key) const
    {
        asked_.insert(key);
        return map_[key];
    }

    //! Those of the keys that have no effect, although they may be meant to, with commas between. Which of two equal
    //! ones is meant nobody knows.
    std::string unknown(const std::vector<std::string>& keys) const
    {
        std::string others;
        std::set<std::string> found;
        for (const std::string& key : keys)
        {
            if (!found.insert(key).second)
                throw UsageError(key + " is there twice");
            if (!asked_.count(key) && !OTHER_KEYS.count(key))
                others += (others.empty() ? "" : ", ") + key;
        }
        return others;
    }

private:
    const Node map_;
    mutable std::set<std::string> asked_;
};

typedef KeyedValues<cv::FileNode> StorageValues;
typedef KeyedValues<YAML::Node> YamlValues;

//! Looks a key up; false if the file hasn't it.
typedef std::function<bool(const std::string& key, double& value)> NumberSource;
typedef std::function<bool(const std::string& key, std::string& value)> TextSource;

void require(bool condition, const std::string& message)
{
    if (!condition)
        throw UsageError(message);
}

//! A number that all formats may have; 0 is that of a value that isn't known.
struct NumberKey
{
    const char* name;
    double CameraSettings::*value;
    double low, high;
    const char* meaning;
};

const double MOST_TILT_SIGMA = 45; // degrees, as of --gravity_sigma

const NumberKey NUMBER_KEYS[] = {
    {"line_delay", &CameraSettings::lineDelay, 0, LONGEST_READ_OUT, "seconds"},
    {"readout", &CameraSettings::readOut, 0, LONGEST_READ_OUT, "seconds"},
    {"roll", &CameraSettings::roll, -MOST_TILT, MOST_TILT,
     "degrees; turn the images of a camera that is mounted upside down or on its side, and with them scan and the "
     "principal point"},
    {"pitch", &CameraSettings::pitch, -MOST_TILT, MOST_TILT, "degrees"},
    {"heading", &CameraSettings::heading, -MOST_HEADING, MOST_HEADING, "degrees"},
    {"camera_height", &CameraSettings::height, 0, MOST_HEIGHT, "metres"},
    {"roll_sigma", &CameraSettings::rollSigma, 0, MOST_TILT_SIGMA, "degrees"},
    {"pitch_sigma", &CameraSettings::pitchSigma, 0, MOST_TILT_SIGMA, "degrees"},
    {"heading_sigma", &CameraSettings::headingSigma, 0, MOST_HEADING, "degrees"},
    {"line_delay_sigma", &CameraSettings::lineDelaySigma, 0, LONGEST_READ_OUT, "seconds"},
    {"focal_sigma", &CameraSettings::focalSigma, 0, MOST_FOCAL, "pixels"}};

// The keys that all formats may have.
void readShutterAndMounting(const NumberSource& number, const TextSource& text, CameraSettings& s)
{
    std::set<std::string> given;
    for (const NumberKey& key : NUMBER_KEYS)
        if (number(key.name, s.*key.value))
        {
            parseNumber(cv::format("%.10g", s.*key.value), std::string(key.name) + " (" + key.meaning + ")", key.low,
                        key.high);
            given.insert(key.name);
        }
    require(!given.count("line_delay") || !given.count("readout"), "line_delay and readout exclude each other");
    s.rollIsGiven = given.count("roll") > 0;
    s.pitchIsGiven = given.count("pitch") > 0;
    s.headingIsGiven = given.count("heading") > 0;
    std::string word;
    if (text("scan", word))
        s.scan = parseWord(word, "scan", SCAN_WORDS);
    if (text("reference", word))
        s.reference = parseReference(word, "reference");
}

void setIntrinsics(const std::vector<double>& k, CameraSettings& s)
{
    require(k.size() == 9, "the camera matrix hasn't 9 elements");
    for (int i = 0; i < 9; i++)
        s.K.val[i] = k[i];
    s.calibrated = true;
}

// A size must be one of images, and neither overflow nor be missing by half.
void setSize(double width, double height, CameraSettings& s)
{
    const double largest = 65535; // of most formats of images
    require(width == std::floor(width) && height == std::floor(height) && width >= 1 && height >= 1 &&
                width <= largest && height <= largest && width * height < 2147483648.,
            cv::format("the image's size %g x %g is none of an image", width, height));
    s.size = cv::Size(int(width), int(height));
}

double finite(double value, const std::string& key)
{
    require(std::isfinite(value), key + " is not a number");
    return value;
}

// The elements of a matrix of cv::FileStorage; none if it isn't there.
std::vector<double> matrixOf(const cv::FileNode& node)
{
    if (node.empty())
        return std::vector<double>();
    require(node.isMap() && node["rows"].isInt() && node["cols"].isInt(), node.name() + " is not a matrix");
    // cv::FileNode makes a matrix of the size that is stated before it looks for the elements.
    const int mostElements = 14, rows = node["rows"], cols = node["cols"];
    require(rows >= 0 && cols >= 0 && double(rows) * cols <= mostElements,
            cv::format("%s is %d x %d; a matrix of up to %d elements is accepted", node.name().c_str(), rows, cols,
                       mostElements));
    if (rows * cols == 0) // the elements are a list, or nothing in XML
        return std::vector<double>();
    require(node["data"].isSeq(), node.name() + " is not a matrix");
    for (const cv::FileNode& element : node["data"])
        require(element.isInt() || element.isReal(), node.name() + " has an element that is not a number");
    cv::Mat matrix;
    node >> matrix;
    require(matrix.channels() == 1, node.name() + " is not a matrix of numbers");
    matrix.convertTo(matrix, CV_64F);
    return std::vector<double>(matrix.reshape(1, 1));
}

// The words of ROS, which files with matrices of OpenCV may use as well.
int lensModelOf(const std::string& word)
{
    require(word == "plumb_bob" || word == "rational_polynomial" || word == "equidistant" || word == "fisheye",
            "distortion_model " + word + " isn't known");
    return word == "equidistant" || word == "fisheye" ? LENS_FISHEYE : LENS_PINHOLE;
}

int lensModelOf(const StorageValues& fs)
{
    const cv::FileNode flag = fs["fisheye_model"], word = fs["distortion_model"];
    require(flag.empty() || word.empty(), "fisheye_model and distortion_model exclude each other");
    require(flag.empty() || (flag.isInt() && (int(flag) == 0 || int(flag) == 1)), "fisheye_model is neither 0 nor 1");
    require(word.empty() || word.isString(), "distortion_model is not a word");
    if (!word.empty())
        return lensModelOf(std::string(word));
    return !flag.empty() && int(flag) ? LENS_FISHEYE : LENS_PINHOLE;
}

void readOpenCv(const std::string& text, CameraSettings& s)
{
    const cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    require(storage.isOpened(), "can't be read");
    const StorageValues fs(storage.root());
    const NumberSource number = [&](const std::string& key, double& value) {
        const cv::FileNode node = fs[key];
        if (node.empty())
            return false;
        require(node.isInt() || node.isReal(), key + " is not a number");
        value = finite(double(node), key);
        return true;
    };
    const std::vector<double> k = matrixOf(fs["camera_matrix"]);
    require(!k.empty(), "has no camera_matrix");
    setIntrinsics(k, s);
    s.lens = matrixOf(fs["distortion_coefficients"]);
    s.lensModel = lensModelOf(fs);
    double width = 0, height = 0;
    if (number("image_width", width) + number("image_height", height) > 0)
        setSize(width, height, s);
    readShutterAndMounting(
        number,
        [&](const std::string& key, std::string& value) {
            const cv::FileNode node = fs[key];
            if (node.empty())
                return false;
            value = node.isString() ? std::string(node) : cv::format("%.17g", double(node));
            return true;
        },
        s);
    s.unknownKeys = fs.unknown(storage.root().keys());
}

// The first of the nodes that exists.
YAML::Node firstOf(const YamlValues& root, std::initializer_list<const char*> keys)
{
    for (const char* key : keys)
        if (root[key])
            return root[key];
    return YAML::Node(YAML::NodeType::Undefined);
}

std::vector<double> numbersOf(const YAML::Node& node)
{
    return (node.IsMap() ? node["data"] : node).as<std::vector<double>>();
}

void readRos(const YamlValues& root, CameraSettings& s)
{
    setIntrinsics(numbersOf(firstOf(root, {"camera_matrix", "K", "k"})), s);
    const YAML::Node lens = firstOf(root, {"distortion_coefficients", "D", "d"}), model = root["distortion_model"];
    s.lensModel = model ? lensModelOf(model.as<std::string>()) : LENS_PINHOLE;
    if (lens.IsDefined())
        s.lens = numbersOf(lens);
    const YAML::Node width = firstOf(root, {"image_width", "width"}),
                     height = firstOf(root, {"image_height", "height"});
    require(width.IsDefined() == height.IsDefined(), "the image's width or height is missing");
    if (width.IsDefined())
        setSize(width.as<double>(), height.as<double>(), s);
}

void readKalibr(const YamlValues& camera, CameraSettings& s)
{
    const std::string model = camera["camera_model"].as<std::string>();
    require(model == "pinhole", "camera_model " + model + " isn't known, only pinhole is");
    const std::vector<double> f = camera["intrinsics"].as<std::vector<double>>();
    require(f.size() == 4, "intrinsics haven't 4 elements");
    setIntrinsics({f[0], 0, f[2], 0, f[1], f[3], 0, 0, 1}, s);
    const YAML::Node lens = camera["distortion_model"];
    const std::string word = lens ? lens.as<std::string>() : "none";
    require(word == "none" || word == "radtan" || word == "equidistant", "distortion_model " + word + " isn't known");
    s.lensModel = word == "equidistant" ? LENS_FISHEYE : LENS_PINHOLE;
    if (word != "none")
        s.lens = camera["distortion_coeffs"].as<std::vector<double>>();
    if (camera["resolution"])
    {
        const std::vector<double> size = camera["resolution"].as<std::vector<double>>();
        require(size.size() == 2, "resolution hasn't 2 elements");
        setSize(size[0], size[1], s);
    }
}

// The first camera of a file of Kalibr, cam0 if it is there; the file itself if it is none of Kalibr.
YAML::Node firstCamera(const YAML::Node& file, std::string& severalCameras)
{
    std::set<std::string> names;
    for (const auto& entry : file)
    {
        const std::string name = entry.first.Scalar();
        if (name.size() > 3 && name.compare(0, 3, "cam") == 0 &&
            name.find_first_not_of("0123456789", 3) == std::string::npos)
            names.insert(name);
    }
    if (names.empty())
        return file;
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + name;
    if (names.size() > 1)
        severalCameras = list + ": " + *names.begin();
    return file[*names.begin()];
}

void readYaml(const std::string& text, CameraSettings& s)
{
    // cv::FileStorage writes a directive that isn't YAML.
    const bool hasDirective = text.compare(0, 5, "%YAML") == 0;
    const YAML::Node file = YAML::Load(hasDirective ? text.substr(std::min(text.find('\n'), text.size())) : text);
    require(
        file.IsMap(),
        "is neither a calibration of OpenCV nor a camera_info of ROS nor a camchain of Kalibr nor a lens profile of "
        "Gyroflow");
    const YAML::Node map = firstCamera(file, s.severalCameras);
    const YamlValues root(map);
    if (root["intrinsics"])
        readKalibr(root, s);
    else if (firstOf(root, {"camera_matrix", "K", "k"}).IsDefined())
        readRos(root, s);
    else
        throw UsageError("has neither camera_matrix (OpenCV, ROS) nor cam0 (Kalibr) nor fisheye_params (Gyroflow)");
    readShutterAndMounting(
        [&](const std::string& key, double& value) {
            if (root[key])
                value = finite(root[key].as<double>(NAN), key);
            return bool(root[key]);
        },
        [&](const std::string& key, std::string& value) {
            if (root[key])
                value = root[key].as<std::string>();
            return bool(root[key]);
        },
        s);
    std::vector<std::string> keys;
    for (const auto& entry : map)
        keys.push_back(entry.first.Scalar());
    s.unknownKeys = root.unknown(keys);
}

// Files of cv::FileStorage are known by how they begin and by their matrices.
bool isOpenCvFile(const std::string& text)
{
    return text.compare(0, 5, "<?xml") == 0 || text.find("opencv-matrix") != std::string::npos;
}

} // namespace

void readCameraFile(const std::string& path, CameraSettings& settings)
{
    try
    {
        require(cv::utils::fs::exists(path) && !cv::utils::fs::isDirectory(path), "there is no such file");
        const std::string text = readParsableText(path);
        if (isOpenCvFile(text))
            readOpenCv(text, settings);
        else if (isLensProfile(text))
            readLensProfile(text, settings);
        else
            readYaml(text, settings);
        // A camera shows whether the values make sense; if its size is unknown, one with the principal point as centre.
        CameraSettings own = settings;
        own.compatible.clear();
        const auto side = [](double centre) { return int(std::min(std::max(1., 2 * centre + 1), 65535.)); };
        own.makeCamera(own.size.empty() ? cv::Size(side(own.K(0, 2)), side(own.K(1, 2))) : own.size).check();
        for (const CompatibleSetting& setting : settings.compatible)
            if (setting.refusal.empty())
                settings.with(setting).makeCamera(setting.size).check();
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
    catch (const std::exception& e) // out of OpenCV's parser
    {
        throw UsageError("camera file " + path + ": " + e.what());
    }
}

std::string cameraText(const CameraSettings& s, const std::string& format)
{
    cv::FileStorage fs(format, cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
    fs << "image_width" << s.size.width << "image_height" << s.size.height << "camera_matrix" << cv::Mat(s.K);
    fs << "distortion_coefficients" << cv::Mat(1, int(s.lens.size()), CV_64F, const_cast<double*>(s.lens.data()));
    fs << "fisheye_model" << int(s.lensModel == LENS_FISHEYE);
    fs << (s.readOut > 0 ? "readout" : "line_delay") << (s.readOut > 0 ? s.readOut : s.lineDelay);
    fs << "scan" << SCAN_WORDS[s.scan] << "reference" << s.reference;
    if (s.rollIsGiven)
        fs << "roll" << s.roll;
    if (s.pitchIsGiven)
        fs << "pitch" << s.pitch;
    if (s.headingIsGiven)
        fs << "heading" << s.heading;
    fs << "camera_height" << s.height;
    const std::pair<const char*, double> sigmas[] = {{"roll_sigma", s.rollSigma},
                                                     {"pitch_sigma", s.pitchSigma},
                                                     {"heading_sigma", s.headingSigma},
                                                     {"line_delay_sigma", s.lineDelaySigma},
                                                     {"focal_sigma", s.focalSigma}};
    for (const std::pair<const char*, double>& sigma : sigmas)
        if (sigma.second > 0)
            fs << sigma.first << sigma.second;
    return fs.releaseAndGetString();
}

void writeCameraFile(const std::string& path, const CameraSettings& settings)
{
    writeFile(path, cameraText(settings, extension(path)));
}

} // namespace rsackermann_samples
