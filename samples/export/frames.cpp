// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "frames.hpp"
#include "camera_of_report.hpp"
#include "files.hpp"
#include "motion_words.hpp"
#include "options.hpp"
#include "parsable_text.hpp"
#include "json_text.hpp"
#include "units.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace rsackermann_samples {

using namespace cv::rsackermann;

MotionFrame::MotionFrame()
    : frame(-1), time(std::numeric_limits<double>::quiet_NaN()), roll(std::numeric_limits<double>::quiet_NaN()),
      pitch(std::numeric_limits<double>::quiet_NaN()), hasCamera(false), isDepthUsed(false)
{
}

RollingShutterCamera MotionFrame::cameraOf(const RollingShutterCamera& common) const
{
    if (size.area() > 0 && size != common.imageSize)
        throw InputError(cv::format("%s has %d x %d pixels, but the camera %d x %d", name().c_str(), size.width,
                                    size.height, common.imageSize.width, common.imageSize.height));
    const std::string difference = hasCamera ? differenceOf(camera, common) : "";
    if (!difference.empty())
        throw InputError(name() + " was corrected with a camera of another " + difference +
                         " (without options for the camera it is that of the report)");
    RollingShutterCamera own = common;
    if (!std::isnan(roll) && !std::isnan(pitch))
        own.setRollPitch(roll * DEGREE, pitch * DEGREE);
    return own;
}

void MotionFrame::checkMetres() const
{
    const bool translates = motion.wallSlope != 0 || motion.wallOffset != 0 || motion.roadSlope != 0;
    if (translates && motion.wallDistance <= 0 && motion.scale == SCALE_UNKNOWN)
        throw InputError(name() + ": its points have depths in metres, but its motion hasn't: give --speed, --wall or "
                                  "--scale_from_road to rsackermann_correct");
}

static std::string withNumber(const std::string& input, int frame)
{
    return frame < 0 ? input : input + cv::format(".%06d", frame);
}

std::string MotionFrame::name() const
{
    return withNumber(fileName(input), frame);
}

std::string MotionFrame::path() const
{
    return withNumber(input, frame);
}

std::vector<std::string> namesInTables(const std::vector<MotionFrame>& frames)
{
    std::map<std::string, std::set<std::string>> paths;
    for (const MotionFrame& frame : frames)
        paths[frame.name()].insert(frame.path());
    std::vector<std::string> names;
    for (const MotionFrame& frame : frames)
        names.push_back(paths[frame.name()].size() > 1 ? frame.path() : frame.name());
    return names;
}

namespace {

typedef nlohmann::json Json;

// A number of the line; 0 if it is null.
double numberOf(const Json& line, const char* key)
{
    const Json& value = line.at(key);
    return value.is_null() ? 0 : value.get<double>();
}

// The inverse-depth offset of a frame of a sequence.
void readOffset(const Json& offset, const std::string& source, AckermannMotion& motion)
{
    const std::vector<double> values = offset.at("values").get<std::vector<double>>(),
                              area = offset.at("area").get<std::vector<double>>();
    const int columns = offset.at("columns").get<int>();
    if (area.size() != 4 || columns < 4 || values.size() % size_t(columns) != 0 || values.size() / size_t(columns) < 4)
        throw InputError(
            source + " has a relief (inverse-depth offset) that isn't at least 4 x 4 values over an area of 4 numbers");
    motion.inverseDepthOffset = cv::Mat(values, true).reshape(1, int(values.size()) / columns);
    motion.offsetArea = cv::Rect2d(area[0], area[1], area[2], area[3]);
}

// By how much the rows of a frame turn beyond its rates.
void readCurve(const Json& vectors, const std::string& source, AckermannMotion& motion)
{
    for (const std::vector<double>& vector : vectors.get<std::vector<std::vector<double>>>())
    {
        if (vector.size() != 3)
            throw InputError(source + " has a rotation_curve that isn't of vectors of 3 numbers");
        motion.rotationCurve.push_back(cv::Mat(vector, true).reshape(1, 1));
    }
}

AckermannMotion motionOf(const Json& line, const std::string& source)
{
    AckermannMotion motion;
    motion.status = parseWord(line.at("status"), source, STATUS_WORDS);
    if (motion.status != MOTION_OK)
        return motion;
    motion.alpha = numberOf(line, "alpha");
    motion.wallSlope = numberOf(line, "beta");
    motion.wallOffset = numberOf(line, "wall_offset");
    motion.wallRatio = numberOf(line, "wall_ratio");
    motion.roadSlope = numberOf(line, "road_slope");
    motion.direction = numberOf(line, "direction") < 0 ? -1 : 1;
    // Reports of before 0.2 haven't them.
    motion.pitchRate = line.contains("pitch_rate") ? numberOf(line, "pitch_rate") : 0;
    motion.rollRate = line.contains("roll_rate") ? numberOf(line, "roll_rate") : 0;
    motion.rollCorrection = numberOf(line, "roll_correction_deg") * DEGREE;
    motion.pitchCorrection = numberOf(line, "pitch_correction_deg") * DEGREE;
    if (line.contains("heading_correction_deg"))
        motion.headingCorrection = numberOf(line, "heading_correction_deg") * DEGREE;
    motion.wallDistance = numberOf(line, "wall_distance_m");
    motion.scale = parseWord(line.at("scale"), source, SCALE_WORDS);
    if (line.contains("relief"))
        readOffset(line.at("relief"), source, motion);
    if (line.contains("rotation_curve"))
        readCurve(line.at("rotation_curve"), source, motion);
    return motion;
}

} // namespace

MotionFrame frameOfLine(const nlohmann::json& line, const std::string& source)
{
    MotionFrame frame;
    frame.input = line.at("input").get<std::string>();
    frame.frame = line.value("frame", -1);
    frame.time = line.value("time_s", frame.time);
    frame.size = cv::Size(line.value("width", 0), line.value("height", 0));
    frame.roll = line.value("roll_deg", frame.roll);
    frame.pitch = line.value("pitch_deg", frame.pitch);
    frame.hasCamera = line.contains("camera"); // reports of before 0.2 don't
    if (frame.hasCamera)
        frame.camera = cameraOfReport(line.at("camera"), frame.size, source);
    frame.isDepthUsed = line.contains("depth_used") && line.at("depth_used") == true;
    frame.motion = motionOf(line, source);
    return frame;
}

std::vector<MotionFrame> readReport(const std::string& path)
{
    std::vector<MotionFrame> frames;
    readReportLines(path, [&](const Json& line, const std::string& source) {
        if (line.at("status") != "failed")
            frames.push_back(frameOfLine(line, source));
    });
    if (frames.empty())
        throw InputError(path + " has no lines but of inputs that failed");
    return frames;
}

std::vector<MotionFrame> readMotionFile(const std::string& path)
try
{
    const cv::FileStorage fs = readStorage(path);
    const cv::FileNode node = fs["motion"].isMap() ? fs["motion"] : fs.root();
    for (const char* key : {"status", "rms"}) // the first and the last one that are written
        if (node[key].empty())
            throw InputError(path + " holds no motion, or a part of one: it lacks " + key);
    MotionFrame frame;
    frame.input = fs["input"].isString() ? std::string(fs["input"]) : std::string("frame.png");
    frame.motion.read(node);
    return {frame};
}
catch (const cv::Exception& e)
{
    throw InputError(path + " holds no motion: " + e.err);
}

} // namespace rsackermann_samples
