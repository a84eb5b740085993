// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"

#include <unistd.h>

namespace opencv_test { namespace {

TEST(CorrectUsage, help_names_every_option)
{
    const Outcome outcome = correct({"--help"});
    EXPECT_EQ(0, outcome.exitCode);
    for (const char* name : {"camera",        "focal",
                             "line_delay",    "readout",
                             "scan",          "reference",
                             "roll",          "pitch",
                             "heading",       "height",
                             "gravity_sigma", "usual_yaw_rate",
                             "wall",          "scale_from_road",
                             "speed",         "speed_sigma",
                             "yaw_rate",      "yaw_rate_sigma",
                             "log",           "gyro",
                             "gyro_delay",    "depth",
                             "depth_kind",    "depth_camera",
                             "depth_scale",   "depth_scale_sigma",
                             "baseline",      "carry",
                             "model",         "detector",
                             "lines",         "seed",
                             "threads",       "output",
                             "overlay",       "report",
                             "maps",          "shard",
                             "skip_existing", "overwrite"})
        EXPECT_NE(std::string::npos, outcome.output.find(std::string("--") + name)) << name;
}

// What is printed may be all that there is.
TEST(CorrectUsage, standard_output_that_is_full)
{
    const TemporaryFolder folder;
    const std::string report = folder / "report.jsonl", maps = folder / "maps.yml";
    ASSERT_EQ(0, correct({streetFolder() + "/rolling.png", "--camera=" + streetFolder() + "/camera.yml",
                          "--report=" + report, "--maps=" + maps})
                     .exitCode);
    const std::string evaluation = std::string(EVALUATE_PROGRAM) + " --truth=" + streetFolder() +
                                   "/truth.json --maps=" + maps + " --report=" + report;
    std::vector<std::string> commands = {evaluation};
    for (const char* program :
         {CALIBRATE_PROGRAM, CORRECT_PROGRAM, EVALUATE_PROGRAM, EXPORT_PROGRAM, PAGE_PROGRAM, SIMULATE_PROGRAM})
        commands.push_back(std::string(program) + " --help");
    for (const std::string& command : commands)
    {
        const Outcome outcome = runCommand(command + " > /dev/full");
        EXPECT_EQ(1, outcome.exitCode) << command;
        EXPECT_NE(std::string::npos, outcome.messages.find("standard output can't be written")) << outcome.messages;
        EXPECT_EQ(0, runCommand(command).exitCode) << command;
    }
}

// Every command line here is refused: exit code 2, the message names what is wrong, nothing is written.
class CorrectRefuses : public testing::TestWithParam<std::pair<const char*, const char*>>
{
};

TEST_P(CorrectRefuses, command_line)
{
    const TemporaryFolder folder;
    const std::string option = GetParam().first, named = GetParam().second;
    const Outcome outcome = correct({streetFolder() + "/rolling.png", "--output=" + (folder / "out.png"),
                                     "--report=" + (folder / "report.jsonl"), option});
    EXPECT_EQ(2, outcome.exitCode) << outcome.messages;
    EXPECT_NE(std::string::npos, outcome.messages.find(named)) << outcome.messages;
    EXPECT_TRUE(namesIn(folder.path()).empty());
}

const std::pair<const char*, const char*> refused[] = {{"--outptu=x.png", "--outptu"},
                                                       {"--gravity=0", "--gravity"},
                                                       {"-v", "-v"},
                                                       {"-focal=500", "-focal"},
                                                       {"--focal=abc", "abc"},
                                                       {"--focal=500px", "500px"},
                                                       {"--focal=", "--focal"},
                                                       {"--focal", "--focal"},
                                                       {"--focal=nan", "nan"},
                                                       {"--focal=inf", "inf"},
                                                       {"--focal=0x1f4", "0x1f4"},
                                                       {"--focal=0", "--focal"},
                                                       {"--focal=-816", "--focal"},
                                                       {"--seed=-1", "from 0 to 2147483647"},
                                                       {"--focal=1e999", "1e999"},
                                                       {"--line_delay=0", "--line_delay"},
                                                       {"--readout=x", "--readout"},
                                                       {"--readout=30", "--readout"}, // milliseconds
                                                       {"--scan=sideways", "sideways"},
                                                       {"--reference=half", "half"},
                                                       {"--reference=1e40", "option --reference"},
                                                       {"--reference=-1e10", "-1e10 is not from"},
                                                       {"--focal=1e-40", "option --focal"},
                                                       {"--focal_sigma=1e-40", "option --focal_sigma"},
                                                       {"--readout=1e-40", "option --readout"},
                                                       {"--height=1e-40", "option --height"},
                                                       {"--wall=1e-40", "option --wall"},
                                                       {"--usual_yaw_rate=1e-40", "option --usual_yaw_rate"},
                                                       {"--roll=1,5", "--roll"},
                                                       {"--roll=180", "--roll"},
                                                       {"--pitch=90", "--pitch"},
                                                       {"--heading=200", "--heading"},
                                                       {"--height=0", "--height"},
                                                       {"--wall=-1", "--wall"},
                                                       {"--gravity_sigma=-1", "--gravity_sigma"},
                                                       {"--gravity_sigma", "--gravity_sigma"},
                                                       {"--usual_yaw_rate=0", "--usual_yaw_rate"},
                                                       {"--speed=fast", "fast"},
                                                       {"--speed", "--speed"},
                                                       {"--speed_sigma=2", "--speed"},
                                                       {"--yaw_rate=1e4", "--yaw_rate"},
                                                       {"--yaw_rate=", "--yaw_rate"},
                                                       {"--yaw_rate_sigma=1", "--yaw_rate"},
                                                       {"--gyro=nothing.csv", "nothing.csv"},
                                                       {"--gyro_delay=1", "--gyro"},
                                                       {"--depth=/no/such", "--depth"},
                                                       {"--depth_scale=1", "--depth"},
                                                       {"--depth_scale_sigma=0.1", "--depth"},
                                                       {"--depth_kind=relative", "--depth"},
                                                       {"--baseline=1", "--depth"},
                                                       {"--carry=perhaps", "--carry"},
                                                       {"--model=5la", "5la"},
                                                       {"--detector=canny", "canny"},
                                                       {"--seed=1.5", "--seed"},
                                                       {"--seed=-1", "--seed"},
                                                       {"--threads=0", "--threads"},
                                                       {"--shard=3", "--shard"},
                                                       {"--shard=5/4", "--shard"},
                                                       {"--shard=0/4", "'0' is not a whole number from 1 to 4"},
                                                       {"--shard=1/0", "--shard"},
                                                       {"--skip_existing=perhaps", "--skip_existing"},
                                                       {"--log=/no/such/file.csv", "/no/such/file.csv"},
                                                       {"--log", "--log"},
                                                       {"--camera=/no/such/file.yml", "/no/such/file.yml"},
                                                       {"--lines=/no/such/file.txt", "/no/such/file.txt"},
                                                       {"--output=again.png", "--output"}};

INSTANTIATE_TEST_CASE_P(Usage, CorrectRefuses, testing::ValuesIn(refused));

TEST(CorrectUsage, options_that_exclude_each_other)
{
    const std::string image = streetFolder() + "/rolling.png", camera = "--camera=" + streetFolder() + "/camera.yml";
    EXPECT_EQ(2, correct({image, "--report=-", "--line_delay=1e-5", "--readout=0.01"}).exitCode);
    EXPECT_EQ(2, correct({image, "--report=-", "--focal=800", camera}).exitCode);
    EXPECT_EQ(2, correct({image, "--output=/tmp/never-written.png", "--skip_existing", "--overwrite"}).exitCode);
    EXPECT_EQ(2, correct({image, "--report=-", "--skip_existing"}).exitCode);
    EXPECT_EQ(2, correct({image, "--report=-", "--carry", "--shard=1/2"}).exitCode);
}

// Of 380 lines: they would be read in 13 s.
TEST(CorrectUsage, line_delay_in_milliseconds)
{
    const Outcome outcome = correct({streetFolder() + "/rolling.png", "--report=-", "--line_delay=0.035"});
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("camera.lineDelay is 0.035 s, 13.3 s for 380 lines; up to 1 s"))
        << outcome.messages;
}

TEST(CorrectUsage, unknown_keys_of_camera_files)
{
    const TemporaryFolder folder;
    const std::string camera = contentOf(streetFolder() + "/camera.yml");
    const auto messages = [&](const std::string& keys) {
        writeContent(folder / "camera.yml", camera + keys);
        return correct({streetFolder() + "/rolling.png", "--report=-", "--camera=" + (folder / "camera.yml")}).messages;
    };
    EXPECT_EQ("", messages(""));
    EXPECT_EQ("", messages("nr_of_frames: 20\nfocal_sigma: 5\n"));
    const std::string warning = messages("height: 1.2\nlinedelay: 3e-5\n");
    EXPECT_NE(std::string::npos, warning.find("keys that mean nothing here: height, linedelay\n")) << warning;
}

TEST(CorrectUsage, values_unlike_those_of_cameras_in_cars)
{
    const auto messages = [](const std::string& option) {
        return correct({streetFolder() + "/rolling.png", "--report=-", "--focal=816", option}).messages;
    };
    for (const char* usual : {"--height=0.3", "--height=4", "--readout=0.004", "--readout=0.3"})
        EXPECT_EQ("", messages(usual)) << usual;
    for (const char* height : {"--height=120", "--height=0.12"})
        EXPECT_NE(std::string::npos, messages(height).find("it is in metres above the road")) << messages(height);
    for (const char* readOut : {"--readout=0.00008", "--readout=0.0000165"})
        EXPECT_NE(std::string::npos, messages(readOut).find("it is in seconds, for all lines")) << messages(readOut);
    // Of the file, whose size tells the number of lines.
    const TemporaryFolder folder;
    writeContent(folder / "camera.yml", contentOf(streetFolder() + "/camera.yml"));
    const Outcome outcome = correct({streetFolder() + "/rolling.png", "--report=-", "--line_delay=0.0000001",
                                     "--camera=" + (folder / "camera.yml")});
    EXPECT_NE(std::string::npos, outcome.messages.find("the read-out of 3.8e-05 isn't one of")) << outcome.messages;
}

TEST(CorrectUsage, focal_length_that_is_not_in_pixels)
{
    const std::string image = streetFolder() + "/rolling.png", message = " is too short for an image of 640 x 380 "
                                                                         "pixels: it is in pixels, 61 at least";
    for (const char* focal : {"3.6", "35", "60"})
    {
        const Outcome outcome = correct({image, "--report=-", std::string("--focal=") + focal});
        EXPECT_EQ(1, outcome.exitCode) << focal;
        EXPECT_NE(std::string::npos, outcome.messages.find(focal + message)) << outcome.messages;
    }
    EXPECT_EQ(0, correct({image, "--report=-", "--focal=61"}).exitCode);
    const TemporaryFolder folder;
    const std::string matrix = "width: 640\nheight: 380\nk: [60, 0, 319.5, 0, 65, 189.5, 0, 0, 1]\n";
    for (const char* lens : {"plumb_bob\nd: [0, 0, 0, 0, 0]\n", "equidistant\nd: [0, 0, 0, 0]\n"})
    {
        writeContent(folder / "camera.yml", matrix + "distortion_model: " + lens);
        const Outcome outcome = correct({image, "--report=-", "--camera=" + (folder / "camera.yml")});
        EXPECT_EQ(lens[0] == 'p' ? 2 : 0, outcome.exitCode) << lens << outcome.messages;
        EXPECT_EQ(lens[0] == 'p', outcome.messages.find("60" + message) != std::string::npos) << outcome.messages;
    }
}

// The car is elsewhere then.
TEST(CorrectUsage, reference_line_far_away)
{
    const auto messages = [](const char* line) {
        return correct({streetFolder() + "/rolling.png", "--report=-", std::string("--reference=") + line}).messages;
    };
    for (const char* line : {"0", "379", "last"})
        EXPECT_EQ("", messages(line));
    for (const char* line : {"-0.5", "379.5", "1e9"})
        EXPECT_NE(std::string::npos, messages(line).find("is none of the image's (0 to 379)")) << messages(line);
}

TEST(CorrectUsage, names_of_results_that_can_not_be)
{
    const TemporaryFolder folder;
    const std::string image = streetFolder() + "/rolling.png";
    const std::pair<Arguments, std::string> cases[] = {
        {{"--output=" + (folder / "o.unknown")}, "o.unknown has no extension of an image format"},
        {{"--overlay=" + (folder / "o")}, "--overlay: " + (folder / "o") + " has no extension of an image format"},
        {{"--output=" + (folder / "o.jpg"), "--overlay=" + (folder / "o.jpg")}, "two results of "}};
    for (const std::pair<Arguments, std::string>& c : cases)
    {
        Arguments arguments = c.first;
        arguments.push_back(image);
        const Outcome outcome = correct(arguments);
        EXPECT_EQ(2, outcome.exitCode) << c.second;
        EXPECT_NE(std::string::npos, outcome.messages.find(c.second)) << outcome.messages;
        EXPECT_TRUE(namesIn(folder.path()).empty());
    }
}

TEST(CorrectUsage, sigmas_of_what_is_known)
{
    const std::string image = streetFolder() + "/rolling.png";
    for (const char* name : {"--speed", "--yaw_rate"})
        for (const char* sigma : {"_sigma", "_sigma=", "_sigma=0", "_sigma=-1", "_sigma=x"})
        {
            const Outcome outcome =
                correct({image, "--report=-", std::string(name) + "=10", name + std::string(sigma)});
            EXPECT_EQ(2, outcome.exitCode) << name << sigma;
            EXPECT_NE(std::string::npos, outcome.messages.find(std::string(name) + "_sigma")) << outcome.messages;
        }
}

TEST(CorrectUsage, something_to_read_and_something_to_write)
{
    EXPECT_EQ(2, correct({}).exitCode);
    EXPECT_EQ(2, correct({"--report=-"}).exitCode);
    EXPECT_EQ(2, correct({streetFolder() + "/rolling.png"}).exitCode);
}

// A name that can only be meant for one result makes no folder.
TEST(CorrectUsage, several_inputs_and_a_name_for_one_result)
{
    const TemporaryFolder in, out;
    for (const char* name : {"0.png", "1.png"})
        cv::imwrite(in / name, cv::Mat(48, 64, CV_8U, cv::Scalar(7)));
    writeContent(in / "list.txt", (in / "0.png") + "\n");
    writeContent(out / "existing", "");
    const std::pair<const char*, const char*> names[] = {
        {"output", "one.png"}, {"output", "one.mp4"},    {"output", "one.yml"}, {"output", "existing"},
        {"overlay", "o.TIFF"}, {"overlay", "new/o.jpg"}, {"maps", "m.yml.gz"},  {"maps", "m.xml"}};
    const Arguments several[] = {{in / "0.png", in / "1.png"}, {in.path()}, {in / "%d.png"}, {"@" + (in / "list.txt")}};
    for (const auto& named : names)
        for (const Arguments& inputs : several)
        {
            const std::string option = std::string("--") + named.first;
            const Outcome outcome = correct(inputs + Arguments{option + "=" + (out / named.second)});
            SCOPED_TRACE(option + " " + named.second + " " + inputs[0] + ": " + outcome.messages);
            EXPECT_EQ(2, outcome.exitCode);
            for (const std::string& part : {"option " + option, std::string(named.second), std::string("a folder")})
                EXPECT_NE(std::string::npos, outcome.messages.find(part)) << part;
            EXPECT_EQ(std::vector<std::string>{"existing"}, namesIn(out.path()));
        }
    // Those that are meant for folders do.
    cv::utils::fs::createDirectories(out / "there.png");
    for (const char* folder : {"new", "new.d/", "v1.2", "x.png/", "there.png"})
    {
        const Outcome outcome = correct({in.path(), "--output=" + (out / folder)});
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_EQ((std::vector<std::string>{"0.png", "1.png"}), namesIn(out / folder)) << folder;
    }
}

TEST(CorrectUsage, lines_are_for_one_input)
{
    const TemporaryFolder folder;
    const std::string a = streetFolder() + "/rolling.png", b = streetFolder() + "/global.png";
    writeContent(folder / "lines.txt", "1 2 3 4\n");
    EXPECT_EQ(2, correct({a, b, "--report=-", "--lines=" + (folder / "lines.txt")}).exitCode);
}

TEST(CorrectUsage, arguments_that_look_like_options)
{
    const TemporaryFolder folder;
    cv::imwrite(folder / "--x.png", streetImage());
    for (const char* arguments : {"--report=- -- --x.png", "-- --x.png --report=- --overwrite=maybe"})
    {
        const Outcome outcome = runCommand("cd " + folder.path() + " && " CORRECT_PROGRAM " " + arguments);
        const bool isOption = arguments[2] == 'r';
        EXPECT_EQ(isOption ? 0 : 2, outcome.exitCode) << outcome.messages;
        EXPECT_EQ(isOption, outcome.output.find("\"input\":\"--x.png\"") != std::string::npos) << outcome.output;
    }
}

TEST(CorrectUsage, broken_lines_file)
{
    const TemporaryFolder folder;
    for (const char* content : {"1 2 3\n", "1 2 3 4 5\n", "1 2 3 x\n", "1 2 3 1e39\n", "1 2 -1e93 4\n"})
    {
        writeContent(folder / "lines.txt", content);
        const Outcome outcome =
            correct({streetFolder() + "/rolling.png", "--report=-", "--lines=" + (folder / "lines.txt")});
        EXPECT_EQ(2, outcome.exitCode);
        EXPECT_NE(std::string::npos, outcome.messages.find("line 1 of")) << outcome.messages;
    }
}

TEST(CorrectUsage, results_of_the_same_name)
{
    const TemporaryFolder folder;
    EXPECT_EQ(2, correct({streetFolder() + "/rolling.png", "--output=" + (folder / "out.png"),
                          "--overlay=" + (folder / "out.png")})
                     .exitCode);
    EXPECT_EQ(2, correct({streetFolder() + "/rolling.png", "--output=" + (folder / "out.png"),
                          "--report=" + (folder / "out.png")})
                     .exitCode);
    EXPECT_TRUE(namesIn(folder.path()).empty());
    cv::utils::fs::createDirectories(folder / "a");
    cv::utils::fs::createDirectories(folder / "b");
    cv::imwrite(folder / "a/x.png", streetImage());
    cv::imwrite(folder / "b/x.png", streetImage());
    EXPECT_EQ(2, correct({folder / "a/x.png", folder / "b/x.png", "--output=" + (folder / "out")}).exitCode);
    EXPECT_EQ(2, correct({folder / "a/x.png", folder / "a/../a/x.png", "--output=" + (folder / "out")}).exitCode);
    EXPECT_FALSE(cv::utils::fs::exists(folder / "out"));
    // A report may have both.
    EXPECT_EQ(0, correct({folder / "a/x.png", folder / "b/x.png", "--report=-"}).exitCode);

    // One folder under two names.
    cv::imwrite(folder / "a/y.png", streetImage());
    cv::utils::fs::createDirectories(folder / "out");
    ASSERT_EQ(0, symlink((folder / "out").c_str(), (folder / "link").c_str()));
    for (const std::string& other :
         {folder / "out", folder / "./out/", folder / "link", folder / "a/../out", folder / "b/../link"})
    {
        const Outcome outcome = correct({folder / "a", "--output=" + (folder / "out"), "--overlay=" + other});
        EXPECT_EQ(2, outcome.exitCode) << other;
        EXPECT_NE(std::string::npos, outcome.messages.find("the same name")) << outcome.messages;
    }
    EXPECT_EQ(2,
              correct({folder / "a", "--output=" + (folder / "new"), "--overlay=" + (folder / "x/../new")}).exitCode);
    EXPECT_EQ(
        2, correct({folder / "a", "--output=" + (folder / "out"), "--report=" + (folder / "link/y.png"), "--overwrite"})
               .exitCode);
    EXPECT_TRUE(namesIn(folder / "out").empty());
    EXPECT_FALSE(cv::utils::fs::exists(folder / "new"));
    // Names that differ in their case are different here.
    cv::imwrite(folder / "a/Y.png", streetImage());
    EXPECT_EQ(0, correct({folder / "a", "--output=" + (folder / "out")}).exitCode);
    EXPECT_EQ((std::vector<std::string>{"Y.png", "x.png", "y.png"}), namesIn(folder / "out"));
}

}} // namespace
