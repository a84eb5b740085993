// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Given values that the frames of a sequence contradict are reported, and those that they don't aren't.

#include "program.hpp"
#include "turning_drive.hpp"

#include <sstream>

namespace opencv_test { namespace {

typedef nlohmann::json Json;

std::vector<Json> linesOfReport(const Arguments& arguments, Outcome& outcome)
{
    outcome = correct(arguments + Arguments{"--report=-"});
    EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
    std::vector<Json> lines;
    std::istringstream stream(outcome.output);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(Json::parse(line));
    return lines;
}

//! A given value with its sigma, and what the frames show of it. What the frame before contradicts isn't believed again
//! because this one shows less.
void expectVerdict(const Json& before, const Json& line, const char* seenKey, const char* sigmaKey, double truth,
                   double given, double givenSigma)
{
    ASSERT_TRUE(line[seenKey].is_number()) << line;
    const double seen = line[seenKey], seenSigma = line[sigmaKey], both = std::hypot(seenSigma, givenSigma),
                 distance = std::abs(given - truth);
    EXPECT_NEAR(truth, seen, 3 * seenSigma);
    if ((distance < 1.5 * both && !before["contradicts_prior"].get<bool>()) || distance > 5 * both)
    {
        EXPECT_EQ(distance > 3 * both, line["contradicts_prior"].get<bool>()) << line;
    }
}

// A wrong distance of the wall, in feet for instance, isn't blamed on the speed.
TEST(Contradictions, speed_beside_a_wall)
{
    const Arguments image = {streetFolder() + "/rolling.png", "--camera=" + streetFolder() + "/camera.yml",
                             "--speed=60", "--report=-"};
    EXPECT_EQ(std::string::npos, correct(image + Arguments{"--wall=2.5"}).messages.find("given is"));
    const std::string words = correct(image + Arguments{"--wall=8.2"}).messages;
    EXPECT_NE(std::string::npos, words.find("given is a wall at 8.2 m, but")) << words;
    EXPECT_EQ(std::string::npos, words.find("speed")) << words;
}

// Alone as well, in a sequence, too.
TEST(Contradictions, wall_that_is_too_far_away)
{
    const std::string image = streetFolder() + "/rolling.png";
    for (const char* mode : {"--overwrite", "--carry"})
        for (const double wall : {2.5, 10.})
        {
            const std::string words = correct({image, "--camera=" + streetFolder() + "/camera.yml", mode,
                                               cv::format("--wall=%g", wall), "--report=-"})
                                          .messages;
            EXPECT_EQ(wall > 2.5, words.find("check --wall and --height") != std::string::npos)
                << mode << " " << wall << " " << words;
        }
    // Where the height isn't known it is the speed that no car has.
    const std::string words =
        correct({image, "--focal=816", "--readout=0.013333", "--roll=0", "--pitch=0", "--wall=10", "--report=-"})
            .messages;
    EXPECT_NE(std::string::npos, words.find("the distance of --wall is too large")) << words;
}

// The yaw rate is that of the frames where no motion is near the given one, and not dropped.
TEST(Contradictions, yaw_rate_of_a_sequence)
{
    const TemporaryFolder folder;
    const TurningDrive drive = {};
    const int frames = 5;
    for (int i = 0; i < frames; i++)
        cv::imwrite(folder / cv::format("%d.png", i), drive.frame(i * drive.interval));
    cv::RNG rng(5);
    for (int round = 0; round < 12; round++)
    {
        const double sigma = rng.uniform(0.3, 3.), given = drive.yawRate + (round == 0 ? -40 : rng.gaussian(8));
        Outcome outcome;
        const std::vector<Json> lines =
            linesOfReport({folder.path(), "--focal=816", "--readout=0.03", round % 2 ? "--carry" : "--smooth",
                           cv::format("--yaw_rate=%.17g", given), cv::format("--yaw_rate_sigma=%.17g", sigma)},
                          outcome);
        SCOPED_TRACE(cv::format("given %.1f +- %.1f", given, sigma));
        ASSERT_EQ(size_t(frames), lines.size());
        bool isContradicted = false;
        for (int i = 1; i < frames; i++)
        {
            expectVerdict(lines[i - 1], lines[i], "seen_yaw_rate_deg_s", "seen_yaw_rate_sigma", drive.yawRate, given,
                          sigma);
            EXPECT_EQ("ok", lines[i]["status"]) << i;
            isContradicted |= lines[i]["contradicts_prior"].get<bool>();
        }
        const bool isWarned = outcome.messages.find("given is a yaw rate of") != std::string::npos;
        EXPECT_EQ(isContradicted, isWarned) << outcome.messages;
        const size_t warnings = std::count(outcome.messages.begin(), outcome.messages.end(), '\n');
        EXPECT_EQ(size_t(isWarned) + 1, warnings) << outcome.messages; // and that of the times
        if (round == 0)
        {
            EXPECT_NEAR(drive.yawRate, lines[frames - 1]["yaw_rate_deg_s"].get<double>(), 1);
        }
    }
}

TEST(Contradictions, speed_of_a_sequence)
{
    const TemporaryFolder folder;
    ASSERT_EQ(
        0, simulate({"--output=" + (folder / "drive"), "--frames=5", "--speed=40", "--left=6", "--right=8"}).exitCode);
    const double speeds[] = {40, 44, 80, 12, -40}, sigmas[] = {2, 5, 3, 1, 2};
    const Arguments cameras[] = {
        {"--camera=" + (folder / "drive/camera.yml")},
        {"--focal=816", "--focal_sigma=1", "--readout=0.0133333"}}; // with and without a height
    for (const Arguments& camera : cameras)
        for (int k = 0; k < 5; k++)
        {
            SCOPED_TRACE(cv::format("%s, given %.0f", camera[0].c_str(), speeds[k]));
            Outcome outcome;
            const std::vector<Json> lines = linesOfReport(
                camera + Arguments{folder / "drive/frames", "--log=" + (folder / "drive/log.csv"), "--carry",
                                   cv::format("--speed=%g", speeds[k]), cv::format("--speed_sigma=%g", sigmas[k])},
                outcome);
            for (size_t i = 1; i < lines.size(); i++)
                expectVerdict(lines[i - 1], lines[i], "seen_speed_km_h", "seen_speed_sigma", 40, speeds[k], sigmas[k]);
            EXPECT_EQ(lines[3]["contradicts_prior"] == true,
                      outcome.messages.find("given is a speed of") != std::string::npos);
        }
}

// Of a video one warning names the first frame, and how many there are more.
TEST(Contradictions, frames_of_a_video_are_counted)
{
    const TemporaryFolder folder;
    ASSERT_EQ(
        0, simulate({"--output=" + (folder / "drive"), "--frames=5", "--speed=40", "--left=6", "--right=8"}).exitCode);
    const std::string path = folder / "drive.avi";
    {
        cv::VideoWriter video(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 30, cv::Size(640, 380));
        for (const std::string& name : namesIn(folder / "drive/frames"))
            video.write(cv::imread(folder / "drive/frames/" + name));
    }
    for (const char* sigma : {"2", "10"})
    {
        Outcome outcome;
        int first = -1, count = 0;
        for (const Json& line : linesOfReport({"--camera=" + (folder / "drive/camera.yml"), path, "--carry",
                                               "--speed=80", std::string("--speed_sigma=") + sigma},
                                              outcome))
            if (line["contradicts_prior"] == true && count++ == 0)
                first = line["frame"];
        EXPECT_GT(count, 0);
        const std::string more = count > 1 ? cv::format(" and %d more", count - 1) : "",
                          expected = cv::format("drive.avi: frame %d%s: ", first, more.c_str());
        EXPECT_NE(std::string::npos, outcome.messages.find(expected)) << expected << outcome.messages;
    }
}

// Where the camera looks is found if nobody says it, and said if somebody was wrong.
TEST(Contradictions, heading_of_a_sequence)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulate({"--output=" + (folder / "drive"), "--frames=20", "--speed=40", "--yaw_rate=0", "--heading=2",
                           "--left=6", "--right=8"})
                     .exitCode);
    const std::string content = contentOf(folder / "drive/camera.yml"), key = "heading: 2.";
    const size_t at = content.find(key);
    ASSERT_NE(std::string::npos, at);
    writeContent(folder / "unknown.yml", content.substr(0, at) + content.substr(at + key.size()));
    writeContent(folder / "vague.yml",
                 content.substr(0, at) + "heading: 0\nheading_sigma: 1" + content.substr(at + key.size()));
    const struct
    {
        const char *camera, *option;
        double given;
        bool isUsed, isContradicted;
    } cases[] = {{"drive/camera.yml", "--reference=middle", 2, false, false},
                 {"unknown.yml", "--reference=middle", 0, true, false},
                 {"vague.yml", "--reference=middle", 0, true, false},
                 {"unknown.yml", "--heading=0", 0, false, true}};
    for (const auto& c : cases)
    {
        SCOPED_TRACE(testing::Message() << c.camera << " " << c.option);
        const Arguments camera = {"--camera=" + (folder / c.camera), c.option};
        const Outcome outcome = correct(
            camera + Arguments{folder / "drive/frames", "--log=" + (folder / "drive/log.csv"), "--carry", "--overwrite",
                               "--output=" + (folder / "out/"), "--report=" + (folder / "report.jsonl")});
        ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_EQ(c.isContradicted, outcome.messages.find("check --heading") != std::string::npos) << outcome.messages;
        std::istringstream stream(contentOf(folder / "report.jsonl"));
        Json last;
        for (std::string line; std::getline(stream, line);)
            last = Json::parse(line);
        EXPECT_NEAR(2, last["seen_heading_deg"].get<double>(), 3 * last["seen_heading_sigma"].get<double>());
        EXPECT_LT(last["seen_heading_sigma"].get<double>(), 0.5);
        EXPECT_NEAR(c.isUsed ? 2 - c.given : 0, last["heading_correction_deg"].get<double>(), 0.4);
        if (!c.isContradicted)
        {
            EXPECT_NEAR(0, last["yaw_rate_deg_s"].get<double>(), 3 * last["yaw_rate_sigma"].get<double>());
        }
    }
}

// A camera that is tilted otherwise than given, by more than cars are.
TEST(Contradictions, tilts_of_a_sequence)
{
    const TemporaryFolder folder;
    const std::string drive = folder / "drive";
    ASSERT_EQ(0, simulate({"--output=" + drive, "--frames=16", "--speed=40", "--left=6", "--right=8", "--pitch=3",
                           "--roll=-2"})
                     .exitCode);
    const struct
    {
        const char *roll, *pitch;
        bool rollIsContradicted, pitchIsContradicted;
    } cases[] = {
        {"-2", "3", false, false}, {"-1", "2.6", false, false}, {"-2", "-3", false, true}, {"3", "3", true, false}};
    for (const auto& c : cases)
    {
        SCOPED_TRACE(testing::Message() << c.roll << " " << c.pitch);
        const Outcome outcome =
            correct({drive + "/frames", "--camera=" + drive + "/camera.yml", "--log=" + drive + "/log.csv", "--carry",
                     "--overwrite", "--output=" + (folder / "out/"), std::string("--roll=") + c.roll,
                     std::string("--pitch=") + c.pitch});
        ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_EQ(c.rollIsContradicted, outcome.messages.find("check --roll") != std::string::npos) << outcome.messages;
        EXPECT_EQ(c.pitchIsContradicted, outcome.messages.find("check --pitch") != std::string::npos)
            << outcome.messages;
    }
}

// As soon as the true read-out is known, frames stay as they are if the given one is twice as long or in the other
// direction; if it is too short they are corrected by as much as it is.
TEST(Contradictions, read_out_of_a_sequence)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulate({"--output=" + (folder / "drive"), "--frames=20", "--speed=40", "--readout=0.03"}).exitCode);
    const struct
    {
        const char* option;
        double ratio;
    } given[] = {{"--readout=0.03", 1}, {"--scan=bottom_to_top", -1}, {"--readout=0.06", 0.5}, {"--readout=0.015", 2}};
    double rawByTruth = 0;
    for (const auto& g : given)
    {
        SCOPED_TRACE(g.option);
        const bool isWrong = g.ratio != 1, isApplied = g.ratio >= 1;
        Outcome outcome;
        const std::vector<Json> lines =
            linesOfReport({"--camera=" + (folder / "drive/camera.yml"), g.option, folder / "drive/frames",
                           "--log=" + (folder / "drive/log.csv"), "--carry"},
                          outcome);
        ASSERT_EQ(20u, lines.size());
        EXPECT_TRUE(lines[13]["readout_ratio"].is_null());
        const Json &last = lines.back(), &first = lines[1];
        EXPECT_NEAR(g.ratio, last["readout_ratio"].get<double>(), 0.2 * std::max(1., g.ratio));
        EXPECT_GT(last["readout_ratio_sigma"], 0);
        EXPECT_EQ("ok", first["status"]);
        EXPECT_EQ(isApplied ? "ok" : "not_significant", last["status"]);
        const double raw = last["expected_px_raw"], left = last["expected_px_left"];
        rawByTruth += isWrong ? 0 : raw;
        EXPECT_NEAR(rawByTruth, raw, 0.25 * rawByTruth);
        EXPECT_NEAR(g.ratio == 1 ? 0 : g.ratio == 2 ? 0.5 : 1, left / raw, 0.2);
        EXPECT_LT(last["probability_worse"].is_null() ? 0 : last["probability_worse"].get<double>(), 0.05);
        EXPECT_EQ(isWrong, outcome.messages.find("check --scan and --readout") != std::string::npos)
            << outcome.messages;
    }
}

// A gyro and the frames before aren't what the user has given.
TEST(Contradictions, nothing_is_given)
{
    const TemporaryFolder folder;
    std::string log = "frame,time_s\n", gyro = "time_s,yaw_rate_deg_s,pitch_rate_deg_s,roll_rate_deg_s\n";
    for (int i = 0; i < 3; i++)
    {
        cv::imwrite(folder / cv::format("%d.png", i), streetImage());
        log += cv::format("%d,%g\n", i, 1 + i / 30.);
    }
    for (int i = 0; i < 200; i++)
        gyro += cv::format("%g,-90,0,0\n", i / 100.);
    writeContent(folder / "log.csv", log);
    writeContent(folder / "gyro.csv", gyro);
    for (const char* mode : {"--gravity_sigma=0", "--carry"})
        for (const bool hasGyro : {false, true})
        {
            SCOPED_TRACE(cv::format("%s, gyro %d", mode, int(hasGyro)));
            Arguments arguments = {folder.path(), "--camera=" + streetFolder() + "/camera.yml", mode,
                                   "--log=" + (folder / "log.csv")};
            if (std::string(mode) == "--carry")
                arguments.push_back("--gravity_sigma=0");
            if (hasGyro)
                arguments.push_back("--gyro=" + (folder / "gyro.csv"));
            Outcome outcome;
            for (const Json& line : linesOfReport(arguments, outcome))
            {
                EXPECT_EQ(false, line["contradicts_prior"]);
                EXPECT_TRUE(line["seen_yaw_rate_deg_s"].is_null());
            }
            EXPECT_EQ(std::string::npos, outcome.messages.find("given is")) << outcome.messages;
        }
}

}} // namespace opencv_test::
