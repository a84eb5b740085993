// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "exports.hpp"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace rsackermann_samples {

using namespace cv::rsackermann;

namespace {

typedef nlohmann::ordered_json Json;

const double LARGEST_BEND = 0.01; // pixels by which lines may turn beyond what is interpolated between two poses

// Names of gsplat's RollingShutterType and of 3DGUT's ShutterType, in the order of ScanDirection.
const char* const SHUTTERS[] = {"ROLLING_TOP_TO_BOTTOM", "ROLLING_BOTTOM_TO_TOP", "ROLLING_LEFT_TO_RIGHT",
                                "ROLLING_RIGHT_TO_LEFT"};

// The unit of length of AckermannMotion::pose() in another unit.
struct LengthUnit
{
    const char* name;
    double perUnit; // of these in one of pose()'s
};

LengthUnit lengthUnit(const RollingShutterCamera& camera, const AckermannMotion& m)
{
    const double wall = std::hypot(m.wallSlope, m.wallOffset), road = std::abs(m.roadSlope);
    if (m.wallDistance > 0 && wall > 0)
        return {"metre", wall * m.wallDistance};
    if (wall > 0)
        return {"left_wall_distance", wall};
    if (camera.height > 0 && road > 0)
        return {"metre", road * camera.height};
    return {"camera_height", road};
}

double timeOf(const RollingShutterCamera& camera, double line)
{
    return camera.rowTime(cv::Point2d(line, line));
}

// The 4 x 4 matrix from the world, the camera frame at the reference line, to the camera frame at a row time.
Json viewMatrix(const RollingShutterCamera& camera, const AckermannMotion& motion, double time, double scale)
{
    cv::Matx33d R;
    cv::Vec3d T;
    motion.pose(camera, time, R, T);
    const cv::Vec3d t = -(R.t() * (T * scale));
    Json rows = Json::array();
    for (int i = 0; i < 3; i++)
        rows.push_back({R(0, i), R(1, i), R(2, i), t[i]});
    rows.push_back({0, 0, 0, 1});
    return rows;
}

// Pixels by which the line in the middle of two others is turned beyond their mean.
double bendBetween(const RollingShutterCamera& camera, const AckermannMotion& motion, double from, double to)
{
    cv::Matx33d R[3];
    cv::Vec3d T;
    for (int i = 0; i < 3; i++)
        motion.pose(camera, timeOf(camera, from + (to - from) * i / 2), R[i], T);
    const cv::Matx33d beyond = R[1] - (R[0] + R[2]) * 0.5;
    return cv::norm(beyond) / std::sqrt(2.) * std::max(camera.cameraMatrix(0, 0), camera.cameraMatrix(1, 1));
}

// Into how many equal parts a curve of rotations divides the read-out until they are straight: its knots to begin with.
int straightParts(const RollingShutterCamera& camera, const AckermannMotion& motion, int first, int last)
{
    int parts = motion.rotationCurve.rows - 1;
    for (; parts < std::abs(last - first); parts *= 2)
    {
        const double step = double(last - first) / parts;
        double bend = 0;
        for (int i = 0; i < parts; i++)
            bend = std::max(bend, bendBetween(camera, motion, first + i * step, first + (i + 1) * step));
        if (bend <= LARGEST_BEND)
            break;
    }
    return parts;
}

} // namespace

std::string rowPosesText(const RollingShutterCamera& camera, const std::vector<MotionFrame>& frames)
{
    const bool upwards = camera.scanDirection == SCAN_BOTTOM_TO_TOP || camera.scanDirection == SCAN_RIGHT_TO_LEFT;
    const int lines = camera.isRowShutter() ? camera.imageSize.height : camera.imageSize.width;
    const int first = upwards ? lines - 1 : 0, last = upwards ? 0 : lines - 1;

    Json json;
    json["width"] = camera.imageSize.width;
    json["height"] = camera.imageSize.height;
    json["shutter"] = SHUTTERS[camera.scanDirection];
    json["line_delay_s"] = camera.lineDelay > 0 ? Json(camera.lineDelay) : Json();
    json["start_line"] = first;
    json["end_line"] = last;
    json["reference_line"] = camera.referenceRow;
    json["frames"] = Json::array();
    const std::vector<std::string> names = namesInTables(frames);
    for (size_t i = 0; i < frames.size(); i++)
    {
        const MotionFrame& f = frames[i];
        const AckermannMotion motion = f.motion.status == MOTION_OK ? f.motion : AckermannMotion();
        const RollingShutterCamera own = f.cameraOf(camera);
        const LengthUnit unit = lengthUnit(own, motion);
        Json frame;
        frame["file"] = names[i];
        frame["moves"] = f.motion.status == MOTION_OK;
        frame["unit"] = unit.name;
        frame["viewmat_start"] = viewMatrix(own, motion, timeOf(own, first), unit.perUnit);
        frame["viewmat_end"] = viewMatrix(own, motion, timeOf(own, last), unit.perUnit);
        const int parts = motion.rotationCurve.empty() ? 0 : straightParts(own, motion, first, last);
        for (int k = 0; parts > 0 && k <= parts; k++)
        {
            const double line = first + double(last - first) * k / parts;
            frame["viewmats"].push_back(
                {{"line", line}, {"viewmat", viewMatrix(own, motion, timeOf(own, line), unit.perUnit)}});
        }
        json["frames"].push_back(frame);
    }
    // A file's name needn't be valid UTF-8.
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace rsackermann_samples
