// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "report.hpp"
#include "camera_of_report.hpp"
#include "motion_words.hpp"
#include "units.hpp"

#include <cmath>
#include <limits>
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

// To a billionth: what is left out moves a pixel by less than 1e-6.
Json rounded(double value)
{
    return std::round(value * 1e9) / 1e9;
}

// AckermannMotion::inverseDepthOffset and the area that it covers.
Json offsetOf(const AckermannMotion& motion)
{
    const cv::Rect2d& area = motion.offsetArea;
    Json values = Json::array();
    for (int i = 0; i < int(motion.inverseDepthOffset.total()); i++)
        values.push_back(rounded(motion.inverseDepthOffset.at<double>(i / motion.inverseDepthOffset.cols,
                                                                      i % motion.inverseDepthOffset.cols)));
    return {{"columns", motion.inverseDepthOffset.cols},
            {"values", values},
            {"area", {rounded(area.x), rounded(area.y), rounded(area.width), rounded(area.height)}}};
}

// AckermannMotion::rotationCurve.
Json curveOf(const AckermannMotion& motion)
{
    Json vectors = Json::array();
    for (int i = 0; i < motion.rotationCurve.rows; i++)
    {
        const double* const v = motion.rotationCurve.ptr<double>(i);
        vectors.push_back({rounded(v[0]), rounded(v[1]), rounded(v[2])});
    }
    return vectors;
}

bool isUtf8(const std::string& text)
{
    try
    {
        Json(text).dump();
        return true;
    }
    catch (const Json::exception&)
    {
        return false;
    }
}

} // namespace

FrameReport::FrameReport()
    : frame(-1), frames(-1), time(std::numeric_limits<double>::quiet_NaN()), pixelAspect(1), roll(0), pitch(0),
      segments(0), isLogged(false), isGyroWrong(false), isGyroUsed(false), isDepthGiven(false), isDepthUsed(false),
      change(std::numeric_limits<double>::quiet_NaN()), meanShift(0)
{
}

std::string reportLine(const FrameReport& frame)
{
    const AckermannMotion& m = frame.motion;
    const bool ok = m.status == MOTION_OK;
    double yawRate = 0, speed = 0;
    const bool yawRateKnown = ok && m.yawRate(frame.camera, yawRate), speedKnown = ok && m.speed(frame.camera, speed);

    Json line;
    line["input"] = nameInReport(frame.input);
    if (frame.frame >= 0)
    {
        line["frame"] = frame.frame;
        line["frames"] = frame.frames;
    }
    if (!std::isnan(frame.time))
        line["time_s"] = frame.time;
    if (!frame.error.empty())
    {
        line["status"] = "failed";
        line["error"] = nameInReport(frame.error);
        return line.dump();
    }
    line["width"] = frame.camera.imageSize.width;
    line["height"] = frame.camera.imageSize.height;
    line["roll_deg"] = frame.roll;
    line["pitch_deg"] = frame.pitch;
    line["camera"] = cameraForReport(frame.camera);
    line["status"] = STATUS_WORDS[m.status];
    line["model"] = modelWord(m.model);
    line["alpha"] = orNull(ok, m.alpha);
    line["beta"] = orNull(ok, m.wallSlope);
    line["delta"] = orNull(ok && m.wallSlope != 0, m.delta());
    line["wall_offset"] = orNull(ok, m.wallOffset);
    line["wall_ratio"] = orNull(ok && m.wallRatio > 0, m.wallRatio);
    line["road_slope"] = orNull(ok, m.roadSlope);
    if (ok && !m.inverseDepthOffset.empty())
        line["relief"] = offsetOf(m);
    line["direction"] = ok ? Json(m.direction) : Json();
    line["pitch_rate"] = orNull(ok, m.pitchRate);
    line["roll_rate"] = orNull(ok, m.rollRate);
    if (ok && !m.rotationCurve.empty())
        line["rotation_curve"] = curveOf(m);
    line["roll_correction_deg"] = orNull(ok, m.rollCorrection / DEGREE);
    line["pitch_correction_deg"] = orNull(ok, m.pitchCorrection / DEGREE);
    line["heading_correction_deg"] = orNull(ok, m.headingCorrection / DEGREE);
    line["wall_distance_m"] = orNull(ok && m.wallDistance > 0, m.wallDistance);
    line["scale"] = ok ? Json(SCALE_WORDS[m.scale]) : Json();
    line["covariance"] = ok ? Json(std::vector<double>(m.covariance.val, m.covariance.val + 16)) : Json();
    line["roll_yaw_ambiguous"] = ok ? Json(m.rollYawAmbiguous) : Json();
    line["yaw_rate_deg_s"] = orNull(yawRateKnown, yawRate / DEGREE);
    line["speed_km_h"] = orNull(speedKnown, speed / KMH);
    const cv::Matx44d covariance = m.metricCovariance(frame.camera);
    line["yaw_rate_sigma"] = orNull(yawRateKnown && covariance(0, 0) > 0, std::sqrt(covariance(0, 0)) / DEGREE);
    line["speed_sigma"] = orNull(speedKnown && covariance(1, 1) > 0, std::sqrt(covariance(1, 1)) / KMH);
    const double unit = frame.camera.secondsPerUnitTime();
    const bool tilts = yawRateKnown && m.pitchRateSigma > 0;
    line["pitch_rate_deg_s"] = orNull(tilts, m.pitchRate / unit / DEGREE);
    line["pitch_rate_sigma"] = orNull(tilts, m.pitchRateSigma / unit / DEGREE);
    line["roll_rate_deg_s"] = orNull(tilts, m.rollRate / unit / DEGREE);
    line["roll_rate_sigma"] = orNull(tilts, m.rollRateSigma / unit / DEGREE);
    const MotionPrior& p = frame.prior;
    line["given_yaw_rate_deg_s"] = orNull(p.yawRateSigma > 0, p.yawRate / DEGREE);
    line["given_yaw_rate_sigma"] = orNull(p.yawRateSigma > 0, p.yawRateSigma / DEGREE);
    line["given_speed_km_h"] = orNull(p.speedSigma > 0, p.speed / KMH);
    line["given_speed_sigma"] = orNull(p.speedSigma > 0, p.speedSigma / KMH);
    line["contradicts_prior"] = m.contradictsPrior;
    line["seen_yaw_rate_deg_s"] = orNull(m.seenYawRateSigma > 0, m.seenYawRate / DEGREE);
    line["seen_yaw_rate_sigma"] = orNull(m.seenYawRateSigma > 0, m.seenYawRateSigma / DEGREE);
    line["seen_speed_km_h"] = orNull(m.seenSpeedSigma > 0, m.seenSpeed / KMH);
    line["seen_speed_sigma"] = orNull(m.seenSpeedSigma > 0, m.seenSpeedSigma / KMH);
    line["readout_ratio"] = orNull(m.readoutRatioSigma > 0, m.readoutRatio);
    line["readout_ratio_sigma"] = orNull(m.readoutRatioSigma > 0, m.readoutRatioSigma);
    line["seen_heading_deg"] = orNull(m.seenHeadingSigma > 0, m.seenHeading / DEGREE);
    line["seen_heading_sigma"] = orNull(m.seenHeadingSigma > 0, m.seenHeadingSigma / DEGREE);
    line["segments"] = frame.segments;
    line["candidates"] = m.candidates;
    line["inliers"] = m.inliers;
    line["rms_px"] = orNull(ok && m.inliers > 0, m.rms);
    const bool expected = m.status == MOTION_OK || m.status == MOTION_NOT_SIGNIFICANT;
    line["expected_px_raw"] = orNull(expected, m.expectedRaw);
    line["expected_px_left"] = orNull(expected, m.expectedResidual);
    line["probability_worse"] = orNull(expected, m.probabilityWorse);
    line["depth_used"] = frame.isDepthGiven ? Json(frame.isDepthUsed) : Json();
    line["mean_shift_px"] = frame.meanShift;
    line["ms_detect"] = frame.timings[0];
    line["ms_estimate"] = frame.timings[1];
    line["ms_map"] = frame.timings[2];
    line["ms_remap"] = frame.timings[3];
    return line.dump();
}

// Words on a given value and what is seen instead.
static std::string comparison(const char* name, const char* unit, double given, double givenSigma,
                              const std::string& source, double seen, double seenSigma)
{
    return cv::format("given is a %s of %.1f %s (sigma %.1f), but %s %.1f (sigma %.1f)", name, given, unit, givenSigma,
                      source.c_str(), seen, seenSigma);
}

std::string contradiction(const FrameReport& frame, double wall)
{
    const AckermannMotion& m = frame.motion;
    const MotionPrior& p = frame.prior;
    const double sigmas = 3;
    const std::string source = frame.isGyroUsed ? "image and gyro show" : "the image shows",
                      ofSpeed = wall > 0 ? cv::format("with a wall at %.1f m %s", wall, source.c_str()) : source;
    std::string words;
    if (m.seenYawRateSigma > 0 && p.yawRateSigma > 0 &&
        std::abs(m.seenYawRate - p.yawRate) > sigmas * std::hypot(m.seenYawRateSigma, p.yawRateSigma))
        words = comparison("yaw rate", "deg/s", p.yawRate / DEGREE, p.yawRateSigma / DEGREE, source,
                           m.seenYawRate / DEGREE, m.seenYawRateSigma / DEGREE);
    if (m.seenSpeedSigma > 0 && std::abs(m.seenSpeed - p.speed) > sigmas * std::hypot(m.seenSpeedSigma, p.speedSigma))
        words += (words.empty() ? "" : "; ") + comparison("speed", "km/h", p.speed / KMH, p.speedSigma / KMH, ofSpeed,
                                                          m.seenSpeed / KMH, m.seenSpeedSigma / KMH);
    const bool isOfWall = wall > 0 && (!(p.speedSigma > 0) || m.seenSpeed * p.speed > 0);
    if (words.empty() && m.contradictsPrior && isOfWall)
        words = cv::format(
            "given is a wall at %.1f m, but segments end elsewhere than on the road or above it if the camera "
            "is at its height: check --wall and --height",
            wall);
    else if (words.empty() && m.contradictsPrior)
        words = cv::format("given is a speed of %.1f km/h (sigma %.1f), but the image shows the other direction",
                           p.speed / KMH, p.speedSigma / KMH);
    return words;
}

std::string failureLine(const std::string& input, const std::string& error)
{
    FrameReport failed;
    failed.input = input;
    failed.error = error;
    return reportLine(failed);
}

std::string nameInReport(const std::string& input)
{
    if (isUtf8(input))
        return input;
    // Different names stay different.
    std::string name;
    for (const char c : input)
        name += (unsigned char)c < 0x80 ? std::string(1, c) : cv::format("\xEF\xBF\xBD%02x", (unsigned char)c);
    return name;
}

} // namespace rsackermann_samples
