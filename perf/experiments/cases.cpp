// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "cases.hpp"
#include "table.hpp"

#include "opencv2/imgcodecs.hpp"
#include <cmath>

namespace experiments {

using namespace rsackermann_samples;

const char* const CASE_KEYS =
    "{photos     |        | folder with frames.csv (name,focal_px,roll_deg,pitch_deg,line_at_infinity_px) and "
    "global-shutter photographs of streets, to be used instead of renderings}"
    "{rest       |        | the car is at rest}"
    "{scenes     | 3      | number of rendered streets}"
    "{seed       | 0      | of the first rendered street and of the errors of what the estimator is given}"
    "{draws      | 1      | how often each image is used, with other errors of what the estimator is given}"
    "{speeds     |        | km/h, with commas between (default 10,42.5,75,107.5,140; with photographs 40,100)}"
    "{yaw_rates  |        | deg/s, with commas between (default 10,-10,30,-30,50,-50,70,-70; with photographs 30,-50)}"
    "{width      | 640    | of the rendered images, pixels; their height and the focal length go with it}"
    "{lens       |        | coefficients of the rendered camera's lens, as of cv::projectPoints, with commas between}"
    "{roll       | 0      | of the rendered camera, degrees}"
    "{pitch      | 0      | of the rendered camera, degrees}"
    "{direction  | 0      | of the rendered street and the car's motion, degrees to the right of the optical axis; "
    "90: the camera looks to the left and sees one wall, -90: to the right}"
    "{left       | 2.5    | metres to the left wall of the rendered street, 0: there is none}"
    "{right      | 3      | metres to its right wall, 0: there is none}"
    "{clutter    | 0      | share of slanted lines in the rendered streets, 0..1}"
    "{stagger    | 0      | metres: each rendered house stands back from its wall by its own amount between 0 and this}"
    "{obstacles  | 0      | parked cars, posts and leaning trees on 100 m of each side of the rendered streets; cars "
    "park only if the wall is 2.8 m away}"
    "{noise      | 1      | of the rendered images, grey levels}";

namespace {

const double DEGREE = CV_PI / 180, KMH = 1 / 3.6;
const double READ_OUT = 0.4 / 30; // seconds: 40 % of the time between two frames at 30 frames/s

std::vector<double> numbersOr(const Options& options, const std::string& name, const std::vector<double>& otherwise)
{
    return options.given(name) ? options.numbers(name) : otherwise;
}

std::vector<street::StreetScene> makeMotions(const Options& options, const std::vector<double>& speeds,
                                             const std::vector<double>& yawRates)
{
    std::vector<street::StreetScene> motions;
    if (options.flag("rest"))
        return std::vector<street::StreetScene>(1);
    for (double speed : numbersOr(options, "speeds", speeds))
        for (double yawRate : numbersOr(options, "yaw_rates", yawRates))
        {
            street::StreetScene scene;
            scene.speed = speed * KMH;
            scene.yawRate = yawRate * DEGREE;
            motions.push_back(scene);
        }
    return motions;
}

// The paper's camera and street. A camera that looks to a side sees the wall of that side only.
std::vector<Case> renderedCases(const Options& options)
{
    const int width = options.integer("width", 160, 16000), height = cvRound(width * 380 / 640.);
    street::StreetCamera camera(cv::Size(width, height), 816 * width / 640., READ_OUT / height, 1.2);
    const double direction = options.number("direction", -180, 180);
    if (options.given("lens"))
        camera.lens = options.numbers("lens");
    camera.roll = options.number("roll", -45, 45) * DEGREE;
    camera.pitch = options.number("pitch", -45, 45) * DEGREE;
    camera.heading = direction * DEGREE;
    const bool toTheLeft = direction > 45 && direction < 135, toTheRight = direction < -45 && direction > -135;
    const int first = options.integer("seed", 0, 1 << 20), count = options.integer("scenes", 1, 10000);
    std::vector<Case> cases;
    for (int i = 0; i < count; i++)
        for (street::StreetScene scene :
             makeMotions(options, {10, 42.5, 75, 107.5, 140}, {10, -10, 30, -30, 50, -50, 70, -70}))
        {
            scene.wallDirection = camera.heading;
            scene.left = toTheRight ? 0 : options.number("left", 0, 1000);
            scene.right = toTheLeft ? 0 : options.number("right", 0, 1000);
            scene.seed = unsigned(first + i);
            scene.clutter = options.number("clutter", 0, 1);
            scene.stagger = options.number("stagger", 0, 10);
            scene.obstacles = options.number("obstacles", 0, 100);
            scene.noise = options.number("noise", 0, 100);
            cases.push_back(Case(cv::format("street_%d", first + i), camera, scene));
        }
    return cases;
}

// Walls at 2.5 m and 3 m, camera at 1.6 m, the car follows the street.
std::vector<Case> photoCases(const Options& options)
{
    const std::string folder = options.text("photos") + "/";
    std::vector<Case> cases;
    for (const std::vector<std::string>& fields :
         readTable(folder + "frames.csv", {"name", "focal_px", "roll_deg", "pitch_deg", "line_at_infinity_px"}))
    {
        const cv::Mat photo = cv::imread(folder + fields[0]);
        if (photo.empty())
            throw InputError(folder + fields[0] + " can't be read");
        double values[4];
        for (int i = 0; i < 4; i++)
            values[i] = parseNumber(fields[i + 1], "frames.csv");
        street::StreetCamera camera(photo.size(), values[0], READ_OUT / photo.rows, 1.6);
        camera.roll = values[1] * DEGREE;
        camera.pitch = values[2] * DEGREE;
        camera.heading = std::atan(values[3] / values[0]);
        for (street::StreetScene scene : makeMotions(options, {40, 100}, {30, -50}))
        {
            scene.wallDirection = camera.heading;
            Case c(fields[0], camera, scene);
            c.photo = photo;
            cases.push_back(c);
        }
    }
    return cases;
}

} // namespace

std::vector<Case> makeCases(const Options& options)
{
    const std::vector<Case> images = options.given("photos") ? photoCases(options) : renderedCases(options);
    std::vector<Case> cases;
    for (int draws = options.integer("draws", 1, 1000); draws > 0; draws--)
        cases.insert(cases.end(), images.begin(), images.end());
    return cases;
}

} // namespace experiments
