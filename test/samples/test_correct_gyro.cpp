// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Files of gyros: what is read, what is refused and what is warned of.

#include "program.hpp"

namespace opencv_test { namespace {

typedef nlohmann::json Json;

const char* const HEADER = "time_s,yaw_rate_deg_s,pitch_rate_deg_s,roll_rate_deg_s\n";

class CorrectGyro : public testing::Test
{
protected:
    Outcome run(const std::string& name, const std::string& content, const Arguments& options = {}) const
    {
        writeContent(folder_ / name, content);
        Arguments all = {folder_ / "dark.png",
                         "--focal=500",
                         "--readout=0.03",
                         "--report=-",
                         "--gyro=" + (folder_ / name),
                         "--log=" + (folder_ / "log.csv")};
        all.insert(all.end(), options.begin(), options.end());
        return correct(all);
    }

    CorrectGyro()
    {
        cv::imwrite(folder_ / "dark.png", cv::Mat(480, 640, CV_8U, cv::Scalar(0)));
        writeContent(folder_ / "log.csv", "file,time_s\ndark.png,1\n");
    }

    void expectRates(const Outcome& outcome, double yaw, double pitch, double roll) const
    {
        ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
        const Json line = Json::parse(outcome.output);
        EXPECT_EQ("ok", line["status"]);
        EXPECT_NEAR(yaw, double(line["yaw_rate_deg_s"]), 1e-3);
        EXPECT_NEAR(pitch, double(line["pitch_rate_deg_s"]), 1e-3);
        EXPECT_NEAR(roll, double(line["roll_rate_deg_s"]), 1e-3);
        for (const char* sigma : {"pitch_rate_sigma", "roll_rate_sigma"}) // each axis is known as well as the others
            EXPECT_NEAR(double(line["yaw_rate_sigma"]), double(line[sigma]), 0.1 * double(line["yaw_rate_sigma"]));
    }

    void expectRefused(const std::string& name, const std::string& content, const std::string& part) const
    {
        const Outcome outcome = run(name, content);
        EXPECT_EQ(2, outcome.exitCode) << content;
        EXPECT_NE(std::string::npos, outcome.messages.find(part)) << outcome.messages;
        EXPECT_EQ("", outcome.output);
    }

    const TemporaryFolder folder_;
};

// An image that shows nothing turns as the gyro says, whatever the order of the columns.
TEST_F(CorrectGyro, both_formats)
{
    std::string table = HEADER, other = "roll_rate_deg_s,time_s,pitch_rate_deg_s,yaw_rate_deg_s\n",
                log = "GYROFLOW IMU LOG\nversion,1.3\nid,a\norientation,XYZ\nnote\ntscale,0.001\ngscale,0.0174532925\n"
                      "ascale,1\nt,gx,gy,gz,ax,ay,az\n",
                turned = "CAMERA IMU LOG\nversion,1.3\norientation,yXZ\ntscale,0.001\ngscale,0.0174532925\n"
                         "t,gx,gy,gz\n",
                bare = "GYROFLOW IMU LOG\ngscale,0.0174532925\nt,gx,gy,gz\n"; // in ms, its axes xzY
    for (int i = 0; i < 100; i++)
    {
        const double time = 0.5 + 0.01 * i;
        table += cv::format("%g,30,-20,10\n", time);
        other += cv::format("10,%g,-20,30\n", time);
        // Upwards, to the left and backwards: -30, -20 and -10.
        log += cv::format("%d,-30,-20,-10,0,0,0\n", int(1000 * time + 0.5));
        turned += cv::format("%d,-20,30,-10\n", int(1000 * time + 0.5));
        bare += cv::format("%d,30,-10,20\n", int(1000 * time + 0.5));
    }
    expectRates(run("gyro.csv", table), 30, -20, 10);
    expectRates(run("gyro.csv", other), 30, -20, 10);
    expectRates(run("gyro.gcsv", log), 30, -20, 10);
    expectRates(run("gyro.gcsv", bare), 30, -20, 10);
    std::string later = HEADER; // by a minute
    for (int i = 0; i < 100; i++)
        later += cv::format("%g,30,-20,10\n", 60.5 + 0.01 * i);
    expectRates(run("gyro.csv", later, {"--gyro_delay=60"}), 30, -20, 10);
    expectRates(run("gyro.gcsv", turned), 30, -20, 10);
}

TEST_F(CorrectGyro, what_isnt_understood_is_refused)
{
    const std::string header = HEADER, gcsv = "GYROFLOW IMU LOG\ntscale,0.001\nt,gx,gy,gz\n";
    expectRefused("a.csv", "", "is empty");
    expectRefused("a.csv", header + "0,1,2,3\n", "fewer than two samples");
    expectRefused("a.csv", header + "0,1,2,3\n1,1,x,3\n", "line 3");
    expectRefused("a.csv", header + "0,1,2,3\n1,1,x,3\n", "column pitch_rate_deg_s");
    expectRefused("a.csv", header + "0,1,2,3\n1,1,2,nan\n", "column roll_rate_deg_s");
    expectRefused("a.csv", header + "0,1,2,3\n1,0x1,2,3\n", "column yaw_rate_deg_s: '0x1' is not a number");
    expectRefused("a.csv", header + "0,1,2,3\n1,1,2,1e9\n", "column roll_rate_deg_s: 1e9 is not from");
    expectRefused("a.csv", header + "0,1,2,3\n0,1,2,3\n", "line 3");
    expectRefused("a.csv", header + "0,1,2,3\r\n1,1,2,3\r\n\r\n1,1,2,3\r\n", "line 5"); // lines of Windows
    expectRefused("a.csv", header + "0,1,2,3\n0,1,2,3\n", "times must increase");
    expectRefused("a.csv", header + "0,1,2\n", "there are 3 cells, but 4 columns");
    expectRefused("a.csv", "time_s,yaw_rate,pitch_rate_deg_s,roll_rate_deg_s\n0,1,2,3\n", "column 2");
    expectRefused("a.csv", "time_s,yaw_rate_deg_s,pitch_rate_deg_s\n0,1,2\n",
                  "a header with time_s, pitch_rate_deg_s, yaw_rate_deg_s and roll_rate_deg_s is needed");
    expectRefused("a.csv", "time_s,time_s,yaw_rate_deg_s,pitch_rate_deg_s,roll_rate_deg_s\n0,0,1,2,3\n", "twice");
    expectRefused("a.gcsv", gcsv + "0,1,2,3\n1,1,2\n", "line 5");
    expectRefused("a.gcsv", gcsv + "0,1,2,3\n1,1,2,abc\n", "column gz");
    expectRefused("a.gcsv", gcsv + "1,1,2,3\n0,1,2,3\n", "times must increase");
    expectRefused("a.gcsv", "GYROFLOW IMU LOG\norientation,XYY\nt,gx,gy,gz\n", "line 2");
    expectRefused("a.gcsv", "GYROFLOW IMU LOG\ntscale,0\nt,gx,gy,gz\n", "column tscale");
    expectRefused("a.gcsv", "GYROFLOW IMU LOG\ntscale,1\nnote,a\ntscale,0.001\nt,gx,gy,gz\n0,1,2,3\n1,1,2,3\n",
                  "line 4 of " + (folder_ / "a.gcsv") + ", column tscale: it is there twice, in line 2 as well");
    expectRefused("a.gcsv", "GYROFLOW IMU LOG\nt,gx,gy,gz,gx\n0,1,2,3,4\n1,1,2,3,4\n", "'gx' is there twice");
    expectRefused("a.gcsv", "GYROFLOW IMU LOG\ntscale\nt,gx,gy,gz\n", "one value");
    expectRefused("a.gcsv", "GYROFLOW IMU LOG\ntscale,1\n", "begins with 't,'");
    expectRefused("a.gcsv", "GYROFLOW IMU LOG\nt,gx,gy\n0,1,2\n1,1,2\n", "a header with t, gx, gy and gz is needed");
}

// Without a time of the image nothing of the gyro belongs to it.
TEST_F(CorrectGyro, image_without_time)
{
    writeContent(folder_ / "a.csv", std::string(HEADER) + "-1,30,-20,10\n0,30,-20,10\n1,30,-20,10\n");
    const Outcome outcome =
        correct({folder_ / "dark.png", "--focal=500", "--readout=0.03", "--report=-", "--gyro=" + (folder_ / "a.csv")});
    EXPECT_EQ(0, outcome.exitCode);
    EXPECT_EQ("too_few_segments", Json::parse(outcome.output)["status"]);
    EXPECT_NE(std::string::npos, outcome.messages.find("--gyro has no effect on images without a time"));
}

// Gaps and saturated samples are reported with their line and column; a frame in a gap does without the gyro.
#ifdef RSACKERMANN_WITH_VIDEOIO
// Each begins at 0 s, so the gyro would turn all of them as it does one. A log knows when they were taken.
TEST_F(CorrectGyro, of_several_videos)
{
    Arguments options;
    for (const char* name : {"a.mp4", "b.mp4"})
    {
        options.push_back(folder_ / name);
        writeContent(options.back(), "no video");
    }
    writeContent(folder_ / "gyro.csv", std::string(HEADER) + "0,1,2,3\n0.05,1,2,3\n");
    options = options + Arguments{"--focal=500", "--readout=0.02", "--gyro=" + (folder_ / "gyro.csv")};
    for (const Outcome& outcome :
         {correct(options + Arguments{"--report=-"}),
          runProgram(CALIBRATE_PROGRAM, options + Arguments{"--output=" + (folder_ / "c.yml")})})
    {
        EXPECT_EQ(2, outcome.exitCode);
        EXPECT_NE(std::string::npos, outcome.messages.find("--gyro is of one video, but each of 2"))
            << outcome.messages;
    }
    writeContent(folder_ / "log.csv", "file,frame,time_s\na.mp4,0,0\nb.mp4,0,10\n");
    EXPECT_EQ(1, correct(options + Arguments{"--report=-", "--log=" + (folder_ / "log.csv")}).exitCode);
    options.erase(options.begin());
    EXPECT_EQ(1, correct(options + Arguments{"--report=-"}).exitCode); // as it is no video
}
#endif

// As the frames of a video, and as rsackermann_calibrate takes them.
TEST_F(CorrectGyro, images_without_times_begin_at_0)
{
    std::string gyro = HEADER;
    for (int i = -20; i < 20; i++)
        gyro += cv::format("%g,%g,0,0\n", 0.01 * i, 30 - 9. * i); // after 1/30 s it is 0
    writeContent(folder_ / "gyro.csv", gyro);
    const Outcome outcome = correct({folder_ / "dark.png", "--carry", "--focal=500", "--readout=0.02",
                                     "--gyro=" + (folder_ / "gyro.csv"), "--gyro_delay=0", "--report=-"});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    EXPECT_NEAR(30, double(Json::parse(outcome.output)["yaw_rate_deg_s"]), 3);
}

TEST_F(CorrectGyro, warnings)
{
    Outcome outcome = run("a.csv", std::string(HEADER) + "0,1,2,3\n0.9,1,2,3\n0.91,1,2,3\n1.2,1,2,3\n");
    EXPECT_EQ(0, outcome.exitCode);
    EXPECT_NE(std::string::npos,
              outcome.messages.find("line 3 of " + (folder_ / "a.csv") + ", column time_s: 0.9 s without a sample"))
        << outcome.messages;
    EXPECT_NE(std::string::npos, outcome.messages.find("frames in gaps of more than 0.1 s, of which there are 2,"))
        << outcome.messages;
    EXPECT_EQ(std::string::npos, outcome.output.find("\"ok\""));
    outcome = run("a.csv", std::string(HEADER) + "0,1,250,300\n0.01,1,250,300\n0.02,1,250,300\n0.03,1,2,300\n");
    EXPECT_EQ(0, outcome.exitCode);
    for (const char* warning : {"column pitch_rate_deg_s: the gyro saturates at 250 deg/s",
                                "column roll_rate_deg_s: the gyro saturates at 300 deg/s"})
    {
        EXPECT_NE(std::string::npos, outcome.messages.find("line 4 of " + (folder_ / "a.csv") + ", " + warning))
            << outcome.messages;
        EXPECT_EQ(outcome.messages.find(warning), outcome.messages.rfind(warning)) << outcome.messages; // once
    }
    outcome = correct({folder_ / "dark.png", "--focal=500", "--report=-", "--gyro=" + (folder_ / "a.csv")});
    EXPECT_EQ(0, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("--gyro has no effect without")) << outcome.messages;
    // One end of the range may be farther away, as that of numbers with 16 bits.
    outcome = run("b.csv", std::string(HEADER) + "0,1,250,3\n0.01,1,250,3\n0.02,1,250,3\n0.03,1,-250.01,3\n");
    EXPECT_NE(std::string::npos, outcome.messages.find("saturates at 250 deg/s")) << outcome.messages;
    // The columns of a log are those of its own axes.
    outcome = run("a.gcsv", "GYROFLOW IMU LOG\norientation,zxY\ngscale,0.0174532925199433\nt,gx,gy,gz\n"
                            "0,1,250,3\n0.01,1,250,3\n0.02,1,250,3\n");
    EXPECT_NE(std::string::npos, outcome.messages.find("line 7 of " + (folder_ / "a.gcsv") + ", column gy: the gyro"))
        << outcome.messages;
}

// Of a single image there are no others that could contradict the gyro, and without a line delay no row that it turns.
TEST_F(CorrectGyro, single_image_in_a_gap)
{
    writeContent(folder_ / "a.csv", std::string(HEADER) + "0,1,2,3\n0.01,1,2,3\n2,1,2,3\n");
    writeContent(folder_ / "log.csv", "file,time_s\nrolling.png,1\n");
    const Arguments arguments = {streetFolder() + "/rolling.png", "--report=-", "--gyro=" + (folder_ / "a.csv"),
                                 "--log=" + (folder_ / "log.csv")};
    const std::string message = "--gyro isn't used on images in its gaps";
    const Outcome timed = correct(arguments + Arguments{"--camera=" + streetFolder() + "/camera.yml"}),
                  untimed = correct(arguments + Arguments{"--focal=816"});
    EXPECT_NE(std::string::npos, timed.messages.find(message + "\n")) << timed.messages;
    EXPECT_EQ(std::string::npos, timed.messages.find("few images")) << timed.messages;
    EXPECT_NE(std::string::npos, untimed.messages.find("--gyro has no effect without")) << untimed.messages;
    EXPECT_EQ(std::string::npos, untimed.messages.find(message)) << untimed.messages;
}

TEST_F(CorrectGyro, times_in_another_unit)
{
    const Outcome outcome = run("a.csv", std::string(HEADER) + "0,1,2,3\n5,1,2,3\n10.1,1,2,3\n"),
                  log = run("a.gcsv", "GYROFLOW IMU LOG\ntscale,1\nt,gx,gy,gz\n0,0,0,0\n5000,0,0,0\n");
    // Of 4000 samples a second in milliseconds, and of seconds that are read as milliseconds
    const Outcome fast = run("b.csv", std::string(HEADER) + "0,1,2,3\n0.25,1,2,3\n0.5,1,2,3\n"),
                  close = run("b.gcsv", "GYROFLOW IMU LOG\nt,gx,gy,gz\n0,0,0,0\n0.01,0,0,0\n0.02,0,0,0\n");
    EXPECT_EQ(0, outcome.exitCode);
    EXPECT_NE(std::string::npos, fast.messages.find("no sample is less than 0.25 s after the one before: times seem"))
        << fast.messages;
    EXPECT_NE(std::string::npos, close.messages.find("line 4 of " + (folder_ / "b.gcsv") +
                                                     ", column t: no sample is more than 1e-05 s after the one "
                                                     "before: times seem not to be in seconds\n"))
        << close.messages;
    EXPECT_NE(std::string::npos, outcome.messages.find("column time_s: no sample is less than 5 s after the one "
                                                       "before: times seem not to be in seconds\n"))
        << outcome.messages;
    EXPECT_EQ(std::string::npos, outcome.messages.find("without a sample")) << outcome.messages;
    EXPECT_NE(std::string::npos, log.messages.find("column t: no sample is less than 5000 s after the one before: "
                                                   "times seem not to be in seconds\n"))
        << log.messages;
}

// From the first frame on, by turns whose changes the rows show: those of a fit of rows that don't turn contradict it.
TEST_F(CorrectGyro, first_frames_of_a_drive_that_shakes)
{
    const std::string drive = folder_ / "drive";
    ASSERT_EQ(0, simulate({"--output=" + drive, "--frames=8", "--size=640x360", "--samples=2", "--speed=50", "--left=5",
                           "--right=7", "--shake=phone", "--seed=14", "--gyro_delay=0.004", "--readout=0.02"})
                     .exitCode);
    const std::string report = folder_ / "report.jsonl";
    const Outcome outcome =
        correct({drive + "/frames", "--camera=" + drive + "/camera.yml", "--log=" + drive + "/log.csv", "--carry",
                 "--report=" + report, "--gyro=" + drive + "/gyro.csv"});
    EXPECT_EQ("", outcome.messages);
    EXPECT_EQ(8u, linesOf(report).size());
    for (const std::string& line : linesOf(report))
        EXPECT_NE(std::string::npos, line.find("rotation_curve")) << line;
}

// Before the gyro as a whole is known to be wrong.
TEST_F(CorrectGyro, contradicted_by_a_few_frames)
{
    const std::string drive = folder_ / "drive";
    ASSERT_EQ(
        0,
        simulate({"--output=" + drive, "--frames=6", "--speed=40", "--left=6", "--right=8", "--shake=phone"}).exitCode);
    std::string turned;
    for (const std::string& line : linesOf(drive + "/gyro.csv"))
    {
        double time = 0, yaw = 0, pitch = 0, roll = 0;
        const bool isHeader = std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &time, &yaw, &pitch, &roll) != 4;
        turned += isHeader ? HEADER : cv::format("%.6f,%g,%g,%g\n", time, -pitch, roll, yaw);
    }
    writeContent(folder_ / "turned.csv", turned);
    const Arguments arguments = {drive + "/frames", "--camera=" + drive + "/camera.yml", "--log=" + drive + "/log.csv",
                                 "--carry", "--report=-"};
    EXPECT_EQ("", correct(arguments + Arguments{"--gyro=" + drive + "/gyro.csv"}).messages);
    const Outcome outcome = correct(arguments + Arguments{"--gyro=" + (folder_ / "turned.csv")});
    EXPECT_EQ(outcome.output.find("rotation_curve"), std::string::npos);
    EXPECT_NE(std::string::npos, outcome.messages.find("points contradict it")) << outcome.messages;
}

// Of a clock with another origin nothing belongs to the image.
TEST_F(CorrectGyro, times_that_are_not_those_of_the_image)
{
    const std::string samples = std::string(HEADER) + "5000,1,2,3\n5000.09,1,2,3\n";
    for (const Arguments& options : {Arguments(), Arguments{"--carry"}, Arguments{"--gyro_delay=4000"}})
    {
        const Outcome outcome = run("a.csv", samples, options);
        EXPECT_EQ(0, outcome.exitCode);
        EXPECT_NE(std::string::npos, outcome.messages.find("--gyro has no effect on images outside of its times"))
            << outcome.messages;
    }
    EXPECT_EQ("", run("a.csv", samples, {"--gyro_delay=4999.05"}).messages);
}

}} // namespace
