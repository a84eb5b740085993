// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Each number of a line of the report, in its unit, and when it is unknown.

#include "program.hpp"
#include "report.hpp"

#include <set>

namespace opencv_test { namespace {

using namespace cv::rsackermann;
using rsackermann_samples::FrameReport;
typedef nlohmann::json Json;

const double PER_DEGREE = 180 / CV_PI, UNIT = 0.04; // seconds of a unit of row time

//! No two values are the same.
FrameReport exampleReport()
{
    FrameReport r;
    r.input = "a.png";
    r.frame = 5;
    r.frames = 6;
    r.time = 47.5;
    r.camera = RollingShutterCamera::fromFocal(cv::Size(640, 380), 800);
    r.camera.lineDelay = UNIT / 800;
    r.roll = 3.5;
    r.pitch = -3.6;
    r.segments = 34;
    r.meanShift = 3.7;
    r.timings = cv::Vec4d(38, 39, 41, 42);
    r.prior.yawRate = 0.43;
    r.prior.yawRateSigma = 0.44;
    r.prior.speed = 45;
    r.prior.speedSigma = 0.46;
    AckermannMotion& m = r.motion;
    m.status = MOTION_OK;
    m.model = MODEL_4LA;
    m.alpha = 0.011;
    m.wallSlope = 0.12;
    m.wallOffset = 0.05;
    m.wallRatio = 0.7;
    m.roadSlope = -0.14;
    m.direction = -1;
    m.pitchRate = 0.0015;
    m.rollRate = -0.0016;
    m.pitchRateSigma = 0.0017;
    m.rollRateSigma = 0.0018;
    m.rollCorrection = 0.019;
    m.pitchCorrection = -0.021;
    m.headingCorrection = 0.022;
    m.wallDistance = 2.2;
    m.scale = SCALE_WALL;
    m.covariance = cv::Matx44d::diag(cv::Vec4d(1e-6, 4e-6, 9e-6, 16e-6));
    m.seenYawRate = 0.23;
    m.seenYawRateSigma = 0.24;
    m.seenSpeed = 25;
    m.seenSpeedSigma = 0.26;
    m.readoutRatio = 0.47;
    m.readoutRatioSigma = 0.48;
    m.seenHeading = 0.49;
    m.seenHeadingSigma = 0.51;
    m.candidates = 27;
    m.inliers = 28;
    m.rms = 0.29;
    m.expectedRaw = 3.1;
    m.expectedResidual = 0.32;
    m.probabilityWorse = 0.33;
    return r;
}

enum Known { ALWAYS, OF_MOTION, OF_DECISION };

struct Number
{
    const char* key;
    double expected;
    Known known;
};

const Number NUMBERS[] = {{"frame", 5, ALWAYS},
                          {"frames", 6, ALWAYS},
                          {"time_s", 47.5, ALWAYS},
                          {"width", 640, ALWAYS},
                          {"height", 380, ALWAYS},
                          {"roll_deg", 3.5, ALWAYS},
                          {"pitch_deg", -3.6, ALWAYS},
                          {"alpha", 0.011, OF_MOTION},
                          {"beta", 0.12, OF_MOTION},
                          {"delta", 0.05 / 0.12, OF_MOTION},
                          {"wall_offset", 0.05, OF_MOTION},
                          {"wall_ratio", 0.7, OF_MOTION},
                          {"road_slope", -0.14, OF_MOTION},
                          {"direction", -1, OF_MOTION},
                          {"pitch_rate", 0.0015, OF_MOTION},
                          {"roll_rate", -0.0016, OF_MOTION},
                          {"roll_correction_deg", 0.019 * PER_DEGREE, OF_MOTION},
                          {"pitch_correction_deg", -0.021 * PER_DEGREE, OF_MOTION},
                          {"heading_correction_deg", 0.022 * PER_DEGREE, OF_MOTION},
                          {"wall_distance_m", 2.2, OF_MOTION},
                          {"yaw_rate_deg_s", 2 * 0.011 / UNIT* PER_DEGREE, OF_MOTION},
                          {"speed_km_h", -0.13 * 2.2 / UNIT * 3.6, OF_MOTION},
                          {"yaw_rate_sigma", 2 * 0.001 / UNIT* PER_DEGREE, OF_MOTION},
                          {"speed_sigma", std::hypot(0.12 * 0.002, 0.05 * 0.003) / 0.13 * 2.2 / UNIT * 3.6, OF_MOTION},
                          {"pitch_rate_deg_s", 0.0015 / UNIT* PER_DEGREE, OF_MOTION},
                          {"pitch_rate_sigma", 0.0017 / UNIT* PER_DEGREE, OF_MOTION},
                          {"roll_rate_deg_s", -0.0016 / UNIT* PER_DEGREE, OF_MOTION},
                          {"roll_rate_sigma", 0.0018 / UNIT* PER_DEGREE, OF_MOTION},
                          {"given_yaw_rate_deg_s", 0.43 * PER_DEGREE, ALWAYS},
                          {"given_yaw_rate_sigma", 0.44 * PER_DEGREE, ALWAYS},
                          {"given_speed_km_h", 45 * 3.6, ALWAYS},
                          {"given_speed_sigma", 0.46 * 3.6, ALWAYS},
                          {"seen_yaw_rate_deg_s", 0.23 * PER_DEGREE, ALWAYS},
                          {"seen_yaw_rate_sigma", 0.24 * PER_DEGREE, ALWAYS},
                          {"seen_speed_km_h", 25 * 3.6, ALWAYS},
                          {"seen_speed_sigma", 0.26 * 3.6, ALWAYS},
                          {"readout_ratio", 0.47, ALWAYS},
                          {"readout_ratio_sigma", 0.48, ALWAYS},
                          {"seen_heading_deg", 0.49 * PER_DEGREE, ALWAYS},
                          {"seen_heading_sigma", 0.51 * PER_DEGREE, ALWAYS},
                          {"segments", 34, ALWAYS},
                          {"candidates", 27, ALWAYS},
                          {"inliers", 28, ALWAYS},
                          {"rms_px", 0.29, OF_MOTION},
                          {"expected_px_raw", 3.1, OF_DECISION},
                          {"expected_px_left", 0.32, OF_DECISION},
                          {"probability_worse", 0.33, OF_DECISION},
                          {"mean_shift_px", 3.7, ALWAYS},
                          {"ms_detect", 38, ALWAYS},
                          {"ms_estimate", 39, ALWAYS},
                          {"ms_map", 41, ALWAYS},
                          {"ms_remap", 42, ALWAYS}};

TEST(Report, has_each_number_in_its_unit)
{
    for (const MotionStatus status : {MOTION_OK, MOTION_NOT_SIGNIFICANT, MOTION_TOO_FEW_SEGMENTS})
    {
        SCOPED_TRACE(status);
        FrameReport report = exampleReport();
        report.motion.status = status;
        const Json line = Json::parse(reportLine(report));
        std::set<std::string> others;
        for (const auto& value : line.items())
            others.insert(value.key());
        for (const Number& number : NUMBERS)
        {
            others.erase(number.key);
            const bool isKnown = number.known == ALWAYS || status == MOTION_OK ||
                                 (number.known == OF_DECISION && status == MOTION_NOT_SIGNIFICANT);
            ASSERT_TRUE(line.contains(number.key)) << number.key;
            ASSERT_EQ(isKnown, line[number.key].is_number()) << number.key;
            if (isKnown)
            {
                EXPECT_NEAR(number.expected, line[number.key].get<double>(), 1e-12 * std::abs(number.expected))
                    << number.key;
            }
        }
        EXPECT_EQ((std::set<std::string>{"camera", "contradicts_prior", "covariance", "depth_used", "input", "model",
                                         "roll_yaw_ambiguous", "scale", "status"}),
                  others);
    }
}

// What nobody knows is no 0.
TEST(Report, has_no_number_for_what_is_unknown)
{
    FrameReport report = exampleReport();
    AckermannMotion& m = report.motion;
    m.wallSlope = m.wallRatio = m.wallDistance = m.pitchRateSigma = m.seenYawRateSigma = m.seenSpeedSigma =
        m.readoutRatioSigma = m.seenHeadingSigma = 0;
    m.covariance(0, 0) = 0;
    m.inliers = 0;
    report.prior = MotionPrior();
    const Json line = Json::parse(reportLine(report));
    for (const char* key : {"delta",
                            "wall_ratio",
                            "wall_distance_m",
                            "speed_km_h",
                            "yaw_rate_sigma",
                            "speed_sigma",
                            "pitch_rate_deg_s",
                            "pitch_rate_sigma",
                            "roll_rate_deg_s",
                            "roll_rate_sigma",
                            "given_yaw_rate_deg_s",
                            "given_yaw_rate_sigma",
                            "given_speed_km_h",
                            "given_speed_sigma",
                            "seen_yaw_rate_deg_s",
                            "seen_yaw_rate_sigma",
                            "seen_speed_km_h",
                            "seen_speed_sigma",
                            "readout_ratio",
                            "readout_ratio_sigma",
                            "seen_heading_deg",
                            "seen_heading_sigma",
                            "rms_px",
                            "depth_used"})
        EXPECT_TRUE(line[key].is_null()) << key;
    EXPECT_TRUE(line["yaw_rate_deg_s"].is_number());
    report.camera.lineDelay = 0;
    EXPECT_TRUE(Json::parse(reportLine(report))["yaw_rate_deg_s"].is_null());
}

// Of both values the words name those that are further from what is seen than both errors together let expect.
TEST(Report, names_what_contradicts)
{
    const double sigmas[][2] = {{1, 0.1}, {0.1, 1}, {1, 1}}; // given and seen, in units of 0.01 rad/s and 1 m/s
    for (const auto& sigma : sigmas)
        for (int k = 0; k < 4; k++)
        {
            const bool isYawRate = (k & 1) != 0, isSpeed = (k & 2) != 0;
            SCOPED_TRACE(testing::Message() << sigma[0] << " " << sigma[1] << " " << k);
            FrameReport report = exampleReport();
            AckermannMotion& m = report.motion;
            m.contradictsPrior = isYawRate || isSpeed;
            const double both = std::hypot(sigma[0], sigma[1]);
            report.prior.yawRateSigma = 0.01 * sigma[0];
            m.seenYawRateSigma = 0.01 * sigma[1];
            m.seenYawRate = report.prior.yawRate - 0.01 * both * (isYawRate ? 3.1 : 2.9);
            report.prior.speedSigma = sigma[0];
            m.seenSpeedSigma = sigma[1];
            m.seenSpeed = report.prior.speed + both * (isSpeed ? 3.1 : 2.9);
            const std::string words = contradiction(report, 0);
            EXPECT_EQ(isYawRate, words.find("yaw rate") != std::string::npos) << words;
            EXPECT_EQ(isSpeed, words.find("speed") != std::string::npos) << words;
        }
}

// Of a speed that contradicts a wall both are named, and a wall that the road contradicts alone.
TEST(Report, names_the_wall_that_contradicts)
{
    FrameReport report = exampleReport();
    report.motion.contradictsPrior = true;
    report.motion.seenYawRateSigma = 0;
    report.prior.speedSigma = report.motion.seenSpeedSigma = 1;
    report.motion.seenSpeed = report.prior.speed + 10;
    EXPECT_NE(std::string::npos, contradiction(report, 8.2).find("with a wall at 8.2 m the image shows"));
    EXPECT_EQ(std::string::npos, contradiction(report, 0).find("wall"));
    report.prior.speedSigma = report.motion.seenSpeedSigma = 0;
    EXPECT_NE(std::string::npos, contradiction(report, 8.2).find("given is a wall at 8.2 m, but"));
}

}} // namespace opencv_test::
