// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "truth_file.hpp"
#include "json_text.hpp"
#include "units.hpp"
#include "options.hpp"
#include "files.hpp"

#include <algorithm>
#include <climits>
#include <cmath>
#include <iterator>
#include <set>

namespace rsackermann_samples {

static void addTo(nlohmann::ordered_json& json, const Truth& truth)
{
    const street::StreetCamera& c = truth.camera;
    const street::StreetScene& s = truth.scene;
    json["yaw_rate_deg_s"] = s.yawRate / DEGREE;
    json["speed_km_h"] = s.speed / KMH;
    json["left_wall_m"] = s.left;
    json["right_wall_m"] = s.right;
    json["wall_direction_deg"] = s.wallDirection / DEGREE;
    json["stagger_m"] = s.stagger;
    json["obstacles_per_100_m"] = s.obstacles;
    json["stains"] = s.stains;
    json["seed"] = s.seed;
    json["height_m"] = c.height;
    json["width"] = c.size.width;
    json["height"] = c.size.height;
    json["fx"] = c.fx;
    json["fy"] = c.fy;
    json["cx"] = c.cx;
    json["cy"] = c.cy;
    json["lens"] = c.lens;
    json["line_delay_s"] = c.lineDelay;
    json["scan"] = c.scan;
    json["reference"] = c.reference;
    json["roll_deg"] = c.roll / DEGREE;
    json["pitch_deg"] = c.pitch / DEGREE;
    json["heading_deg"] = c.heading / DEGREE;
    json["travelled_m"] = s.travelled;
    json["time_s"] = c.seconds;
    const cv::Matx44d view = street::viewMatrix(c, s);
    for (int i = 0; i < 4; i++)
        json["viewmat"].push_back({view(i, 0), view(i, 1), view(i, 2), view(i, 3)});
    if (c.shake.kind() != street::Shake::NONE)
    {
        json["shake"] = street::Shake::words()[size_t(c.shake.kind())];
        json["shake_rate_deg_s"] = c.shake.rate() / DEGREE;
        json["shake_seed"] = c.shake.seed();
    }
    const cv::Vec3d rates = street::turnRates(c, s.yawRate);
    json["camera_yaw_rate_deg_s"] = rates[1] / DEGREE;
    json["camera_pitch_rate_deg_s"] = (0 - rates[0]) / DEGREE; // positive if the camera looks further down
    json["camera_roll_rate_deg_s"] = rates[2] / DEGREE;
}

std::string truthText(const Truth& truth)
{
    nlohmann::ordered_json json;
    addTo(json, truth);
    return json.dump(2) + "\n";
}

std::string truthLine(const std::string& file, const Truth& truth)
{
    nlohmann::ordered_json json;
    json["file"] = file;
    addTo(json, truth);
    return json.dump() + "\n";
}

Truth readTruth(const std::string& path)
try
{
    std::ifstream file = openText(path);
    if (!file)
        throw InputError(path + " can't be read");
    const nlohmann::json json = parseJson(std::string(std::istreambuf_iterator<char>(file), {}));
    const auto number = [&](const char* key, double low, double high) {
        const nlohmann::json& value = json.at(key);
        if (!value.is_number() || value < low || value > high)
            throw InputError(
                cv::format("%s: %s is %s; %g to %g is expected", path.c_str(), key, value.dump().c_str(), low, high));
        return value.get<double>();
    };
    // Files of before 0.2 haven't all of them.
    const auto numberOrZero = [&](const char* key, double low, double high) {
        return json.contains(key) ? number(key, low, high) : 0;
    };
    const double LEAST = 1e-9; // of what must be above 0
    const cv::Size size(int(number("width", 1, 65535)), int(number("height", 1, 65535)));
    Truth truth = {street::StreetCamera(size, 1, number("line_delay_s", 0, 1), number("height_m", LEAST, 1000)),
                   street::StreetScene()};
    street::StreetCamera& c = truth.camera;
    street::StreetScene& s = truth.scene;
    s.yawRate = number("yaw_rate_deg_s", -1000, 1000) * DEGREE;
    s.speed = number("speed_km_h", -2000, 2000) * KMH;
    s.left = number("left_wall_m", 0, 1e4);
    s.right = number("right_wall_m", 0, 1e4);
    s.wallDirection = number("wall_direction_deg", -360, 360) * DEGREE;
    s.stagger = number("stagger_m", 0, 100);
    s.obstacles = number("obstacles_per_100_m", 0, 1000);
    s.stains = numberOrZero("stains", 0, 1);
    s.seed = unsigned(number("seed", 0, UINT_MAX));
    c.fx = number("fx", LEAST, 1e7);
    c.fy = number("fy", LEAST, 1e7);
    c.cx = number("cx", -1e6, 1e6);
    c.cy = number("cy", -1e6, 1e6);
    const nlohmann::json& lens = json.at("lens");
    if (!lens.is_array() ||
        !std::all_of(lens.begin(), lens.end(),
                     [](const nlohmann::json& k) { return k.is_number() && std::abs(k.get<double>()) <= 1e6; }) ||
        std::set<size_t>{0, 4, 5, 8}.count(lens.size()) == 0)
        throw InputError(path + ": lens is " + lens.dump() + "; 0, 4, 5 or 8 coefficients are expected");
    c.lens = lens.get<std::vector<double>>();
    c.scan = int(number("scan", 0, 3));
    c.reference = number("reference", -1e9, 1e9);
    c.roll = number("roll_deg", -90, 90) * DEGREE;
    c.pitch = number("pitch_deg", -90, 90) * DEGREE;
    c.heading = number("heading_deg", -360, 360) * DEGREE;
    if (json.contains("shake"))
    {
        const int kind = parseWord(json.at("shake"), path + ": shake", street::Shake::words());
        const double rate = number("shake_rate_deg_s", 0, 1000) * DEGREE;
        c.shake = street::Shake(kind, rate, unsigned(number("shake_seed", 0, UINT_MAX)));
    }
    c.seconds = numberOrZero("time_s", 0, 1e6);
    s.travelled = numberOrZero("travelled_m", -1e9, 1e9);
    return truth;
}
catch (const nlohmann::json::exception& e)
{
    throw InputError(path + ": " + messageOf(e));
}

} // namespace rsackermann_samples
