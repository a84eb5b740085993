// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "lens_profile.hpp"
#include "json_text.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace rsackermann_samples {

using namespace cv::rsackermann;

namespace {

typedef nlohmann::json Json;

const double LARGEST = 65535;      // pixels, of most formats of images
const double SAME_SHAPE = 0.001;   // by which factors of width and height differ, as in Gyroflow
const double LEAST_STRETCH = 0.01; // Gyroflow takes less for a stretch that isn't given
const char* const DIRECTIONS[] = {"TopToBottom", "BottomToTop", "LeftToRight", "RightToLeft"}; // as SCAN_WORDS

void require(bool condition, const std::string& message)
{
    if (!condition)
        throw UsageError(message);
}

// A number that no double holds and NaN, which isn't JSON, end the parser; the field is the last one that has begun.
// Which of two fields of one name is meant nobody knows.
Json parse(const std::string& text)
{
    std::string field;
    std::vector<std::set<std::string>> fields; // of the objects around
    try
    {
        return Json::parse(text, [&](int, Json::parse_event_t event, Json& value) {
            if (event == Json::parse_event_t::object_start)
                fields.emplace_back();
            else if (event == Json::parse_event_t::object_end)
                fields.pop_back();
            else if (event == Json::parse_event_t::key)
            {
                field = value.get<std::string>();
                require(fields.back().insert(field).second, field + " is there twice");
            }
            return true;
        });
    }
    catch (const Json::exception& e)
    {
        throw UsageError((field.empty() ? "" : field + ": ") + messageOf(e));
    }
}

double numberOf(const Json& value, const std::string& name)
{
    require(value.is_number(), name + ": " + value.dump() + " is not a number");
    return value.get<double>();
}

std::vector<double> numbersOf(const Json& list, const std::string& name)
{
    require(list.is_array(), name + " is not a list, but " + list.dump());
    std::vector<double> values;
    for (const Json& element : list)
        values.push_back(numberOf(element, name));
    return values;
}

//! A JSON object and what messages call it; null counts as missing.
class Fields
{
public:
    Fields(const Json& object, const std::string& prefix) : object_(object), prefix_(prefix) {}

    std::string nameOf(const std::string& key) const { return prefix_ + key; }
    bool has(const std::string& key) const { return object_.contains(key) && !object_.at(key).is_null(); }
    const Json& at(const std::string& key) const
    {
        require(has(key), nameOf(key) + " is missing");
        return object_.at(key);
    }
    Fields object(const std::string& key) const
    {
        const Json& value = at(key);
        require(value.is_object(), nameOf(key) + " is not an object, but " + value.dump());
        return Fields(value, nameOf(key) + ".");
    }
    double number(const std::string& key) const { return numberOf(at(key), nameOf(key)); }
    double number(const std::string& key, double otherwise) const { return has(key) ? number(key) : otherwise; }
    bool flag(const std::string& key) const
    {
        require(!has(key) || at(key).is_boolean(), nameOf(key) + " is neither true nor false");
        return has(key) && at(key).get<bool>();
    }
    //! Of another type it is the text of the file, which is none of the words that are known.
    std::string word(const std::string& key, const std::string& otherwise) const
    {
        if (!has(key))
            return otherwise;
        return at(key).is_string() ? at(key).get<std::string>() : at(key).dump();
    }
    std::vector<double> numbers(const std::string& key) const { return numbersOf(at(key), nameOf(key)); }

private:
    const Json& object_;
    std::string prefix_;
};

cv::Matx33d matrixOf(const Fields& params)
{
    const std::string name = params.nameOf("camera_matrix");
    const Json& rows = params.at("camera_matrix");
    require(rows.is_array() && rows.size() == 3, name + " hasn't 3 rows");
    cv::Matx33d K;
    for (int i = 0; i < 3; i++)
    {
        const std::vector<double> row = numbersOf(rows[size_t(i)], name + cv::format(", row %d", i + 1));
        require(row.size() == 3, name + cv::format(", row %d hasn't 3 numbers", i + 1));
        std::copy(row.begin(), row.end(), &K(i, 0));
    }
    require(K(0, 0) > 0 && K(1, 1) > 0, name + ": the focal length isn't above 0");
    return K;
}

double lengthOf(const Fields& dimension, const char* key)
{
    const double length = dimension.number(key);
    require(length == std::floor(length) && length >= 2 && length <= LARGEST,
            dimension.nameOf(key) + cv::format(": %g is none of an image", length));
    return length;
}

double stretchOf(const Fields& profile, const char* key)
{
    const double stretch = profile.number(key, 1);
    require(std::abs(stretch) <= 100, profile.nameOf(key) + cv::format(": %g is none of a lens", stretch));
    return stretch > LEAST_STRETCH ? stretch : 1;
}

void readLens(const Fields& profile, CameraSettings& s)
{
    const std::string model = profile.word("distortion_model", "opencv_fisheye");
    require(model == "opencv_fisheye" || model == "opencv_standard",
            "distortion_model " + model + " isn't known, only opencv_fisheye and opencv_standard are");
    const std::string digital = profile.word("digital_lens", "");
    require(digital.empty(),
            profile.nameOf("digital_lens") + " " + digital + " isn't known: only lenses are undone, no other warps");
    s.lensModel = model == "opencv_fisheye" ? LENS_FISHEYE : LENS_PINHOLE;
    const Fields params = profile.object("fisheye_params");
    s.lens = params.numbers("distortion_coeffs");
    const size_t n = s.lens.size();
    require(n == 4 || (s.lensModel == LENS_PINHOLE && (n == 5 || n == 8 || n == 12)),
            params.nameOf("distortion_coeffs") + cv::format(" has %d numbers; ", int(n)) +
                (s.lensModel == LENS_FISHEYE ? "4 are expected" : "4, 5, 8 or 12 are expected"));
}

cv::Size2d sizeOf(const Fields& object, const char* width, const char* height)
{
    return cv::Size2d(lengthOf(object, width), lengthOf(object, height));
}

/** The camera matrix of the pixels of the file. Profiles of anamorphic lenses are calibrated with images that were
stretched to the right shape.
@param shown size of the images: of another shape than those of the calibration they are the middle of the sensor, else
they have other pixels. */
void readIntrinsics(const Fields& profile, const cv::Size2d& shown, CameraSettings& s)
{
    const cv::Size2d calibrated = sizeOf(profile.object("calib_dimension"), "w", "h");
    s.size = cv::Size(cvRound(shown.width / stretchOf(profile, "input_horizontal_stretch")),
                      cvRound(shown.height / stretchOf(profile, "input_vertical_stretch")));
    require(s.size.width >= 2 && s.size.height >= 2 && s.size.width <= LARGEST && s.size.height <= LARGEST,
            cv::format("input_horizontal_stretch and input_vertical_stretch make an image of %d x %d pixels",
                       s.size.width, s.size.height));
    s.K = matrixOf(profile.object("fisheye_params"));
    // Gyroflow uses the principal point of lenses that are said to be asymmetrical alone.
    if (!profile.flag("asymmetrical"))
    {
        s.K(0, 2) = (calibrated.width - 1) / 2;
        s.K(1, 2) = (calibrated.height - 1) / 2;
    }
    const double crop = profile.number("crop", 1);
    require(crop > 0 && crop <= 100, profile.nameOf("crop") + cv::format(": %g is not above 0 and up to 100", crop));
    s.K(0, 0) /= crop;
    s.K(1, 1) /= crop;
    const double widthFactor = shown.width / calibrated.width, heightFactor = shown.height / calibrated.height;
    if (std::abs(widthFactor - heightFactor) < SAME_SHAPE)
        s.K = scaledIntrinsics(s.K, widthFactor, heightFactor);
    else
    {
        s.K(0, 2) -= (calibrated.width - shown.width) / 2;
        s.K(1, 2) -= (calibrated.height - shown.height) / 2;
    }
    s.K = scaledIntrinsics(s.K, s.size.width / shown.width, s.size.height / shown.height);
    s.calibrated = s.isScaled = true;
}

void readShutter(const Fields& profile, CameraSettings& s)
{
    require(!profile.flag("global_shutter"), "global_shutter: there is no rolling shutter to be undone");
    const double seconds = profile.number("frame_readout_time", 0) / 1000;
    require(std::abs(seconds) <= LONGEST_READ_OUT,
            profile.nameOf("frame_readout_time") + cv::format(": %g is not from %g to %g ms", seconds * 1000,
                                                              -LONGEST_READ_OUT * 1000, LONGEST_READ_OUT * 1000));
    s.readOut = std::abs(seconds);
    const std::string direction =
        profile.word("frame_readout_direction", DIRECTIONS[seconds < 0 ? SCAN_BOTTOM_TO_TOP : SCAN_TOP_TO_BOTTOM]);
    s.scan = parseWord(direction, "frame_readout_direction", std::vector<std::string>(DIRECTIONS, DIRECTIONS + 4));
}

/** What an element of compatible_settings says of images of another size or mode; of the rest the profile counts.
@param name of the element. */
CompatibleSetting compatibleSetting(Json profile, const Json& element, const std::string& name)
{
    require(element.is_object(), name + " is not an object, but " + element.dump());
    for (const char* key :
         {"crop", "digital_lens", "frame_readout_time", "input_horizontal_stretch", "input_vertical_stretch"})
        if (element.contains(key))
            profile[key] = element.at(key);
    if (element.contains("distortion_coeffs"))
        profile["fisheye_params"]["distortion_coeffs"] = element.at("distortion_coeffs");
    const Fields fields(profile, name + "."), own(element, name + ".");
    const cv::Size2d shown =
        own.has("width") ? sizeOf(own, "width", "height") : sizeOf(fields.object("calib_dimension"), "w", "h");
    CameraSettings s;
    readIntrinsics(fields, shown, s);
    readShutter(fields, s);
    CompatibleSetting setting = {s.size, s.K, {}, s.readOut, s.scan, ""};
    try
    {
        readLens(fields, s);
        setting.lens = s.lens;
    }
    catch (const UsageError& e) // of other images it doesn't matter
    {
        setting.refusal = e.what();
    }
    return setting;
}

} // namespace

bool isLensProfile(const std::string& text)
{
    const size_t begin = text.find_first_not_of(" \t\r\n");
    return begin != std::string::npos && text[begin] == '{' &&
           (text.find("\"fisheye_params\"") != std::string::npos ||
            text.find("\"calib_dimension\"") != std::string::npos);
}

void readLensProfile(const std::string& text, CameraSettings& settings)
{
    const Json json = parse(text);
    const Fields profile(json, "");
    readLens(profile, settings);
    readIntrinsics(profile, sizeOf(profile.object("calib_dimension"), "w", "h"), settings);
    readShutter(profile, settings);
    if (!profile.has("compatible_settings"))
        return;
    const Json& list = profile.at("compatible_settings");
    require(list.is_array(), "compatible_settings is not a list, but " + list.dump());
    Json rest = json;
    rest.erase("compatible_settings");
    for (const Json& element : list)
        settings.compatible.push_back(
            compatibleSetting(rest, element, cv::format("compatible_settings[%d]", int(settings.compatible.size()))));
}

} // namespace rsackermann_samples
