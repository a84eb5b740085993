// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Inputs of a sequence that fail keep their number and their time.

#include "program.hpp"
#include "turning_drive.hpp"

#include "opencv2/imgcodecs.hpp"

#include <functional>
#include <map>

namespace opencv_test { namespace {

typedef nlohmann::json Json;

enum Fault { NONE, DAMAGED, MISSING, OF_ANOTHER_SIZE, RESULT_EXISTS };

class CorrectSequence : public testing::Test
{
protected:
    static const int FRAMES = 9;

    //! The names of the frames, some of which have a fault.
    Arguments frames(const std::map<int, Fault>& faults) const
    {
        Arguments names;
        for (int i = 0; i < FRAMES; i++)
        {
            const std::string name = folder_ / cv::format("%02d.png", i);
            const Fault fault = faults.count(i) ? faults.at(i) : NONE;
            std::remove(name.c_str());
            if (fault == DAMAGED)
                writeContent(name, "no image");
            else if (fault != MISSING)
            {
                cv::Mat image = drive_.frame(i * drive_.interval);
                cv::imwrite(name, fault == OF_ANOTHER_SIZE ? image.rowRange(0, image.rows / 2) : image);
            }
            names.push_back(name);
        }
        return names;
    }

    //! The lines of the report by the names of the images.
    static std::map<std::string, Json> report(Arguments arguments, const Arguments& options = {})
    {
        const Arguments camera = {"--focal=816", "--readout=0.03", "--height=1.2", "--report=-"};
        arguments.insert(arguments.end(), camera.begin(), camera.end());
        arguments.insert(arguments.end(), options.begin(), options.end());
        std::istringstream stream(correct(arguments).output);
        std::map<std::string, Json> lines;
        for (std::string line; std::getline(stream, line);)
        {
            const Json json = Json::parse(line);
            const std::string input = json["input"];
            lines[input.substr(input.find_last_of('/') + 1)] = json;
        }
        return lines;
    }

    const TemporaryFolder folder_;
    TurningDrive drive_;
};

// Numbers count frames: of every second one the time between passes, too, so that no rate is taken for twice as much.
// Those of which the nearest would be more than a second apart count something else.
TEST_F(CorrectSequence, numbers_may_go_in_steps)
{
    const struct
    {
        int step;
        double framesOfStep;
    } cases[] = {{1, 1}, {2, 2}, {33333, 1}};
    for (const auto& c : cases)
    {
        SCOPED_TRACE(c.step);
        const TemporaryFolder folder;
        for (const int i : {0, 1, 2, 4})
            cv::imwrite(folder / cv::format("%06d.png", c.step * i),
                        drive_.frame(c.framesOfStep * i * drive_.interval));
        for (const auto& line : report({folder.path()}, {"--carry"}))
            EXPECT_NEAR(drive_.yawRate, line.second["yaw_rate_deg_s"].get<double>(), 1.5) << line.first;
    }
}

// Each frame but the first one has the true yaw rate within its uncertainty, whatever happens to others.
TEST_F(CorrectSequence, faults_of_frames_dont_change_the_motion_of_others)
{
    const std::map<int, Fault> tables[] = {{},
                                           {{5, DAMAGED}},
                                           {{6, DAMAGED}},
                                           {{5, MISSING}},
                                           {{5, DAMAGED}, {6, MISSING}},
                                           {{0, DAMAGED}, {1, DAMAGED}},
                                           {{4, OF_ANOTHER_SIZE}},
                                           {{3, MISSING}, {5, OF_ANOTHER_SIZE}, {7, DAMAGED}},
                                           {{5, RESULT_EXISTS}}};
    for (size_t table = 0; table < sizeof tables / sizeof tables[0]; table++)
    {
        const char* mode = table % 2 ? "--carry" : "--smooth";
        SCOPED_TRACE(cv::format("table %d, %s", int(table), mode));
        const Arguments names = frames(tables[table]);
        const std::string output = folder_ / "out";
        runCommand("rm -rf " + output + "; mkdir " + output);
        for (const std::pair<const int, Fault>& fault : tables[table])
            if (fault.second == RESULT_EXISTS)
                writeContent(output + cv::format("/%02d.png", fault.first), "mine");
        const std::map<std::string, Json> lines = report(names, {mode, "--output=" + output});
        ASSERT_EQ(size_t(FRAMES), lines.size()) << "each input has a line";
        int found = 0;
        for (int i = 0; i < FRAMES; i++)
        {
            const Json& line = lines.at(cv::format("%02d.png", i));
            const bool fails = tables[table].count(i) && tables[table].at(i) != OF_ANOTHER_SIZE;
            EXPECT_EQ(fails, line["status"] == "failed") << i;
            if (line["status"] != "ok" || tables[table].count(i))
                continue;
            found++;
            const double yawRate = line["yaw_rate_deg_s"], sigma = line["yaw_rate_sigma"];
            EXPECT_NEAR(drive_.yawRate, yawRate, std::max(4 * sigma, 1.)) << i;
        }
        EXPECT_GE(found, FRAMES - 2 * int(tables[table].size()) - 2);
    }
}

// In another unit, or backwards, they leave no sequence: that is said once.
TEST_F(CorrectSequence, times_that_begin_another_sequence)
{
    const TemporaryFolder times;
    const cv::Mat image(48, 64, CV_8U, cv::Scalar(7));
    for (const char* name : {"0.png", "1.png", "2.png"})
        cv::imwrite(times / name, image);
    const std::pair<const char*, const char*> cases[] = {
        {"0,0\n1,0.0333\n2,0.0667\n", ""},
        {"0,0\n1,1\n2,1.9\n", "/1.png: its time is 1 s after that of the image before"},
        {"0,0\n1,33.3\n2,66.7\n", "/1.png: its time is 33.3 s after that of the image before"},
        {"0,7\n1,7.5\n2,7.25\n", "/2.png: its time is -0.25 s after that of the image before"}};
    for (const auto& c : cases)
    {
        writeContent(times / "log.csv", std::string("frame,time_s\n") + c.first);
        const Arguments arguments = {times / "%d.png", "--focal=50", "--readout=0.03", "--report=-",
                                     "--log=" + (times / "log.csv")};
        EXPECT_EQ("", correct(arguments).messages);
        const std::string messages = correct(arguments + Arguments{"--carry"}).messages;
        EXPECT_NE(std::string::npos, messages.find(c.second)) << messages;
        EXPECT_EQ(*c.second ? 1 : 0, std::count(messages.begin(), messages.end(), '\n')) << messages;
    }
    const std::string untimed =
        correct({times / "%d.png", "--focal=50", "--readout=0.03", "--report=-", "--carry"}).messages;
    EXPECT_NE(std::string::npos, untimed.find("taken for 1/30 s apart")) << untimed;
    EXPECT_EQ(1, std::count(untimed.begin(), untimed.end(), '\n')) << untimed;
}

// No sensor reads two frames at once.
TEST_F(CorrectSequence, read_out_longer_than_the_time_between_frames)
{
    const TemporaryFolder images;
    for (int i = 0; i < 7; i++)
        cv::imwrite(images / cv::format("%d.png", i), cv::Mat(48, 64, CV_8U, cv::Scalar(7)));
    const struct
    {
        const char *times, *readOut, *message; //!< no times: 1/30 s apart
    } cases[] = {{"", "0.05", ": the read-out of 0.05 s is longer than the 0.0333 s between frames"},
                 {"", "0.033", ""},
                 {"0 0.04 0.08 0.12 0.16", "0.04", ""},
                 {"0 0.04 0.08 0.12 0.16", "0.05", ": the read-out of 0.05 s is longer than the 0.04 s between frames"},
                 {"0 0.04 0.08 0.14 0.16 0.20", "0.038", ""},                         // jitter
                 {"0 0.02 0.04 0.06 5 5.02 5.04", "0.05", "longer than the 0.02 s"}}; // two sequences
    for (const auto& c : cases)
    {
        SCOPED_TRACE(c.times + std::string(" ") + c.readOut);
        std::istringstream times(c.times);
        std::string log = "frame,time_s\n", time;
        Arguments arguments = {"--focal=50", std::string("--readout=") + c.readOut, "--report=-"};
        int count = 0;
        for (; times >> time; count++)
            log += cv::format("%d,%s\n", count, time.c_str());
        writeContent(images / "log.csv", log);
        if (count > 0)
            arguments.push_back("--log=" + (images / "log.csv"));
        for (int i = 0; i < (count > 0 ? count : 3); i++)
            arguments.push_back(images / cv::format("%d.png", i));
        const Outcome carried = correct(arguments + Arguments{"--carry"});
        EXPECT_EQ(0, carried.exitCode);
        const size_t found = carried.messages.find("read-out");
        EXPECT_EQ(*c.message != 0, found != std::string::npos) << carried.messages;
        EXPECT_NE(std::string::npos, carried.messages.find(c.message)) << carried.messages;
        EXPECT_EQ(found, carried.messages.rfind("read-out of")) << carried.messages; // once
        EXPECT_EQ(std::string::npos, correct(arguments).messages.find("read-out"));
    }
}

// Images whose rows a log lacks are taken as far apart as the others, and not 1/30 s.
TEST_F(CorrectSequence, images_without_a_row_have_times_between_others)
{
    for (int i = 0; i < FRAMES; i++)
        cv::imwrite(folder_ / cv::format("%02d.png", i), drive_.frame(i * 2 * drive_.interval));
    const auto reportOf = [&](const std::string& rows) {
        writeContent(folder_ / "log.csv", "file,time_s\n" + rows);
        return report({folder_.path(), "--carry", "--log=" + (folder_ / "log.csv")});
    };
    const std::string some = "02.png,10\n03.png,10.0666667\n06.png,10.2666667\n";
    for (const auto& line : reportOf(some))
    {
        const int i = std::stoi(line.first);
        EXPECT_NEAR(10 + (i - 2) * 2 * drive_.interval, line.second["time_s"].get<double>(), 1e-6) << i;
        if (i > 0)
        {
            ASSERT_TRUE(line.second["yaw_rate_deg_s"].is_number()) << i;
            EXPECT_NEAR(drive_.yawRate, line.second["yaw_rate_deg_s"].get<double>(),
                        3 * line.second["yaw_rate_sigma"].get<double>())
                << i;
        }
    }
    // By the numbers of a pattern, of which one may be missing.
    std::remove((folder_ / "04.png").c_str());
    writeContent(folder_ / "log.csv", "file,time_s\n" + some);
    EXPECT_NEAR(
        10 + 3 * 2 * drive_.interval,
        report({folder_ / "%02d.png", "--carry", "--log=" + (folder_ / "log.csv")})["05.png"]["time_s"].get<double>(),
        1e-6);
    // One time says nothing of an interval, and neither do those of other sequences.
    for (const char* rows : {"02.png,10\n", "02.png,10\n06.png,9\n", "02.png,10\n03.png,90\n"})
        EXPECT_TRUE(reportOf(rows)["01.png"]["time_s"].is_null()) << rows;
}

// A converter that writes images twice, each as its encoder has it, makes times wrong; a car that stands doesn't.
TEST(Correct, repeated_images_are_told)
{
    const TurningDrive drive;
    const int count = 12;
    const struct
    {
        std::function<double(int)> time; // of what an image shows, in intervals
        const char* message;
    } cases[] = {{[](int i) { return i; }, ""},
                 {[](int i) { return i < 6 ? 0 : i; }, ""},
                 {[](int i) { return i / 2 * 2; }, "4 of 12 images nearly repeat the one before"},
                 {[](int i) { return i / 3 * 3; }, "4 of 12 images nearly repeat the one before"},
                 {[](int i) { return i == 5 ? 4 : i; }, ""}};
    for (const auto& c : cases)
    {
        const TemporaryFolder folder;
        for (int i = 0; i < count; i++)
            cv::imwrite(folder / cv::format("%02d.jpg", i), drive.frame(c.time(i) * drive.interval),
                        {cv::IMWRITE_JPEG_QUALITY, 90 - i % 3});
        const Arguments arguments = {folder.path(), cv::format("--focal=%g", drive.focal),
                                     cv::format("--readout=%g", drive.readout), "--report=-"};
        const std::string alone = correct(arguments).messages,
                          carried = correct(arguments + Arguments{"--carry"}).messages, said = "nearly repeat";
        EXPECT_EQ(std::string::npos, alone.find(said)) << alone;
        EXPECT_EQ(*c.message != 0, carried.find(said) != std::string::npos) << carried;
        EXPECT_NE(std::string::npos, carried.find(c.message)) << carried;
    }
}

// The row of a log by number is the same however the inputs are named and whichever of them fail.
TEST_F(CorrectSequence, number_of_an_input_doesnt_depend_on_others)
{
    writeContent(folder_ / "log.csv", "frame,time_s\n0,100\n1,101\n2,102\n3,103\n");
    for (const Fault fault : {DAMAGED, MISSING})
        for (int failing = 0; failing < 4; failing++)
        {
            Arguments names;
            for (int i = 0; i < 4; i++)
            {
                names.push_back(folder_ / cv::format("%02d.png", i));
                cv::imwrite(names.back(), cv::Mat(48, 64, CV_8U, cv::Scalar(7)));
            }
            fault == MISSING ? void(std::remove(names[failing].c_str())) : writeContent(names[failing], "no image");
            std::string list;
            for (const std::string& name : names)
                list += name + "\n";
            writeContent(folder_ / "list.txt", list);
            const std::vector<Arguments> commands = {names, {"@" + (folder_ / "list.txt")}};
            for (const Arguments& inputs : commands)
                for (const Arguments& shards : {Arguments{""}, Arguments{"--shard=1/2", "--shard=2/2"}})
                {
                    SCOPED_TRACE(cv::format("%d fails, %d arguments", failing, int(inputs.size())));
                    int lines = 0;
                    for (const std::string& shard : shards)
                    {
                        Arguments options = {"--log=" + (folder_ / "log.csv")};
                        if (!shard.empty())
                            options.push_back(shard);
                        for (const std::pair<const std::string, Json>& line : report(inputs, options))
                        {
                            lines++;
                            const int number = std::stoi(line.first);
                            EXPECT_EQ(number == failing, line.second["status"] == "failed") << number;
                            EXPECT_TRUE(number == failing || line.second["time_s"] == 100 + number) << line.second;
                        }
                    }
                    EXPECT_EQ(4, lines);
                }
        }
}

// A camera that looks to the right sees the right wall, and --wall is the distance of that.
TEST(Correct, distance_of_the_right_wall_of_a_sequence)
{
    const TemporaryFolder folder;
    const std::string drive = folder / "drive";
    ASSERT_EQ(0, simulate({"--output=" + drive, "--frames=3", "--speed=30", "--left=5", "--right=6", "--heading=-90",
                           "--yaw_rate=0", "--readout=0.03", "--stains=0.5"})
                     .exitCode);
    const Outcome outcome = correct({drive + "/frames", "--carry", "--wall=6", "--camera=" + drive + "/camera.yml",
                                     "--log=" + drive + "/log.csv", "--report=-"});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    std::istringstream lines(outcome.output);
    for (std::string line; std::getline(lines, line);)
    {
        const Json frame = Json::parse(line);
        EXPECT_EQ(6, frame["wall_distance_m"]);
        EXPECT_NEAR(0.1 * frame["speed_km_h"].get<double>(), frame["speed_sigma"].get<double>(), 0.1); // of the wall
        EXPECT_NEAR(30, frame["speed_km_h"].get<double>(), 3 * frame["speed_sigma"].get<double>());
    }
}

// A car that begins to turn steers as much as cars do: a mean over both intervals isn't that of one.
TEST(CorrectSmooth, bends_that_begin)
{
    const TemporaryFolder folder;
    for (const int yawRate : {-50, 40})
    {
        const std::string drive = folder / cv::format("%d", yawRate);
        ASSERT_EQ(0, simulate({"--output=" + drive, "--frames=10", "--speed=20", cv::format("--yaw_rate=%d", yawRate),
                               "--left=5", "--right=6", "--size=512x288", "--focal=653", "--samples=1"})
                         .exitCode);
        const std::vector<std::string> truth = linesOf(drive + "/truth.jsonl");
        Arguments arguments = {"--smooth", "--camera=" + drive + "/camera.yml", "--log=" + drive + "/log.csv",
                               "--report=-"};
        for (int i = 0; i < 10; i += 3) // 10 a second
            arguments.push_back(drive + cv::format("/frames/%06d.png", i));
        std::istringstream report(correct(arguments).output);
        std::string line;
        ASSERT_TRUE(std::getline(report, line)); // the first one has none before
        for (int i = 3; i < 9; i += 3)           // and the last one no next one
        {
            ASSERT_TRUE(std::getline(report, line));
            const double yaw = Json::parse(truth[i])["camera_yaw_rate_deg_s"];
            EXPECT_NEAR(yaw, Json::parse(line)["yaw_rate_deg_s"].get<double>(), 0.1 * std::abs(yaw)) << yawRate;
        }
    }
}

// Few points leave a car at rest possible in each frame, but not in all of them, nor if the speed is given.
TEST(CorrectCarry, small_images)
{
    const TemporaryFolder folder;
    for (const int speed : {40, 0})
    {
        const std::string drive = folder / cv::format("%d", speed);
        ASSERT_EQ(0, simulate({"--output=" + drive, "--frames=10", "--size=160x120", "--focal=140", "--readout=0.02",
                               cv::format("--speed=%d", speed), cv::format("--yaw_rate=%d", speed == 0 ? 0 : 15),
                               "--left=5", "--right=6", "--seed=16", "--samples=2"})
                         .exitCode);
        writeContent(drive + "/last.json", linesOf(drive + "/truth.jsonl").back());
        for (const bool isGiven : {false, true})
        {
            SCOPED_TRACE(cv::format("%d km/h, given %d", speed, isGiven));
            Arguments arguments = {
                "--carry",         "--camera=" + drive + "/camera.yml",   "--log=" + drive + "/log.csv",
                drive + "/frames", "--report=" + drive + "/report.jsonl", "--maps=" + drive + "/maps/",
                "--overwrite"};
            if (isGiven)
                arguments.push_back(cv::format("--speed=%d", speed));
            ASSERT_EQ(0, correct(arguments).exitCode);
            int corrected = 0;
            for (const std::string& line : linesOf(drive + "/report.jsonl"))
                corrected += Json::parse(line)["status"] == "ok";
            EXPECT_EQ(speed == 0 ? 0 : 10, corrected);
            const std::string output =
                evaluate({"--truth=" + drive + "/last.json", "--report=" + drive + "/report.jsonl",
                          "--maps=" + drive + "/maps/000009.yml.gz"})
                    .output;
            double before, after;
            const size_t at = output.find("mean displacement, px");
            ASSERT_NE(std::string::npos, at);
            ASSERT_EQ(2, std::sscanf(output.c_str() + at, "mean displacement, px %lf %lf", &before, &after));
            EXPECT_LE(after, speed == 0 ? 1e-3 : 0.1 * before);
        }
    }
}

}} // namespace opencv_test::
