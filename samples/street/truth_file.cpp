// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "truth_file.hpp"
#include "json_text.hpp"
#include "units.hpp"
#include "options.hpp"
#include "files.hpp"

#include <climits>
#include <iterator>

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

// What doesn't fit into an integer can't be converted to one.
static double inRange(const std::string& path, const nlohmann::json& json, const char* key, double low, double high)
{
    const double value = json.at(key);
    if (!(value >= low && value <= high))
        throw InputError(cv::format("%s: %s is %g; %g to %g is expected", path.c_str(), key, value, low, high));
    return value;
}

Truth readTruth(const std::string& path)
try
{
    std::ifstream file = openText(path);
    if (!file)
        throw InputError(path + " can't be read");
    const nlohmann::json json = parseJson(std::string(std::istreambuf_iterator<char>(file), {}));
    const cv::Size size(int(inRange(path, json, "width", 1, 65535)), int(inRange(path, json, "height", 1, 65535)));
    Truth truth = {street::StreetCamera(size, 1, json.at("line_delay_s"), json.at("height_m")), street::StreetScene()};
    street::StreetCamera& c = truth.camera;
    street::StreetScene& s = truth.scene;
    s.yawRate = json.at("yaw_rate_deg_s").get<double>() * DEGREE;
    s.speed = json.at("speed_km_h").get<double>() * KMH;
    s.left = json.at("left_wall_m");
    s.right = json.at("right_wall_m");
    s.wallDirection = json.at("wall_direction_deg").get<double>() * DEGREE;
    s.stagger = json.at("stagger_m");
    s.obstacles = json.at("obstacles_per_100_m");
    s.stains = json.value("stains", 0.); // files of before 0.2 haven't it
    s.seed = unsigned(inRange(path, json, "seed", 0, UINT_MAX));
    c.fx = json.at("fx");
    c.fy = json.at("fy");
    c.cx = json.at("cx");
    c.cy = json.at("cy");
    c.lens = json.at("lens").get<std::vector<double>>();
    c.scan = int(inRange(path, json, "scan", 0, 3));
    c.reference = json.at("reference");
    c.roll = json.at("roll_deg").get<double>() * DEGREE;
    c.pitch = json.at("pitch_deg").get<double>() * DEGREE;
    c.heading = json.at("heading_deg").get<double>() * DEGREE;
    if (json.contains("shake"))
    {
        const int kind = parseWord(json.at("shake"), path, street::Shake::words());
        const double rate = inRange(path, json, "shake_rate_deg_s", 0, 1000) * DEGREE;
        c.shake = street::Shake(kind, rate, unsigned(inRange(path, json, "shake_seed", 0, UINT_MAX)));
    }
    // Files of before 0.2 haven't them.
    c.seconds = json.contains("time_s") ? inRange(path, json, "time_s", 0, 1e6) : 0;
    s.travelled = json.value("travelled_m", 0.);
    return truth;
}
catch (const nlohmann::json::exception& e)
{
    throw InputError(path + ": " + e.what());
}

} // namespace rsackermann_samples
