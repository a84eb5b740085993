// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "options.hpp"
#include "output/atomic_file.hpp"
#include "program.hpp"

#include <set>

#include "opencv2/rsackermann.hpp"
#include <fcntl.h>
#include "opencv2/imgproc.hpp"
#include <set>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace opencv_test { namespace {

typedef nlohmann::ordered_json Json;
typedef std::vector<std::string> Names;

// A folder with images and one for results.
class CorrectResults : public testing::Test
{
protected:
    void putImages(int count)
    {
        for (int i = 0; i < count; i++)
            cv::imwrite(in_ / cv::format("%02d.png", i), streetImage());
        writeContent(in_ / "notes.txt", "no image\n");
    }

    Arguments arguments(const Arguments& more = {}) const
    {
        Arguments all = {in_.path(), "--output=" + (out_ / "o"), "--report=" + (out_ / "report.jsonl")};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    // Lines of a report without times of computing, in any order.
    std::multiset<std::string> reportLines() const
    {
        std::multiset<std::string> lines;
        for (const std::string& text : linesOf(out_ / "report.jsonl"))
        {
            Json line = Json::parse(text);
            for (const char* key : {"ms_detect", "ms_estimate", "ms_map", "ms_remap"})
                line.erase(key);
            lines.insert(line.dump());
        }
        return lines;
    }

    const TemporaryFolder in_, out_;
};

// It says of a new file that there is no such file, and of itself that it's there.
TEST_F(CorrectResults, folder_that_takes_no_files)
{
    putImages(1);
    const Outcome outcome = correct({in_ / "00.png", "--output=/proc/00.png"});
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("/proc/00.png can't be written")) << outcome.messages;
}

// A disk on which a file can have some blocks only is as good as a full one.
Outcome correctOnFullDisk(const Arguments& arguments, int kilobytes)
{
    std::string command = cv::format("ulimit -f %d; '", kilobytes * 2) + CORRECT_PROGRAM + "'";
    for (const std::string& argument : arguments)
        command += " '" + argument + "'";
    return runCommand(command);
}

TEST_F(CorrectResults, full_disk)
{
    putImages(1);
    const std::string image = in_ / "00.png";
    for (const char* target : {"--output=", "--overlay=", "--maps="})
    {
        const std::string path = out_ / (target == std::string("--maps=") ? "x.yml.gz" : "x.png");
        const Outcome outcome = correctOnFullDisk({image, target + path}, 40);
        EXPECT_EQ(1, outcome.exitCode) << target;
        EXPECT_NE(std::string::npos, outcome.messages.find("can't be written")) << outcome.messages;
        EXPECT_TRUE(namesIn(out_.path()).empty()) << target;
        EXPECT_EQ(0, correctOnFullDisk({image, target + path, "--overwrite"}, 10000).exitCode) << target;
        cv::utils::fs::remove_all(path);
    }
    // All results or none.
    EXPECT_EQ(1, correctOnFullDisk({image, "--overlay=" + (out_ / "a.png"), "--maps=" + (out_ / "b.yml"),
                                    "--output=" + (out_ / "c.png")},
                                   1000)
                     .exitCode);
    EXPECT_TRUE(namesIn(out_.path()).empty());
    for (const char* target : {"--report=/dev/full", "--report=- >/dev/full"})
    {
        const Outcome outcome = runCommand(std::string(CORRECT_PROGRAM) + " " + image + " " + target);
        EXPECT_EQ(1, outcome.exitCode) << target;
        EXPECT_NE(std::string::npos, outcome.messages.find("can't be written")) << outcome.messages;
    }
}

TEST_F(CorrectResults, full_disk_and_the_report)
{
    putImages(8);
    const Outcome outcome = correctOnFullDisk({in_.path(), "--report=" + (out_ / "report.jsonl")}, 4);
    EXPECT_EQ(1, outcome.exitCode);
    // What is there is whole lines.
    const Names lines = linesOf(out_ / "report.jsonl");
    EXPECT_GT(lines.size(), 0u);
    EXPECT_LT(lines.size(), 8u);
    for (const std::string& line : lines)
        EXPECT_FALSE(Json::parse(line, nullptr, false).is_discarded()) << line;
    EXPECT_EQ('\n', contentOf(out_ / "report.jsonl").back());
    ASSERT_EQ(0, correct({in_.path(), "--report=" + (out_ / "report.jsonl"), "--skip_existing"}).exitCode);
    EXPECT_EQ(8u, reportLines().size());
}

TEST_F(CorrectResults, report_through_a_named_pipe)
{
    putImages(3);
    const std::string pipe = out_ / "pipe", read = out_ / "report.jsonl";
    const Outcome outcome = runCommand("mkfifo '" + pipe + "'; timeout 60 cat '" + pipe + "' >'" + read + "' & '" +
                                       CORRECT_PROGRAM + "' '" + in_.path() + "' '--report=" + pipe + "'; wait");
    EXPECT_EQ("", outcome.messages);
    EXPECT_EQ(3u, reportLines().size());
}

TEST_F(CorrectResults, motion_can_be_made_from_a_line)
{
    using namespace cv::rsackermann;
    ASSERT_EQ(0, correct({streetFolder() + "/rolling.png", "--camera=" + streetFolder() + "/camera.yml",
                          "--report=" + (out_ / "report.jsonl"), "--maps=" + (out_ / "maps.yml")})
                     .exitCode);
    const Json line = Json::parse(contentOf(out_ / "report.jsonl"));
    AckermannMotion motion;
    motion.status = MOTION_OK;
    motion.alpha = line["alpha"];
    motion.wallSlope = line["beta"];
    motion.wallOffset = line["wall_offset"];
    motion.wallRatio = line["wall_ratio"];
    motion.roadSlope = line["road_slope"];
    motion.direction = line["direction"];
    motion.rollCorrection = line["roll_correction_deg"].get<double>() * CV_PI / 180;
    motion.pitchCorrection = line["pitch_correction_deg"].get<double>() * CV_PI / 180;
    ASSERT_NE(0, motion.rollCorrection);

    RollingShutterCamera camera(cv::Size(640, 380), cv::Matx33d(816, 0, 319.5, 0, 816, 189.5, 0, 0, 1));
    camera.lineDelay = 0.4 / 30 / 380;
    camera.height = 1.2;
    cv::Mat expected[2], got[2];
    WarpMapGenerator::create(camera)->initRectifyMap(motion, got[0], got[1]);
    cv::FileStorage maps(out_ / "maps.yml", cv::FileStorage::READ);
    maps["map1"] >> expected[0];
    maps["map2"] >> expected[1];
    for (int i = 0; i < 2; i++)
        EXPECT_LT(cv::norm(expected[i], got[i], cv::NORM_INF), 1e-3);

    ASSERT_EQ(16u, line["covariance"].size());
    for (int i = 0; i < 16; i++)
        motion.covariance.val[i] = line["covariance"][size_t(i)];
    EXPECT_NEAR(std::sqrt(motion.metricCovariance(camera)(0, 0)) * 180 / CV_PI, line["yaw_rate_sigma"].get<double>(),
                1e-9);
}

TEST_F(CorrectResults, shards_that_share_a_report)
{
    putImages(12);
    ASSERT_EQ(0, correct(arguments()).exitCode);
    const std::multiset<std::string> expected = reportLines();
    ASSERT_EQ(12u, expected.size());
    cv::utils::fs::remove_all(out_ / "o");
    std::remove((out_ / "report.jsonl").c_str());

    RunningProgram a(CORRECT_PROGRAM, arguments({"--shard=1/2"})), b(CORRECT_PROGRAM, arguments({"--shard=2/2"}));
    EXPECT_EQ(0, a.wait());
    EXPECT_EQ(0, b.wait());
    EXPECT_EQ(expected, reportLines());
    EXPECT_EQ(12u, namesIn(out_ / "o").size());

    // A shard replaces its own lines only, and only if it may.
    EXPECT_EQ(1, correct(arguments({"--shard=1/2"})).exitCode);
    EXPECT_EQ(expected, reportLines());
    EXPECT_EQ(0, correct(arguments({"--shard=1/2", "--overwrite"})).exitCode);
    EXPECT_EQ(expected, reportLines());
}

TEST_F(CorrectResults, going_on)
{
    putImages(5);
    cv::imwrite(in_ / "05.png", streetImage());
    cutShort(in_ / "05.png", in_ / "05.png", 0.5);
    const Arguments all = arguments({"--maps=" + (out_ / "m"), "--overlay=" + (out_ / "v")});
    ASSERT_EQ(1, correct(all).exitCode);
    const std::multiset<std::string> expected = reportLines();
    ASSERT_EQ(6u, expected.size());
    const std::string image = contentOf(out_ / "o/01.png"), maps = contentOf(out_ / "m/01.yml.gz"),
                      overlay = contentOf(out_ / "v/03.png");

    // Something of each kind is lost: an image, maps, an overlay, a line, the end of a line.
    std::remove((out_ / "o/01.png").c_str());
    std::remove((out_ / "m/01.yml.gz").c_str());
    std::remove((out_ / "v/03.png").c_str());
    writeContent(out_ / "o/02.png", "precious");
    Names lines = linesOf(out_ / "report.jsonl");
    writeContent(out_ / "report.jsonl",
                 lines[0] + "\n" + lines[1] + "\n" + lines[5] + "\n" + lines[3] + "\n" + lines[4].substr(0, 50));
    Arguments more = all;
    more.push_back("--skip_existing");
    EXPECT_EQ(1, correct(more).exitCode);
    EXPECT_EQ(expected, reportLines());
    EXPECT_EQ(image, contentOf(out_ / "o/01.png"));
    EXPECT_EQ(maps, contentOf(out_ / "m/01.yml.gz"));
    EXPECT_EQ(overlay, contentOf(out_ / "v/03.png"));
    EXPECT_EQ("precious", contentOf(out_ / "o/02.png"));
}

// The lines of other runs stay.
TEST_F(CorrectResults, going_on_beside_others)
{
    putImages(1);
    const std::string report = out_ / "report.jsonl", other = "{\"input\":\"elsewhere.png\",\"status\":\"ok\"}";
    writeContent(report, other + "\n");
    for (int i = 0; i < 2; i++)
    {
        ASSERT_EQ(0, correct(arguments({"--skip_existing"})).exitCode);
        EXPECT_EQ(2u, linesOf(report).size());
        EXPECT_EQ(1u, reportLines().count(other));
    }
}

// Somebody else has written lines with this job's inputs, but values of other types.
TEST_F(CorrectResults, going_on_with_lines_of_another_kind)
{
    putImages(2);
    const std::string report = out_ / "report.jsonl";
    for (const std::string& line : {"{\"input\":\"" + (in_ / "00.png") + "\",\"status\":1}",
                                    "{\"input\":\"" + (in_ / "01.png") + "\",\"frames\":\"many\"}"})
    {
        writeContent(report, line + "\n");
        const Outcome outcome = correct(arguments({"--skip_existing"}));
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_EQ(2u, linesOf(report).size());
    }
}

TEST_F(CorrectResults, going_on_with_a_carried_motion)
{
    putImages(4);
    const Arguments all = arguments({"--carry", "--camera=" + streetFolder() + "/camera.yml"});
    ASSERT_EQ(0, correct(all).exitCode);
    const std::multiset<std::string> expected = reportLines();
    const std::string image = contentOf(out_ / "o/02.png");
    std::remove((out_ / "o/02.png").c_str());
    const Names lines = linesOf(out_ / "report.jsonl");
    writeContent(out_ / "report.jsonl", lines[0] + "\n" + lines[1] + "\n" + lines[3] + "\n");
    Arguments more = all;
    more.push_back("--skip_existing");
    ASSERT_EQ(0, correct(more).exitCode);
    EXPECT_EQ(expected, reportLines());
    EXPECT_EQ(image, contentOf(out_ / "o/02.png"));
}

class CorrectInterrupted : public CorrectResults, public testing::WithParamInterface<int>
{
};

TEST_P(CorrectInterrupted, ends_after_the_present_input)
{
    const int count = 60;
    putImages(count);
    RunningProgram program(CORRECT_PROGRAM, arguments());
    while (linesOf(out_ / "report.jsonl").size() < 3)
        usleep(1000);
    program.send(GetParam());
    EXPECT_EQ(128 + GetParam(), program.wait());
    const Names done = namesIn(out_ / "o");
    EXPECT_GE(done.size(), 3u);
    EXPECT_LT(done.size(), size_t(count));
    EXPECT_EQ(done.size(), reportLines().size());
    for (const std::string& name : done)
        EXPECT_FALSE(cv::imread(out_ / "o/" + name).empty()) << name;
    EXPECT_EQ((Names{"o", "report.jsonl"}), namesIn(out_.path()));

    EXPECT_EQ(0, correct(arguments({"--skip_existing"})).exitCode);
    EXPECT_EQ(size_t(count), namesIn(out_ / "o").size());
    EXPECT_EQ(size_t(count), reportLines().size());
}

INSTANTIATE_TEST_CASE_P(Correct, CorrectInterrupted, testing::Values(SIGINT, SIGTERM));

// A temporary file that a killed program has left goes with the next run, and isn't an input. One with a lock is still
// written.
TEST_F(CorrectResults, temporary_files)
{
    putImages(1);
    cv::utils::fs::createDirectories(out_ / "o");
    for (const char* name : {".rsackermann-1-0.png", ".rsackermann-1-1.png"})
    {
        cv::imwrite(out_ / "o/" + name, streetImage());
        cv::imwrite(in_ / name, streetImage());
    }
    writeContent(out_ / "o/.hidden.png", "somebody's");
    const int locked = open((out_ / "o/.rsackermann-1-1.png").c_str(), O_RDONLY);
    ASSERT_EQ(0, flock(locked, LOCK_EX | LOCK_NB));
    ASSERT_EQ(0, correct(arguments()).exitCode);
    EXPECT_EQ((Names{".hidden.png", ".rsackermann-1-1.png", "00.png"}), namesIn(out_ / "o"));
    EXPECT_EQ(1u, linesOf(out_ / "report.jsonl").size());
    close(locked);
    ASSERT_EQ(0, correct(arguments({"--overwrite"})).exitCode);
    EXPECT_EQ((Names{".hidden.png", "00.png"}), namesIn(out_ / "o"));
    // Names as long as a file system takes.
    const std::string longest = std::string(251, 'x') + ".png";
    cv::imwrite(in_ / longest, streetImage());
    EXPECT_EQ(0, correct({in_ / longest, "--output=" + (out_ / "long/")}).exitCode);
    EXPECT_EQ(Names{longest}, namesIn(out_ / "long"));
}

// All or none, even if a name can't be replaced at the very end.
TEST_F(CorrectResults, files_appear_together)
{
    using rsackermann_samples::AtomicFiles;
    for (const bool isThere : {true, false})
    {
        const std::string first = out_ / "first", last = out_ / "last";
        runCommand("rm -rf " + first + " " + last);
        if (isThere)
            writeContent(first, "old");
        AtomicFiles files;
        files.add(first).write("new", 3);
        files.add(last).write("new", 3);
        cv::utils::fs::createDirectories(last); // no file can take its name
        EXPECT_THROW(files.commit(), rsackermann_samples::InputError);
        EXPECT_EQ(isThere, cv::utils::fs::exists(first));
        EXPECT_TRUE(!isThere || contentOf(first) == "old");
    }
    runCommand("rm -rf " + (out_ / "last"));
    AtomicFiles files;
    for (const char* name : {"first", "last"})
        files.add(out_ / name).write("new", 3);
    files.commit();
    EXPECT_EQ((Names{"first", "last"}), namesIn(out_.path()));
}

// Those of a video whose name isn't UTF-8 need their own lines.
// Results that replace others, of which only some may be read by all.
TEST_F(CorrectResults, permissions_stay)
{
    putImages(1);
    const Arguments options = {in_ / "00.png",
                               "--output=" + (out_ / "o.png"),
                               "--overlay=" + (out_ / "v.png"),
                               "--maps=" + (out_ / "m.yml.gz"),
                               "--report=" + (out_ / "r.jsonl"),
                               "--overwrite"};
    const Names names = {"o.png", "v.png", "m.yml.gz", "r.jsonl"};
    ASSERT_EQ(0, correct(options).exitCode);
    const auto modeOf = [&](const std::string& name) {
        struct stat status;
        EXPECT_EQ(0, stat((out_ / name).c_str(), &status)) << name;
        return int(status.st_mode & 07777);
    };
    const mode_t mask = umask(0);
    umask(mask);
    for (const std::string& name : names)
        EXPECT_EQ(0666 & ~int(mask), modeOf(name)) << name;
    for (const int mode : {0600, 0640, 0666})
    {
        for (const std::string& name : names)
            ASSERT_EQ(0, chmod((out_ / name).c_str(), mode_t(mode)));
        ASSERT_EQ(0, correct(options).exitCode);
        for (const std::string& name : names)
            EXPECT_EQ(mode, modeOf(name)) << name;
    }
}

TEST_F(CorrectResults, names_that_are_not_text)
{
    const Names names = {"a\xE4.png", "a\xF6.png", "a\xC3\xA4.png"};
    for (const std::string& name : names)
        cv::imwrite(in_ / name, streetImage());
    ASSERT_EQ(0, correct(arguments({"--skip_existing"})).exitCode);
    std::set<std::string> inputs;
    for (const std::string& line : linesOf(out_ / "report.jsonl"))
        inputs.insert(nlohmann::json::parse(line)["input"].get<std::string>());
    EXPECT_EQ(names.size(), inputs.size());
}

TEST_F(CorrectResults, overlay_of_a_grey_image)
{
    cv::imwrite(in_ / "a.pgm", cv::imread(streetFolder() + "/rolling.png", cv::IMREAD_GRAYSCALE));
    ASSERT_EQ(0, correct(arguments({"--overlay=" + (out_ / "v")})).exitCode);
    EXPECT_EQ(Names{"a.pgm"}, namesIn(out_ / "o"));
    EXPECT_EQ(Names{"a.png"}, namesIn(out_ / "v"));
}

// Neither maps nor copies of what nobody has asked for.
TEST_F(CorrectResults, memory_of_a_large_image)
{
    cv::Mat large;
    cv::resize(streetImage(), large, cv::Size(5944, 3530), 0, 0, cv::INTER_CUBIC);
    cv::imwrite(in_ / "large.jpg", large);
    for (const char* name : {"report.jsonl", "out.jpg"})
    {
        // Gravity is exact, so that there is a motion to be corrected.
        RunningProgram program(
            CORRECT_PROGRAM,
            {in_ / "large.jpg", (name[0] == 'r' ? "--report=" : "--output=") + (out_ / name), "--gravity_sigma=0"});
        ASSERT_EQ(0, program.wait());
        EXPECT_LE(program.peakMegabytes(), 300) << name;
    }
    EXPECT_EQ("ok", Json::parse(contentOf(out_ / "report.jsonl"))["status"]);
}

}} // namespace
