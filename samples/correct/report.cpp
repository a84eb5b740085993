// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "report.hpp"
#include "options.hpp"
#include "units.hpp"

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

namespace rsackermann_samples {

using namespace cv::rsackermann;

namespace {

typedef nlohmann::ordered_json Json;

Json orNull(bool known, double value)
{
    return known ? Json(value) : Json();
}

const char* modelWord(int model)
{
    switch (model)
    {
    case MODEL_1LA:
        return "1la";
    case MODEL_3LA:
        return "3la";
    case MODEL_4LA:
        return "4la";
    default:
        return "none";
    }
}

} // namespace

std::string reportLine(const FrameReport& frame)
{
    static const char* const statuses[] = {"ok", "not_significant", "too_few_segments", "no_consensus", "not_observable"};
    const AckermannMotion& m = frame.motion;
    const bool ok = m.status == MOTION_OK;
    double yawRate = 0, speed = 0;
    const bool yawRateKnown = ok && m.yawRate(frame.camera, yawRate), speedKnown = ok && m.speed(frame.camera, speed);

    Json line;
    line["input"] = frame.input;
    if (frame.frame >= 0)
        line["frame"] = frame.frame;
    line["status"] = statuses[m.status];
    line["model"] = modelWord(m.model);
    line["alpha"] = orNull(ok, m.alpha);
    line["beta"] = orNull(ok, m.wallSlope);
    line["delta"] = orNull(ok && m.wallSlope != 0, m.delta());
    line["wall_ratio"] = orNull(ok && m.wallRatio > 0, m.wallRatio);
    line["yaw_rate_deg_s"] = orNull(yawRateKnown, yawRate / DEGREE);
    line["speed_km_h"] = orNull(speedKnown, speed / KMH);
    const cv::Matx44d covariance = m.metricCovariance(frame.camera);
    line["yaw_rate_sigma"] = orNull(yawRateKnown && covariance(0, 0) > 0, std::sqrt(covariance(0, 0)) / DEGREE);
    line["speed_sigma"] = orNull(speedKnown && covariance(1, 1) > 0, std::sqrt(covariance(1, 1)) / KMH);
    line["segments"] = frame.segments;
    line["candidates"] = m.candidates;
    line["inliers"] = m.inliers;
    line["rms_px"] = orNull(ok && m.inliers > 0, m.rms);
    const bool expected = m.status == MOTION_OK || m.status == MOTION_NOT_SIGNIFICANT;
    line["expected_px_raw"] = orNull(expected, m.expectedRaw);
    line["expected_px_left"] = orNull(expected, m.expectedLeft);
    line["mean_shift_px"] = frame.meanShift;
    line["ms_detect"] = frame.timings[0];
    line["ms_estimate"] = frame.timings[1];
    line["ms_map"] = frame.timings[2];
    line["ms_remap"] = frame.timings[3];
    // A file's name needn't be valid UTF-8.
    return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

ReportFile::ReportFile(const std::string& path, bool keep)
{
    if (path == "-")
        return;
    file_.reset(new AtomicFile(path));
    stream_.open(file_->temporaryName().c_str(), std::ios::binary);
    std::ifstream old(path.c_str(), std::ios::binary);
    if (keep && old && old.peek() != std::ifstream::traits_type::eof())
        stream_ << old.rdbuf();
    if (!stream_)
        throw InputError(path + " can't be written");
}

void ReportFile::add(const std::string& line)
{
    (file_ ? static_cast<std::ostream&>(stream_) : std::cout) << line << std::endl;
}

void ReportFile::commit()
{
    if (!file_)
        return;
    stream_.close();
    if (!stream_)
        throw InputError("the report can't be written");
    file_->commit();
}

} // namespace rsackermann_samples
