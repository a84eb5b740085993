// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"

#include "opencv2/imgproc.hpp"
#include <sstream>

namespace opencv_test { namespace {

typedef nlohmann::ordered_json Json;

// What a log tells of an image has the effect of the options that tell the same.
class CorrectLog : public testing::Test
{
protected:
    CorrectLog() : image_(streetFolder() + "/rolling.png") {}

    Outcome run(Arguments inputs, const Arguments& options) const
    {
        for (const std::string& option :
             {"--camera=" + streetFolder() + "/camera.yml", std::string("--wall=2.5"), std::string("--report=-")})
            inputs.push_back(option);
        inputs.insert(inputs.end(), options.begin(), options.end());
        return correct(inputs);
    }

    Outcome runWithLog(const std::string& content, const Arguments& inputs, const Arguments& options = {}) const
    {
        writeContent(folder_ / "log.csv", content);
        Arguments all = options;
        all.push_back("--log=" + (folder_ / "log.csv"));
        return run(inputs, all);
    }

    // Results without what differs from run to run.
    static std::vector<Json> resultsOf(const Outcome& outcome)
    {
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        std::vector<Json> results;
        std::istringstream stream(outcome.output);
        for (std::string line; std::getline(stream, line);)
        {
            Json report = Json::parse(line);
            for (const char* key : {"input", "time_s", "ms_detect", "ms_estimate", "ms_map", "ms_remap"})
                report.erase(key);
            results.push_back(report);
        }
        return results;
    }

    void expectSame(const Arguments& options, const std::string& log) const
    {
        const std::vector<Json> expected = resultsOf(run({image_}, options)),
                                got = resultsOf(runWithLog(log, {image_}));
        EXPECT_EQ(expected, got) << log;
    }

    const std::string image_;
    const TemporaryFolder folder_;
};

TEST_F(CorrectLog, each_column)
{
    const Json plain = resultsOf(run({image_}, {}))[0];
    const std::pair<const char*, Arguments> columns[] = {
        {"speed_kmh\nrolling.png,55\n", {"--speed=55"}},
        {"speed_kmh,speed_sigma_kmh\nrolling.png,55,0.5\n", {"--speed=55", "--speed_sigma=0.5"}},
        {"yaw_rate_deg_s\nrolling.png,35\n", {"--yaw_rate=35"}},
        {"yaw_rate_deg_s,yaw_rate_sigma_deg_s\nrolling.png,35,3\n", {"--yaw_rate=35", "--yaw_rate_sigma=3"}},
        {"roll_deg\nrolling.png,0.7\n", {"--roll=0.7"}},
        {"pitch_deg\nrolling.png,-2\n", {"--pitch=-2"}},
        {"gravity_sigma_deg\nrolling.png,0.1\n", {"--gravity_sigma=0.1"}},
        {"gravity_sigma_deg\nrolling.png,0\n", {"--gravity_sigma=0"}}};
    for (const std::pair<const char*, Arguments>& column : columns)
    {
        expectSame(column.second, std::string("file,") + column.first);
        EXPECT_NE(plain, resultsOf(run({image_}, column.second))[0]) << column.first;
    }
}

// As the options do, a row leaves nothing of the uncertainty of a mount, be it the camera file's or that of one of
// which nothing is given.
TEST_F(CorrectLog, mount_of_a_row_is_exact)
{
    const std::string camera = folder_ / "camera.yml";
    writeContent(camera, contentOf(streetFolder() + "/camera.yml") + "roll_sigma: 3.\npitch_sigma: 2.\n");
    for (const Arguments& given : {Arguments{"--camera=" + camera}, Arguments{"--focal=816", "--readout=0.03"}})
        for (const bool isRoll : {false, true})
        {
            writeContent(folder_ / "log.csv",
                         isRoll ? "file,roll_deg\nrolling.png,0.7\n" : "file,pitch_deg\nrolling.png,0.2\n");
            const Arguments same = given + Arguments{image_, "--wall=2.5", "--report=-"};
            const std::vector<Json> byOption =
                                        resultsOf(correct(same + Arguments{isRoll ? "--roll=0.7" : "--pitch=0.2"})),
                                    byLog = resultsOf(correct(same + Arguments{"--log=" + (folder_ / "log.csv")}));
            EXPECT_EQ(byOption, byLog) << given[0] << isRoll;
            EXPECT_NE(resultsOf(correct(same))[0]["covariance"], byLog[0]["covariance"]) << given[0] << isRoll;
        }
}

TEST_F(CorrectLog, ways_to_name_an_image)
{
    const Arguments options = {"--speed=55"};
    expectSame(options, "file,speed_kmh\n" + image_ + ",55\n");
    expectSame(options, "speed_kmh,file\n55,rolling.png\n");
    expectSame(options, "frame,speed_kmh\n0,55\n");
    // As spreadsheets write it.
    expectSame(options,
               "\xEF\xBB\xBF\"file\",\"speed_kmh\"\r\n\"other, \"\"one\"\".png\",10\r\n\r\n\"rolling.png\" , 55 \r\n");
}

TEST_F(CorrectLog, goes_before_the_options)
{
    const std::vector<Json> expected = resultsOf(run({image_}, {"--speed=55", "--yaw_rate=38"}));
    EXPECT_EQ(expected, resultsOf(runWithLog("file,speed_kmh\nrolling.png,55\n", {image_},
                                             {"--speed=20", "--speed_sigma=9", "--yaw_rate=38"})));
    EXPECT_EQ(expected, resultsOf(runWithLog("file,speed_kmh,yaw_rate_deg_s\nrolling.png,,38\n", {image_},
                                             {"--speed=55", "--yaw_rate=20"})));
}

TEST_F(CorrectLog, samples_between_which_values_change_linearly)
{
    expectSame({"--speed=55"}, "file,time_s,speed_kmh\nrolling.png,100.5,\n,100,50\n,101,60\n");
    expectSame(
        {"--speed=55", "--yaw_rate=40"},
        "file,time_s,speed_kmh,yaw_rate_deg_s\n,99,,34\n,100,50,\n,100.5,,\n,101,60,\n,102,,46\nrolling.png,100.5,,\n");
    expectSame({"--speed=60"}, "file,time_s,speed_kmh\nrolling.png,101,\n,100,50\n,101,60\n");
    // Neither before the first sample nor after the last one, nor for a frame without a time.
    expectSame({}, "file,time_s,speed_kmh\nrolling.png,99.9,\n,100,50\n,101,60\n");
    expectSame({}, "file,time_s,speed_kmh\nrolling.png,101.1,\n,100,50\n,101,60\n");
    expectSame({}, "file,time_s,speed_kmh\nrolling.png,,\n,100,50\n,101,60\n");
    // The frame's own row goes before.
    expectSame({"--speed=40"}, "file,time_s,speed_kmh\nrolling.png,100.5,40\n,100,50\n,101,60\n");
}

TEST_F(CorrectLog, each_image_has_its_row)
{
    cv::imwrite(folder_ / "a.png", streetImage());
    cv::imwrite(folder_ / "b.png", streetImage());
    cv::imwrite(folder_ / "c.png", streetImage());
    const Arguments inputs = {folder_ / "a.png", folder_ / "b.png", folder_ / "c.png"};
    const Json a = resultsOf(run({image_}, {"--roll=0.5"}))[0], b = resultsOf(run({image_}, {"--speed=40"}))[0],
               c = resultsOf(run({image_}, {}))[0];
    const std::string log = "file,roll_deg,speed_kmh\nb.png,,40\na.png,0.5,\n";
    const Outcome outcome = runWithLog(log, inputs);
    EXPECT_EQ((std::vector<Json>{a, b, c}), resultsOf(outcome));
    EXPECT_NE(std::string::npos, outcome.messages.find("doesn't name 1 of the 3 images")) << outcome.messages;
    // The number of an image is that in the list of inputs, whatever part of them is done.
    EXPECT_EQ((std::vector<Json>{b}),
              resultsOf(runWithLog("frame,speed_kmh\n0,10\n1,40\n2,70\n", inputs, {"--shard=2/3"})));
    const Outcome other = runWithLog("frame,speed_kmh\n0,10\n", inputs, {"--shard=2/3"});
    EXPECT_EQ(std::string::npos, other.messages.find("no effect")) << other.messages;
}

// Images of two drives are often called the same.
TEST_F(CorrectLog, name_of_two_images)
{
    Arguments inputs;
    for (const char* drive : {"a", "b"})
    {
        cv::utils::fs::createDirectories(folder_ / drive);
        inputs.push_back(folder_ / drive + "/0.png");
        cv::imwrite(inputs.back(), streetImage());
    }
    for (const char* row : {"0.png,0,66\n", "0.png,0,66\n,1,66\n"})
    {
        const Outcome both = runWithLog(std::string("file,time_s,speed_kmh\n") + row, inputs);
        EXPECT_EQ(2, both.exitCode);
        EXPECT_NE(std::string::npos, both.messages.find("the log's 0.png is both " + inputs[0] + " and " + inputs[1] +
                                                        "; name them with their folders"))
            << both.messages;
    }
    const std::string rows = "file,speed_kmh\n" + inputs[0] + ",66\n" + inputs[1] + ",65\n";
    EXPECT_EQ("", runWithLog(rows + "0.png,64\n", inputs).messages);
    EXPECT_EQ(0, runWithLog("file,speed_kmh\n0.png,66\n", {inputs[1], image_}).exitCode);
    // The same image twice, and numbers.
    EXPECT_EQ("", runWithLog("file,speed_kmh\n0.png,66\n", {inputs[0], inputs[0]}).messages);
    EXPECT_EQ("", runWithLog("frame,speed_kmh\n0,66\n1,65\n", inputs).messages);
}

TEST_F(CorrectLog, time_between_frames_of_a_drive)
{
    // A picture that grows, as when the car drives on.
    cv::Mat nearer;
    const cv::Mat street = streetImage();
    const double larger = 1.03;
    cv::warpAffine(street, nearer, cv::Matx23d(larger, 0, (1 - larger) * 320, 0, larger, (1 - larger) * 190),
                   street.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
    cv::imwrite(folder_ / "a.png", street);
    cv::imwrite(folder_ / "b.png", nearer);
    const Arguments inputs = {folder_ / "a.png", folder_ / "b.png"};
    // 1/30 s is what is assumed without a log. The origin of the times doesn't matter.
    const std::vector<Json> untold = resultsOf(run(inputs, {"--carry"}));
    const std::vector<Json> close =
        resultsOf(runWithLog("file,time_s\na.png,0\nb.png,0.033333333333333333\n", inputs, {"--carry"}));
    const std::vector<Json> far = resultsOf(runWithLog("file,time_s\na.png,0\nb.png,0.1\n", inputs, {"--carry"}));
    ASSERT_EQ(2u, untold.size());
    EXPECT_EQ(untold, close);
    // Frames whose numbers are missing in a pattern have had their time.
    cv::imwrite(folder_ / "n1.png", street);
    cv::imwrite(folder_ / "n2.png", street);
    cv::imwrite(folder_ / "n5.png", nearer);
    const Arguments numbered = {folder_ / "n%d.png"};
    const Json missing = resultsOf(run(numbered, {"--carry"}))[2],
               told = resultsOf(
                   runWithLog("frame,time_s\n0,0\n1,0.0333333333333\n2,0.133333333333\n", numbered, {"--carry"}))[2];
    for (const char* key : {"speed_km_h", "speed_sigma"})
        EXPECT_NEAR(told[key].get<double>(), missing[key].get<double>(), 1e-6 * told[key].get<double>()) << key;
    // The first one is given by the second.
    EXPECT_NE(untold[0], far[0]);
    EXPECT_NE(untold[1], far[1]);
}

TEST_F(CorrectLog, speed_without_line_delay)
{
    writeContent(folder_ / "log.csv", "file,speed_kmh\nrolling.png,55\n");
    const Outcome outcome = correct({image_, "--focal=816", "--report=-", "--log=" + (folder_ / "log.csv")});
    EXPECT_EQ(0, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("speed_kmh in the log has no effect without the line delay"))
        << outcome.messages;
}

// Samples of ten times a second in milliseconds; constant values may have two, however far apart.
TEST_F(CorrectLog, samples_in_another_unit)
{
    const std::string image = "file,time_s,speed_kmh\nrolling.png,150,\n", warning = "its times seem not to be in "
                                                                                     "seconds";
    const Outcome milliseconds = runWithLog(image + ",0,50\n,100,52\n,200,55\n", {image_});
    EXPECT_EQ(0, milliseconds.exitCode);
    EXPECT_NE(std::string::npos,
              milliseconds.messages.find("no sample of the log is less than 100 s after the one before: " + warning))
        << milliseconds.messages;
    for (const char* samples : {",0,50\n,900,50\n", ",149,50\n,150,52\n,151,55\n"})
    {
        const Outcome sound = runWithLog(image + samples, {image_});
        EXPECT_EQ(std::string::npos, sound.messages.find(warning)) << sound.messages;
    }
}

// As those of GPS time are to a camera's clock that begins at 0.
TEST_F(CorrectLog, samples_at_no_frame)
{
    const std::string image = "file,time_s,speed_kmh\nrolling.png,150,\n",
                      warning = "the samples of the log have no effect: all frames are outside of their times, ";
    for (const Arguments& options : {Arguments(), Arguments{"--carry"}})
    {
        const Outcome later = runWithLog(image + ",1764154100,66\n,1764154101,66\n", {image_}, options);
        EXPECT_EQ(0, later.exitCode);
        EXPECT_NE(std::string::npos, later.messages.find(warning + "1764154100 to 1764154101 s: ")) << later.messages;
        EXPECT_EQ(1, std::count(later.messages.begin(), later.messages.end(), '\n')) << later.messages;
        EXPECT_EQ("", runWithLog(image + ",150,66\n,151,66\n", {image_}, options).messages);
    }
    // One of the images suffices.
    cv::imwrite(folder_ / "a.png", streetImage());
    const std::string both = image + "a.png,100,\n,100,66\n,101,66\n";
    EXPECT_EQ("", runWithLog(both, {image_, folder_ / "a.png"}).messages);
    EXPECT_NE("", runWithLog(both, {image_}).messages);
}

// What isn't understood is refused with its place.
TEST_F(CorrectLog, refused)
{
    const std::pair<const char*, const char*> logs[] = {
        {"", "is empty"},
        {"file,speed_mph\nrolling.png,30\n", "column 2"},
        {"file,speed_mph\nrolling.png,30\n", "speed_mph"},
        {"file,speed_kmh,\nrolling.png,30,\n", "column 3"},
        {"file,speed_kmh,speed_kmh\nrolling.png,30,30\n", "twice"},
        {"file,speed_sigma_kmh\nrolling.png,30\n", "needs the column speed_kmh"},
        {"file,speed_kmh\nrolling.png,30\nb.png,fast\n", "line 3"},
        {"file,speed_kmh\nrolling.png,30\nb.png,fast\n", "column speed_kmh: 'fast'"},
        {"file,speed_kmh\nrolling.png,nan\n", "'nan'"},
        {"file,speed_kmh\nrolling.png,-inf\n", "'-inf'"},
        {"file,speed_kmh\nrolling.png,0x1E\n", "column speed_kmh: '0x1E' is not a number"},
        {"file,frame\nrolling.png,0x0\n", "column frame: '0x0' is not a number"},
        {"file,speed_kmh\nrolling.png,1e9\n", "line 2"},
        {"file,speed_kmh,speed_sigma_kmh\nrolling.png,30,0\n", "speed_sigma_kmh"},
        {"file,roll_deg\nrolling.png,91\n", "roll_deg"},
        {"frame,speed_kmh\n-1,30\n", "column frame"},
        {"frame,speed_kmh\n0.5,30\n", "column frame"},
        {"file,speed_kmh\nrolling.png,30\nrolling.png,31\n", "the frame is that of line 2"},
        {"file,speed_kmh\nrolling.png\n", "1 cells, but 2 columns"},
        {"file,speed_kmh\n\"rolling.png,30\n", "a quote isn't closed"},
        {"file,speed_kmh\n\"rolling\".png,30\n", "behind a closing quote"},
        {"file,speed_kmh\nrolling.png,1\n,30\n", "neither a frame's name nor a time"},
        {"file,time_s,speed_kmh\nrolling.png,1,1\n,2,30\n,2,31\n", "times must increase"},
        {"file,speed_kmh\nother.png,30\n", "names none of the images"},
        {"time_s,speed_kmh\n0,30\n", "names none of the images (columns file or frame), and samples need"}};
    const Outcome zero = runWithLog(std::string("file,speed_kmh\nrolling.png,30\0\n", 31), {image_});
    EXPECT_EQ(2, zero.exitCode) << zero.messages;
    for (const std::pair<const char*, const char*>& log : logs)
    {
        const Outcome outcome = runWithLog(log.first, {image_});
        EXPECT_EQ(2, outcome.exitCode) << log.first;
        EXPECT_NE(std::string::npos, outcome.messages.find(log.second)) << log.first << outcome.messages;
    }
}

// Under different names.
TEST_F(CorrectLog, frames_that_are_named_twice)
{
    ASSERT_TRUE(cv::utils::fs::createDirectory(folder_ / "drive"));
    const std::string a = folder_ / "a.png", b = folder_ / "drive/b.png", other = folder_ / "drive/a.png";
    for (const std::string& path : {a, b, other})
        cv::imwrite(path, cv::Mat(48, 64, CV_8U, cv::Scalar(40)));
    const struct
    {
        Arguments inputs;
        std::string rows, message;
    } logs[] = {{{a, b}, "b.png,,40\na.png,,40\n" + b + ",,90\n", "lines 2 and 4 of "},
                {{a, b}, "b.png,,40\n" + b + ",,90\n", "both name image 1, " + b},
                {{a, b}, ",1,40\nb.png,,90\n", "both name image 1, " + b},
                {{a, b}, "b.png,0,40\na.png,1,40\n", ""}, // numbers of a longer drive, of which these are a part
                {{b, a, b}, "b.png,0,40\na.png,1,40\n", ""},
                {{a, other}, a + ",,40\n" + other + ",,40\n", ""}};
    for (const auto& log : logs)
    {
        writeContent(folder_ / "log.csv", "file,frame,speed_kmh\n" + log.rows);
        const Outcome outcome =
            correct(log.inputs + Arguments{"--focal=60", "--report=-", "--log=" + (folder_ / "log.csv")});
        EXPECT_EQ(log.message.empty() ? 0 : 2, outcome.exitCode) << log.rows << outcome.messages;
        EXPECT_NE(std::string::npos, outcome.messages.find(log.message)) << log.rows << outcome.messages;
    }
}

// Of 30 frames/s; those of 25 and 10 frames/s have two decimals, whatever is missing.
TEST(CorrectLogTimes, that_are_rounded)
{
    const TemporaryFolder folder;
    const char* const logs[] = {"0.00 0.03 0.07 0.10 0.13", "0.000 0.033 0.067 0.100 0.133", "0.00 0.04 0.08 0.12 0.16",
                                "1e9 1000000000.03 1000000000.07 1000000000.1 1000000000.13", "0.0 0.1 0.2 0.4 0.5"};
    for (int k = 0; k < 5; k++)
    {
        std::istringstream times(logs[k]);
        std::string log = "file,time_s\n", time;
        for (int i = 0; times >> time; i++)
        {
            const std::string name = cv::format("%d.png", i);
            cv::imwrite(folder / name, cv::Mat(48, 64, CV_8U, cv::Scalar(40)));
            log += name + "," + time + "\n";
        }
        writeContent(folder / "log.csv", log);
        const Outcome outcome = correct(
            {folder.path(), "--focal=60", "--readout=0.03", "--carry", "--report=-", "--log=" + (folder / "log.csv")});
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_EQ(k == 0 || k == 3, outcome.messages.find("rounded to 0.01 s") != std::string::npos)
            << outcome.messages;
    }
}

}} // namespace
