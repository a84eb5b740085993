// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"

#include "opencv2/imgproc.hpp"
#include "opencv2/videoio.hpp"
#include <cstring>
#include <unistd.h>

namespace opencv_test { namespace {

typedef nlohmann::ordered_json Json;

// An element of Matroska: its name, its size in eight bytes, its content.
std::string element(const std::string& id, const std::string& content)
{
    std::string size = "\x01";
    for (int i = 6; i >= 0; i--)
        size += char(content.size() >> 8 * i);
    return id + size + content;
}

std::string number(const std::string& id, unsigned value)
{
    std::string content;
    for (int i = 3; i >= 0; i--)
        content += char(value >> 8 * i);
    return element(id, content);
}

std::string duration(double milliseconds)
{
    uint64 bits = 0;
    std::memcpy(&bits, &milliseconds, sizeof bits);
    std::string content;
    for (int i = 7; i >= 0; i--)
        content += char(bits >> 8 * i);
    return element("\x44\x89", content);
}

// The frame of a drive: each differs, so that they can be distinguished.
cv::Mat frameOf(int i)
{
    cv::Mat frame = streetImage();
    cv::rectangle(frame, cv::Rect(0, 340, 10 * (i + 1), 40), cv::Scalar(0, 0, 255), cv::FILLED);
    return frame;
}

// A video of JPEG images with times of its frames that OpenCV can't write: of its own choice.
// @param ofFrame milliseconds that a frame is said to last; 0: nothing is said.
void writeMatroska(const std::string& path, const std::vector<int>& milliseconds, double wholeDuration,
                   const cv::Size& size = streetImage().size(), int ofFrame = 0)
{
    std::string blocks = number("\xE7", 0);
    for (size_t i = 0; i < milliseconds.size(); i++)
    {
        std::vector<uchar> jpeg;
        cv::imencode(".jpg", frameOf(int(i))(cv::Rect(cv::Point(), size)), jpeg);
        const char head[] = {'\x81', char(milliseconds[i] >> 8), char(milliseconds[i]), '\x80'};
        blocks += element("\xA3", std::string(head, 4) + std::string(jpeg.begin(), jpeg.end()));
    }
    const std::string header = number("\x42\x86", 1) + number("\x42\xF7", 1) + number("\x42\xF2", 4) +
                               number("\x42\xF3", 8) + element("\x42\x82", "matroska") + number("\x42\x87", 2) +
                               number("\x42\x85", 2);
    const std::string info = number("\x2A\xD7\xB1", 1000000) + duration(wholeDuration);
    const std::string track =
        number("\xD7", 1) + number("\x73\xC5", 1) + number("\x83", 1) + element("\x86", "V_MJPEG") +
        (ofFrame > 0 ? number("\x23\xE3\x83", unsigned(ofFrame) * 1000000) : std::string()) +
        element("\xE0", number("\xB0", unsigned(size.width)) + number("\xBA", unsigned(size.height)));
    writeContent(path, element("\x1A\x45\xDF\xA3", header) +
                           element("\x18\x53\x80\x67", element("\x15\x49\xA9\x66", info) +
                                                           element("\x16\x54\xAE\x6B", element("\xAE", track)) +
                                                           element("\x1F\x43\xB6\x75", blocks)));
}

int countFrames(const std::string& path)
{
    cv::VideoCapture capture(path);
    int count = 0;
    while (capture.grab())
        count++;
    return count;
}

class VideoTimes : public testing::Test
{
protected:
    Outcome run(const Arguments& more = {}) const
    {
        Arguments arguments = {in_ / "drive.mkv", "--camera=" + streetFolder() + "/camera.yml",
                               "--report=" + (out_ / "report.jsonl"), "--overwrite"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return correct(arguments);
    }

    std::vector<Json> report() const
    {
        std::vector<Json> lines;
        for (const std::string& line : linesOf(out_ / "report.jsonl"))
            lines.push_back(Json::parse(line));
        return lines;
    }

    const TemporaryFolder in_, out_;
};

TEST_F(VideoTimes, rate_that_varies)
{
    const std::vector<int> times = {0, 100, 150, 300, 350, 500};
    writeMatroska(in_ / "drive.mkv", times, 600);
    ASSERT_EQ(int(times.size()), countFrames(in_ / "drive.mkv"));
    const Outcome outcome = run({"--output=" + (out_ / "out.avi")});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const std::vector<Json> lines = report();
    ASSERT_EQ(times.size(), lines.size());
    for (size_t i = 0; i < times.size(); i++)
        EXPECT_NEAR(times[i] / 1000., lines[i]["time_s"].get<double>(), 1e-6);
    // All frames in the same time: five intervals of 0.1 s in the mean.
    EXPECT_EQ(int(times.size()), countFrames(out_ / "out.avi"));
    EXPECT_NEAR(10, cv::VideoCapture(out_ / "out.avi").get(cv::CAP_PROP_FPS), 0.01);

    // Samples of a log are looked up at these times.
    writeContent(in_ / "log.csv", "time_s,speed_kmh\n0.29,20\n0.31,20\n");
    const Json plain = lines[3];
    ASSERT_EQ(0, run({"--log=" + (in_ / "log.csv")}).exitCode);
    for (size_t i = 0; i < times.size(); i++)
        EXPECT_EQ(i != 3, report()[i]["alpha"] == lines[i]["alpha"]) << i;
}

// Frames that are late by less than an interval are late, too, as are those after them.
TEST_F(VideoTimes, break_in_an_even_rate)
{
    std::vector<int> times;
    for (int i = 0; i < 24; i++)
        times.push_back(40 * i + (i < 12 ? 0 : 25));
    writeMatroska(in_ / "drive.mkv", times, 1000, streetImage().size(), 40);
    ASSERT_NEAR(25, cv::VideoCapture(in_ / "drive.mkv").get(cv::CAP_PROP_FPS), 2);
    ASSERT_EQ(0, run().exitCode);
    const std::vector<Json> lines = report();
    ASSERT_EQ(times.size(), lines.size());
    for (size_t i = 0; i < times.size(); i++)
        EXPECT_NEAR(times[i] / 1000., lines[i]["time_s"].get<double>(), 2e-3) << i;
}

// Of frames in equal distances times that are rounded to milliseconds are those of the rate.
TEST_F(VideoTimes, rate_that_is_constant)
{
    std::vector<int> times;
    const double rate = 60;
    for (int i = 0; i < 24; i++)
        times.push_back(cvRound(1000 * i / rate));
    writeMatroska(in_ / "drive.mkv", times, 400);
    const double announced = cv::VideoCapture(in_ / "drive.mkv").get(cv::CAP_PROP_FPS);
    ASSERT_NEAR(rate, announced, 0.5);
    ASSERT_EQ(0, run().exitCode);
    const std::vector<Json> lines = report();
    ASSERT_EQ(times.size(), lines.size());
    for (size_t i = 1; i < times.size(); i++)
        EXPECT_NEAR(1 / announced, lines[i]["time_s"].get<double>() - lines[i - 1]["time_s"].get<double>(), 1e-6) << i;
}

TEST_F(VideoTimes, container_longer_than_its_pictures)
{
    writeMatroska(in_ / "drive.mkv", {0, 40, 80, 120}, 60000);
    const Outcome outcome = run({"--output=" + (out_ / "out.mkv")});
    EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
    EXPECT_EQ(4u, report().size());
    EXPECT_EQ(4, countFrames(out_ / "out.mkv"));
    EXPECT_NEAR(25, cv::VideoCapture(out_ / "out.mkv").get(cv::CAP_PROP_FPS), 0.3);
}

// No column and no row gets lost silently.
TEST_F(VideoTimes, odd_sizes)
{
    for (const cv::Size& size : {cv::Size(161, 121), cv::Size(161, 120), cv::Size(160, 121)})
    {
        writeMatroska(in_ / "drive.mkv", {0, 150, 300, 450}, 600, size);
        // The camera file has another size.
        const Outcome made = correct({in_ / "drive.mkv", "--output=" + (out_ / "out.avi"),
                                      "--overlay=" + (out_ / "overlay.avi"), "--overwrite"});
        ASSERT_EQ(0, made.exitCode) << made.messages;
        for (const char* name : {"out.avi", "overlay.avi"})
        {
            cv::VideoCapture video(out_ / name);
            cv::Mat frame;
            ASSERT_TRUE(video.read(frame)) << name;
            EXPECT_EQ(size, frame.size()) << name;
            EXPECT_NEAR(1 / 0.15, video.get(cv::CAP_PROP_FPS), 1e-4) << name;
            EXPECT_EQ(4, countFrames(out_ / name));
        }
        const TemporaryFolder none;
        for (const char* target : {"--output=", "--overlay="})
            EXPECT_EQ(1, correct({in_ / "drive.mkv", target + (none / "out.mp4")}).exitCode);
        EXPECT_TRUE(namesIn(none.path()).empty());
    }
    const TemporaryFolder none;
    for (const char* extension : {".mkv", ".mjpeg", ".mp4", ".m4v", ".mov", ".webm", ".wmv", ".mpg", ".mpeg"})
    {
        const Outcome outcome = correct({in_ / "drive.mkv", "--output=" + (none / "out") + extension});
        EXPECT_EQ(1, outcome.exitCode) << extension;
        for (const char* part : {"160 x 121", extension, "MJPG in .avi"})
            EXPECT_NE(std::string::npos, outcome.messages.find(part)) << outcome.messages;
        EXPECT_TRUE(namesIn(none.path()).empty()) << extension;
    }
}

TEST_F(VideoTimes, cut_short)
{
    writeMatroska(in_ / "whole.mkv", {0, 40, 80, 120}, 160);
    cutShort(in_ / "whole.mkv", in_ / "drive.mkv", 0.6);
    const int left = countFrames(in_ / "drive.mkv");
    ASSERT_LT(left, 4);
    const Outcome outcome = run();
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("cut short")) << outcome.messages;
    EXPECT_EQ(size_t(left + 1), report().size());
    for (const char* name : {"whole.mp4", "whole.avi"})
    {
        const std::string whole = out_ / name;
        ASSERT_EQ(0, correct({in_ / "whole.mkv", "--output=" + whole}).exitCode);
        EXPECT_EQ(0, correct({whole, "--report=" + (out_ / "again.jsonl"), "--overwrite"}).exitCode) << name;
        cutShort(whole, whole, 0.7);
        EXPECT_EQ(1, correct({whole, "--report=" + (out_ / "again.jsonl"), "--overwrite"}).exitCode) << name;
    }
}

TEST_F(VideoTimes, full_disk)
{
    std::vector<int> times;
    for (int i = 0; i < 20; i++)
        times.push_back(40 * i);
    writeMatroska(in_ / "drive.mkv", times, 800);
    for (const char* name : {"out.avi", "out.mkv", "out.mp4"})
        for (const char* target : {"--output=", "--overlay="})
        {
            const Outcome outcome = runCommand("ulimit -f 80; '" CORRECT_PROGRAM "' '" + (in_ / "drive.mkv") + "' '" +
                                               target + (out_ / name) + "'");
            EXPECT_EQ(1, outcome.exitCode) << name;
            EXPECT_NE(std::string::npos, outcome.messages.find("can't be written")) << outcome.messages;
            EXPECT_TRUE(namesIn(out_.path()).empty()) << name;
        }
}

TEST_F(VideoTimes, interrupted)
{
    std::vector<int> times;
    for (int i = 0; i < 100; i++)
        times.push_back(40 * i);
    writeMatroska(in_ / "drive.mkv", times, 4000);
    RunningProgram program(CORRECT_PROGRAM,
                           {in_ / "drive.mkv", "--output=" + (out_ / "out.avi"), "--maps=" + (out_ / "m")});
    while (namesIn(out_ / "m").size() < 3)
        usleep(1000);
    program.send(SIGTERM);
    EXPECT_EQ(128 + SIGTERM, program.wait());
    EXPECT_EQ(std::vector<std::string>{"m"}, namesIn(out_.path()));
    for (const std::string& name : namesIn(out_ / "m"))
        EXPECT_EQ("drive_", name.substr(0, 6));
}

TEST_F(VideoTimes, names_of_maps_of_frames_and_of_images)
{
    writeMatroska(in_ / "drive.mkv", {0, 40}, 80);
    cv::imwrite(in_ / "drive_000001.png", streetImage());
    EXPECT_EQ(2, correct({in_ / "drive.mkv", in_ / "drive_000001.png", "--maps=" + (out_ / "m")}).exitCode);
    EXPECT_EQ(2, correct({in_ / "drive_000001.png", in_ / "drive.mkv", "--maps=" + (out_ / "m")}).exitCode);
    EXPECT_TRUE(namesIn(out_.path()).empty());
}

}} // namespace
