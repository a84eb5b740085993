// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// No program writes to a file that it reads, whichever options name it and whatever it is called, nor to a file called
// -.

#include "program.hpp"
#include "camera_file.hpp"
#include "camera_settings.hpp"

#include <map>
#include <regex>
#include <set>
#include <unistd.h>

namespace opencv_test { namespace {

//! An option that writes: a file, or a folder with a file of this name.
struct Output
{
    Output(const char* option_, const char* name_ = "") : option(option_), name(name_) {}
    std::string option, name;
};

//! A program with options that read files and options that write them.
struct Reads
{
    std::string program;
    Arguments others, inputs; //!< of inputs what stands before the file's name, as --name=
    std::vector<Output> outputs;
};

class InputsStay : public testing::Test
{
protected:
    InputsStay()
    {
        cv::imwrite(folder / "a.png", cv::Mat(48, 64, CV_8U, cv::Scalar(7)));
        rsackermann_samples::CameraSettings camera;
        camera.size = cv::Size(64, 48);
        camera.K = cv::Matx33d(816, 0, 31.5, 0, 816, 23.5, 0, 0, 1);
        camera.readOut = 0.4 / 30;
        camera.height = 1.2;
        files["--camera="] = rsackermann_samples::cameraText(camera);
        files["--log="] = "file,time_s\na.png,1\n";
        files["--gyro="] = "time_s,yaw_rate_deg_s,pitch_rate_deg_s,roll_rate_deg_s\n0,0,0,0\n1,0,0,0\n";
        files["--depth="] = "no depth";
        files["--lines="] = "1 2 1 40\n";
        files["@"] = (folder / "a.png") + "\n";
        files["--report="] = "{\"input\":\"a.png\",\"status\":\"not_significant\"}\n";
        files["--tracks="] = "file,x,y\na.png,1,2\n";
        files["--model="] = "no network";
        files["--points="] = "file,x,y,z\na.png,1,2,3\n";
        files["--image="] = contentOf(folder / "a.png");
        files["--motion="] = "%YAML:1.0\n---\nstatus: 1\nrms: 0\n";
        files["--corrected="] = files["--overlay="] = files["--image="];
        writeContent(folder / "motion.yml", files["--motion="]);
        writeContent(folder / "report.jsonl", files["--report="]);
    }

    //! @param way in which the name of the result is that of the input.
    void checkInputStays(const Reads& reads, const std::string& input, const Output& output,
                         const std::string& way) const
    {
        SCOPED_TRACE(reads.program + " " + input + " " + output.option + output.name + " " + way);
        // All formats of results: a name that none of them refuses for its extension.
        const bool isImage = output.option == "--overlay=" || output.option == "--picture=",
                   isMaps = output.option == "--maps=" || output.option == "--output=";
        const std::string target = folder / "written";
        runCommand("rm -rf '" + target + "' && mkdir '" + target + "'");
        const std::string name = output.name.empty() ? isImage  ? "input.png"
                                                       : isMaps ? "input.yml"
                                                                : "input.txt"
                                                     : output.name,
                          written = target + "/" + name;
        std::string read = written;
        if (way == "symbolic" || way == "hard")
            read = target + "/other" + name.substr(name.find_last_of('.'));
        writeContent(read, files.at(input));
        if (way == "symbolic" || way == "hard")
        {
            ASSERT_EQ(0, way == "hard" ? link(read.c_str(), written.c_str()) : symlink(read.c_str(), written.c_str()));
        }
        const std::string result = output.name.empty() ? written : target;
        Arguments arguments = reads.others + Arguments{input + read, output.option + result};
        if (way == "dot")
            arguments.back() = output.option + (output.name.empty() ? target + "/./" + name : target + "/../written");
        arguments.push_back("--overwrite");
        const Outcome outcome = runProgram(reads.program, arguments);
        EXPECT_EQ(2, outcome.exitCode) << outcome.messages;
        EXPECT_NE(std::string::npos, outcome.messages.find("would replace the input")) << outcome.messages;
        EXPECT_EQ(files.at(input), contentOf(read));
        if (reads.program != CORRECT_PROGRAM || way != "same")
            return;
        arguments.back() = "--skip_existing";
        EXPECT_EQ(2, runProgram(reads.program, arguments).exitCode);
        EXPECT_EQ(files.at(input), contentOf(read));
    }

    const TemporaryFolder folder;
    std::map<std::string, std::string> files; //!< content by the option that reads it

    std::vector<Reads> programs() const
    {
        const std::string motion = "--motion=" + (folder / "motion.yml"), size = "--size=64x48";
        std::vector<Reads> list = {
            {CORRECT_PROGRAM,
             {folder / "a.png"},
             {"--camera=", "--log=", "--gyro=", "--depth=", "--lines="},
             {"--maps=", "--report=", "--output=", "--overlay=", {"--output=", "a.png"}}},
            {CORRECT_PROGRAM, {}, {"@"}, {"--report=", {"--output=", "a.png"}, {"--maps=", "a.yml.gz"}}},
            {CALIBRATE_PROGRAM, {folder / "a.png", "--focal=50"}, {"--log=", "--gyro="}, {"--output="}},
            {CALIBRATE_PROGRAM, {folder / "a.png"}, {"--camera="}, {"--output="}},
            {CALIBRATE_PROGRAM, {"--focal=50"}, {"@"}, {"--output="}},
            {EXPORT_PROGRAM,
             {size},
             {"--report=", "--motion="},
             {"--row_poses=", "--mesh=", "--gcsv=", {"--colmap=", "cameras.txt"}}},
            {EXPORT_PROGRAM, {size}, {"--report="}, {{"--stmap=", "a.png.rectify.png"}}},
            {EXPORT_PROGRAM, {size, motion}, {"--camera="}, {"--row_poses=", {"--stmap=", "frame.png.distort.png"}}},
            {EXPORT_PROGRAM,
             {motion, size, "--tracks_output=" + (folder / "t.csv")},
             {"--tracks="},
             {"--row_poses=", "--mesh="}},
            {EXPORT_PROGRAM, {motion, size, "--points_output=" + (folder / "p.csv")}, {"--points="}, {"--row_poses="}},
            {EXPORT_PROGRAM, {motion, size}, {"--points="}, {"--points_output="}},
            {EXPORT_PROGRAM, {motion, size}, {"--tracks="}, {"--tracks_output="}},
            {PAGE_PROGRAM, {}, {"--report="}, {"--output="}},
            {PAGE_PROGRAM, {"--report=" + (folder / "report.jsonl")}, {"--corrected=", "--overlay="}, {"--output="}},
            {SIMULATE_PROGRAM,
             {},
             {"--image="},
             {{"--output=", "rolling.png"}, {"--output=", "camera.yml"}, {"--output=", "truth.json"}}}};
#ifdef LIVE_PROGRAM
        list.push_back({LIVE_PROGRAM, {folder / "none.avi"}, {"--camera="}, {"--picture="}});
#endif
#ifdef DEPTH_NETWORK_PROGRAM
        list.push_back({DEPTH_NETWORK_PROGRAM, {folder / "a.png", "--focal=50"}, {"--model="}, {"--output="}});
        list.push_back({DEPTH_NETWORK_PROGRAM,
                        {folder / "a.png", "--model=" + (folder / "none.onnx")},
                        {"--camera="},
                        {"--output="}});
        list.push_back({DEPTH_NETWORK_PROGRAM,
                        {folder / "a.png", "--focal=50", "--output=" + (folder / "b.png")},
                        {"--model="},
                        {"--depth_output="}});
#endif
        return list;
    }
};

// An option that is new says what it does with files.
TEST_F(InputsStay, options_are_known)
{
    const std::set<std::string> noFiles = {
        "help",
        "focal",
        "focal_sigma",
        "line_delay",
        "readout",
        "scan",
        "reference",
        "roll",
        "pitch",
        "heading",
        "height",
        "overwrite",
        "threads",
        "detector",
        "wall",
        "size",
        "seed",
        "gyro_delay", // of several programs
        "scale_from_road",
        "speed",
        "speed_sigma",
        "yaw_rate",
        "yaw_rate_sigma",
        "depth_kind",
        "depth_camera",
        "depth_scale",
        "depth_scale_sigma",
        "baseline",
        "carry",
        "smooth",
        "gravity_sigma",
        "usual_yaw_rate",
        "model",
        "shard",
        "skip_existing", // of rsackermann_correct
        "stmap_format",
        "mesh_size", // of rsackermann_export
        "width",
        "embed",  // of rsackermann_page
        "frames", // of rsackermann_live and rsackermann_simulate
        "clutter",
        "global",
        "gyro",
        "gyro_bias",
        "gyro_noise",
        "gyro_rate",
        "left",
        "lens",
        "noise",
        "obstacles",
        "rays",
        "right",
        "samples",
        "shake",
        "shake_rate",
        "speed_swing",
        "stagger",
        "stains",
        "wall_direction",
        "depth", // of rsackermann_simulate
        "bgr",
        "input_size",
        "mean",
        "network",
        "scale" // of correct_with_depth_network
    };
    std::map<std::string, std::set<std::string>> tested;
    for (const Reads& reads : programs())
    {
        for (const std::string& input : reads.inputs)
            tested[reads.program].insert(input);
        for (const Output& output : reads.outputs)
            tested[reads.program].insert(output.option);
    }
    const std::regex option("\\n\\t--([a-z_]+)");
    for (const std::pair<const std::string, std::set<std::string>>& program : tested)
    {
        const std::string help = runProgram(program.first, {"--help"}).output;
        int count = 0;
        for (std::sregex_iterator it(help.begin(), help.end(), option); it != std::sregex_iterator(); ++it, count++)
        {
            const bool isFile = program.second.count("--" + (*it)[1].str() + "=") > 0;
            EXPECT_TRUE(isFile || noFiles.count((*it)[1])) << program.first << " --" << (*it)[1];
        }
        EXPECT_GT(count, 5) << program.first;
    }
}

// Whatever reads a file says that a folder is none, by its name.
TEST_F(InputsStay, folders_are_no_files)
{
    const std::string given = folder / "a_folder";
    ASSERT_TRUE(cv::utils::fs::createDirectory(given));
    const std::set<std::string> folders = {"--depth=", "--corrected=", "--overlay="};
    for (const Reads& reads : programs())
        for (const std::string& input : reads.inputs)
        {
            if (folders.count(input))
                continue;
            SCOPED_TRACE(reads.program + " " + input);
            const Outcome outcome = runProgram(
                reads.program, reads.others + Arguments{input + given, reads.outputs[0].option + (folder / "new.yml")});
            EXPECT_TRUE(outcome.exitCode == 1 || outcome.exitCode == 2) << outcome.exitCode;
            EXPECT_NE(std::string::npos, outcome.messages.find("a_folder")) << outcome.messages;
            EXPECT_EQ(std::string::npos, outcome.messages.find("basic_")) << outcome.messages;
            runCommand("rm -f '" + (folder / "new.yml") + "'");
        }
}

// Editors put it before UTF-8.
TEST_F(InputsStay, texts_may_begin_with_a_mark)
{
    const std::set<std::string> texts = {
        "--camera=", "--motion=", "--log=", "--gyro=", "--lines=", "@", "--report=", "--tracks=", "--points="};
    const std::string read = folder / "text.txt", written = folder / "new.yml";
    for (const Reads& reads : programs())
        for (const std::string& input : reads.inputs)
        {
            if (!texts.count(input))
                continue;
            SCOPED_TRACE(reads.program + " " + input);
            Outcome outcomes[2];
            for (int i = 0; i < 2; i++)
            {
                writeContent(read, (i == 0 ? "" : "\xEF\xBB\xBF") + files.at(input));
                outcomes[i] = runProgram(reads.program, reads.others + Arguments{input + read, "--overwrite",
                                                                                 reads.outputs[0].option + written});
            }
            EXPECT_EQ(outcomes[0].exitCode, outcomes[1].exitCode);
            EXPECT_EQ(outcomes[0].messages, outcomes[1].messages);
        }
}

// Standard output is that of --report of rsackermann_correct alone.
TEST_F(InputsStay, a_dash_is_no_result)
{
    for (const Reads& reads : programs())
        for (const Output& output : reads.outputs)
        {
            if (reads.program == CORRECT_PROGRAM && output.option == "--report=")
                continue;
            SCOPED_TRACE(reads.program + " " + output.option);
            const std::string input = reads.inputs[0] + (folder / "input");
            writeContent(folder / "input", files.at(reads.inputs[0]));
            const Outcome outcome = runProgram(reads.program, reads.others + Arguments{input, output.option + "-"});
            EXPECT_EQ(2, outcome.exitCode) << outcome.messages;
            EXPECT_NE(std::string::npos, outcome.messages.find("- isn't standard output")) << outcome.messages;
            EXPECT_FALSE(cv::utils::fs::exists("-"));
        }
}

class InputsStayByName : public InputsStay, public testing::WithParamInterface<const char*>
{
};

// A device would be replaced by a file.
TEST_F(InputsStay, devices_are_no_results)
{
    const std::string device = folder / "device.txt", size = "--size=64x48";
    ASSERT_EQ(0, symlink("/dev/null", device.c_str()));
    const std::pair<std::string, Arguments> cases[] = {
        {CALIBRATE_PROGRAM, {folder / "a.png", "--focal=50", "--output=" + device}},
        {CORRECT_PROGRAM, {folder / "a.png", "--maps=" + device}},
        {EXPORT_PROGRAM, {size, "--motion=" + (folder / "motion.yml"), "--row_poses=" + device}},
        {PAGE_PROGRAM, {"--report=" + (folder / "report.jsonl"), "--output=" + device}}};
    for (const auto& c : cases)
    {
        const Outcome outcome = runProgram(c.first, c.second + Arguments{"--overwrite"});
        EXPECT_EQ(1, outcome.exitCode) << c.first;
        EXPECT_NE(std::string::npos, outcome.messages.find("device.txt is a pipe or a device")) << outcome.messages;
        char target[16] = "";
        EXPECT_GT(readlink(device.c_str(), target, sizeof(target) - 1), 0) << c.first;
    }
}

// Every input as every result; other names than the input's own for the first ones.
TEST_P(InputsStayByName, whatever_reads_and_writes_them)
{
    const std::string way = GetParam();
    for (const Reads& reads : programs())
        for (size_t i = 0; i < reads.inputs.size(); i++)
            for (size_t k = 0; k < reads.outputs.size(); k++)
                if (way == "same" || i == 0 || k == 0)
                    checkInputStays(reads, reads.inputs[i], reads.outputs[k], way);
}

INSTANTIATE_TEST_CASE_P(Ways, InputsStayByName, testing::Values("same", "dot", "symbolic", "hard"));

}} // namespace opencv_test::
