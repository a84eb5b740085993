// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// No program writes to a file that it reads, whichever options name it and whatever it is called.

#include "program.hpp"

#include <map>
#include <unistd.h>

namespace opencv_test { namespace {

//! A program with options that read files, as --name=FILE, and options that write them.
struct Reads
{
    std::string program;
    Arguments others, inputs, outputs; //!< of inputs and outputs what stands before the file's name
};

class InputsStay : public testing::Test
{
protected:
    InputsStay()
    {
        cv::imwrite(folder / "a.png", cv::Mat(48, 64, CV_8U, cv::Scalar(7)));
        const std::string camera = contentOf(streetFolder() + "/camera.yml");
        files["--camera="] = camera.substr(0, camera.find("image_width")) + "image_width: 64\nimage_height: 48\n" +
                             camera.substr(camera.find("camera_matrix"));
        files["--log="] = "file,time_s\na.png,1\n";
        files["--gyro="] = "time_s,yaw_rate_deg_s,pitch_rate_deg_s,roll_rate_deg_s\n0,0,0,0\n1,0,0,0\n";
        files["--depth="] = "no depth";
        files["--lines="] = "1 2 1 40\n";
        files["@"] = (folder / "a.png") + "\n";
        files["--report="] = "{\"input\":\"a.png\",\"status\":\"not_significant\"}\n";
        files["--tracks="] = "file,x,y\na.png,1,2\n";
        files["--points="] = "file,x,y,z\na.png,1,2,3\n";
        files["--image="] = contentOf(folder / "a.png");
        files["--motion="] = "%YAML:1.0\n---\nstatus: 1\n";
    }

    const TemporaryFolder folder;
    std::map<std::string, std::string> files; //!< content by the option that reads it
};

TEST_F(InputsStay, whatever_reads_and_writes_them)
{
    const Reads programs[] = {
        {CORRECT_PROGRAM,
         {folder / "a.png"},
         {"--camera=", "--log=", "--gyro=", "--depth=", "--lines="},
         {"--maps=", "--report=", "--output="}},
        {CORRECT_PROGRAM, {}, {"@"}, {"--report="}},
        {CALIBRATE_PROGRAM, {folder / "a.png", "--focal=50"}, {"--log="}, {"--output="}},
        {CALIBRATE_PROGRAM, {folder / "a.png"}, {"--camera="}, {"--output="}},
        {CALIBRATE_PROGRAM, {"--focal=50"}, {"@"}, {"--output="}},
        {EXPORT_PROGRAM, {"--size=64x48"}, {"--report=", "--motion="}, {"--row_poses=", "--mesh="}},
        {EXPORT_PROGRAM,
         {"--motion=" + (folder / "motion.yml"), "--size=64x48", "--tracks_output=" + (folder / "t.csv")},
         {"--tracks="},
         {"--row_poses=", "--mesh="}},
        {EXPORT_PROGRAM,
         {"--motion=" + (folder / "motion.yml"), "--size=64x48", "--points_output=" + (folder / "p.csv")},
         {"--points="},
         {"--row_poses="}},
        {EXPORT_PROGRAM, {"--motion=" + (folder / "motion.yml"), "--size=64x48"}, {"--points="}, {"--points_output="}},
        {PAGE_PROGRAM, {}, {"--report="}, {"--output="}}};
    writeContent(folder / "motion.yml", files["--motion="]);
    for (const Reads& reads : programs)
        for (const std::string& input : reads.inputs)
            for (const std::string& output : reads.outputs)
                for (const char* way : {"same", "dot", "symbolic", "hard"})
                    for (const char* existing : {"--overwrite", "--skip_existing"})
                    {
                        // All formats of results: a name that none of them refuses for its extension.
                        const std::string extension = output == "--maps=" || output == "--output=" ? ".yml" : ".txt",
                                          read = folder / ("input" + extension), other = folder / ("other" + extension);
                        std::remove(read.c_str());
                        std::remove(other.c_str());
                        writeContent(read, files.at(input));
                        std::string written = read;
                        if (way == std::string("dot"))
                            written = folder / ("./input" + extension);
                        else if (way != std::string("same"))
                        {
                            written = other;
                            ASSERT_EQ(0, way[0] == 's' ? symlink(read.c_str(), other.c_str())
                                                       : link(read.c_str(), other.c_str()));
                        }
                        Arguments arguments = reads.others;
                        arguments.insert(arguments.end(), {input + read, output + written});
                        if (reads.program == CORRECT_PROGRAM)
                            arguments.push_back(existing);
                        else if (reads.program == CALIBRATE_PROGRAM)
                            arguments.push_back("--overwrite");
                        SCOPED_TRACE(reads.program + " " + input + " " + output + " " + way);
                        const Outcome outcome = runProgram(reads.program, arguments);
                        EXPECT_EQ(2, outcome.exitCode) << outcome.messages;
                        EXPECT_NE(std::string::npos, outcome.messages.find("would replace the input"))
                            << outcome.messages;
                        EXPECT_EQ(files.at(input), contentOf(read));
                    }
}

TEST_F(InputsStay, folders_with_results_of_fixed_names)
{
    const std::string image = contentOf(folder / "a.png");
    for (const char* name : {"rolling.png", "global.png"})
    {
        const TemporaryFolder results;
        writeContent(results / name, image);
        const Outcome outcome = simulate({"--image=" + (results / name), "--output=" + results.path(), "--overwrite"});
        EXPECT_EQ(2, outcome.exitCode) << outcome.messages;
        EXPECT_EQ(image, contentOf(results / name));
    }
}

}} // namespace opencv_test::
