// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"

#include "opencv2/imgproc.hpp"
#include <set>
#include <sys/stat.h>
#include <unistd.h>

namespace opencv_test { namespace {

// Good images under some names.
void putImages(const TemporaryFolder& folder, const std::vector<std::string>& names)
{
    for (const std::string& name : names)
        cv::imwrite(folder / name, streetImage());
}

std::vector<std::string> inputsOf(const std::string& report)
{
    std::vector<std::string> inputs;
    for (const std::string& line : linesOf(report))
    {
        const std::string input = nlohmann::json::parse(line)["input"];
        inputs.push_back(input.substr(input.find_last_of('/') + 1));
    }
    return inputs;
}

typedef std::vector<std::string> Names;

// Files that can't be read: exit code 1, the message names the file, nothing is written.
TEST(CorrectInputs, files_that_cannot_be_read)
{
    const TemporaryFolder in, out;
    putImages(in, {"good.png", "good.jpg", "good.bmp", "good.ppm", "good.tiff"});
    cutShort(in / "good.png", in / "half.png", 0.5);
    cutShort(in / "good.png", in / "without_end.png", 0.9999);
    cutShort(in / "good.jpg", in / "half.jpg", 0.5);
    cutShort(in / "good.jpg", in / "without_end.jpg", 0.9999);
    cutShort(in / "good.bmp", in / "half.bmp", 0.5);
    cutShort(in / "good.ppm", in / "half.ppm", 0.5);
    cutShort(in / "good.tiff", in / "half.tiff", 0.5);
    writeContent(in / "text.png", "This is no image.\n");
    writeContent(in / "empty.png", "");
    for (const char* name : {"half.png", "without_end.png", "half.jpg", "without_end.jpg", "half.bmp", "half.ppm",
                             "half.tiff", "text.png", "empty.png", "missing.png"})
    {
        const Outcome outcome = correct({in / name, "--output=" + (out / "out.png")});
        EXPECT_EQ(1, outcome.exitCode) << name;
        EXPECT_NE(std::string::npos, outcome.messages.find(name)) << outcome.messages;
        EXPECT_TRUE(namesIn(out.path()).empty()) << name;
    }
    for (const char* name : {"good.png", "good.jpg", "good.bmp", "good.ppm", "good.tiff"})
        EXPECT_EQ(0, correct({in / name, "--output=" + (out / "out.png"), "--overwrite"}).exitCode) << name;
}

TEST(CorrectInputs, jpeg_with_a_thumbnail_that_is_complete)
{
    const TemporaryFolder in, out;
    putImages(in, {"good.jpg"});
    cv::Mat small;
    cv::resize(streetImage(), small, cv::Size(80, 48));
    std::vector<uchar> thumbnail;
    cv::imencode(".jpg", small, thumbnail);
    // An application segment, as Exif is one, that holds a whole JPEG image.
    std::string segment = {'\xFF', '\xE5', char((thumbnail.size() + 2) >> 8), char((thumbnail.size() + 2) & 255)};
    segment.append(thumbnail.begin(), thumbnail.end());
    std::string content = contentOf(in / "good.jpg");
    content.insert(2, segment);
    writeContent(in / "whole.jpg", content);
    writeContent(in / "half.jpg", content.substr(0, content.size() / 2));
    EXPECT_EQ(0, correct({in / "whole.jpg", "--output=" + (out / "whole.png")}).exitCode);
    EXPECT_EQ(1, correct({in / "half.jpg", "--output=" + (out / "half.png")}).exitCode);
}

TEST(CorrectInputs, one_broken_image_among_good_ones)
{
    const TemporaryFolder in, out;
    putImages(in, {"a.png", "b.png", "d.PNG", "e.jpg"});
    cutShort(in / "a.png", in / "c.png", 0.7);
    writeContent(in / "notes.txt", "no image\n");
    cv::utils::fs::createDirectories(in / "folder.png");
    const Outcome outcome = correct({in.path(), "--output=" + (out / "results"), "--overlay=" + (out / "overlays"),
                                     "--report=" + (out / "report.jsonl")});
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("c.png"));
    const Names good = {"a.png", "b.png", "d.PNG", "e.jpg"};
    EXPECT_EQ(good, namesIn(out / "results"));
    EXPECT_EQ(good, namesIn(out / "overlays"));
    // The report has the broken one as well.
    EXPECT_EQ((Names{"a.png", "b.png", "c.png", "d.PNG", "e.jpg"}), inputsOf(out / "report.jsonl"));
    const nlohmann::json failed = nlohmann::json::parse(linesOf(out / "report.jsonl")[2]);
    EXPECT_EQ("failed", failed["status"]);
    EXPECT_EQ("the image is cut short", failed["error"]);
    EXPECT_EQ((Names{"overlays", "report.jsonl", "results"}), namesIn(out.path()));
}

// Images and videos are looked at more than once: of pipes nothing is read, and nothing waits for them.
TEST(CorrectInputs, pipes_and_devices)
{
    const TemporaryFolder in, out;
    putImages(in, {"a.png"});
    for (const char* name : {"pipe.png", "pipe.mp4"})
        ASSERT_EQ(0, mkfifo((in / name).c_str(), 0600));
    const Outcome outcome = correct({in.path(), in / "pipe.mp4", "/dev/null", "--output=" + (out / "images"),
                                     "--report=" + (out / "report.jsonl")});
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_EQ(Names{"a.png"}, namesIn(out / "images"));
    const std::vector<std::string> lines = linesOf(out / "report.jsonl");
    ASSERT_EQ(4u, lines.size());
    for (size_t i = 1; i < 4; i++)
        EXPECT_EQ("it is a pipe or a device; a file is expected", nlohmann::json::parse(lines[i])["error"]) << lines[i];
}

TEST(CorrectInputs, files_of_a_folder_that_are_left_out)
{
    const TemporaryFolder in, out;
    putImages(in, {"a.png"});
    const Arguments arguments = {in.path(), "--report=" + (out / "report.jsonl"), "--overwrite"};
    // What goes with images isn't missed.
    for (const char* name : {"log.csv", "README", "camera.yml"})
        writeContent(in / name, "x");
    EXPECT_EQ("", correct(arguments).messages);
    for (const char* name : {"drive.mp4", "other.MP4", "camera.insv", "drive.ts", ".hidden.mp4"})
        writeContent(in / name, "");
    ASSERT_TRUE(cv::imwrite(in / "b.pfm", cv::Mat(8, 8, CV_32F, cv::Scalar(1))));
    writeContent(in / "image", contentOf(in / "a.png"));
    const Outcome outcome = correct(arguments);
    EXPECT_EQ(0, outcome.exitCode);
    EXPECT_NE(std::string::npos,
              outcome.messages.find(in.path() + " stands for its images; 6 other files are left "
                                                "out: 1 without an extension, 1 .insv, 2 .mp4, 1 .pfm, 1 .ts\n"))
        << outcome.messages;
    for (const char* name : {"a.png", "drive.mp4", "other.MP4", "camera.insv", "drive.ts", "image"})
        std::remove((in / name).c_str());
    const Outcome none = correct(arguments);
    EXPECT_EQ(1, none.exitCode);
    EXPECT_NE(std::string::npos, none.messages.find("1 other file is left out: 1 .pfm\n")) << none.messages;
}

TEST(CorrectInputs, empty_folder_and_missing_folder)
{
    const TemporaryFolder in, out;
    putImages(in, {"a.png"});
    cv::utils::fs::createDirectories(in / "empty");
    const Outcome outcome = correct({in / "empty", in / "missing", in / "a.png", "--output=" + out.path()});
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("empty"));
    EXPECT_NE(std::string::npos, outcome.messages.find("missing"));
    EXPECT_EQ(Names{"a.png"}, namesIn(out.path()));
}

TEST(CorrectInputs, images_of_several_sizes)
{
    const TemporaryFolder in, out;
    putImages(in, {"a.png", "c.png"});
    cv::imwrite(in / "b.png", cv::Mat(1, 1, CV_8U, cv::Scalar(7)));
    EXPECT_EQ(0, correct({in.path(), "--output=" + out.path()}).exitCode);
    EXPECT_EQ(cv::Size(1, 1), cv::imread(out / "b.png").size());
    EXPECT_EQ(contentOf(out / "a.png"), contentOf(out / "c.png"));
}

TEST(CorrectInputs, existing_results)
{
    const TemporaryFolder in, out;
    putImages(in, {"a.png", "b.png"});
    writeContent(out / "a.png", "precious");
    const Outcome refused = correct({in.path(), "--output=" + out.path()});
    EXPECT_EQ(1, refused.exitCode);
    EXPECT_NE(std::string::npos, refused.messages.find("a.png"));
    EXPECT_EQ("precious", contentOf(out / "a.png"));
    EXPECT_TRUE(cv::utils::fs::exists(out / "b.png"));

    const Outcome skipped = correct({in.path(), "--output=" + out.path(), "--skip_existing"});
    EXPECT_EQ(0, skipped.exitCode);
    EXPECT_EQ("precious", contentOf(out / "a.png"));

    EXPECT_EQ(0, correct({in.path(), "--output=" + out.path(), "--overwrite"}).exitCode);
    EXPECT_EQ(contentOf(out / "b.png"), contentOf(out / "a.png"));
}

TEST(CorrectInputs, existing_report)
{
    const TemporaryFolder in, out;
    putImages(in, {"a.png", "b.png"});
    const std::string report = "--report=" + (out / "report.jsonl"), results = "--output=" + (out / "results");
    EXPECT_EQ(0, correct({in / "a.png", results + "/", report}).exitCode);
    EXPECT_EQ(1, correct({in / "b.png", report}).exitCode);
    EXPECT_EQ(Names{"a.png"}, inputsOf(out / "report.jsonl"));
    // A run that was stopped is continued.
    EXPECT_EQ(0, correct({in.path(), results, report, "--skip_existing"}).exitCode);
    EXPECT_EQ((Names{"a.png", "b.png"}), inputsOf(out / "report.jsonl"));
    EXPECT_EQ(0, correct({in / "b.png", report, "--overwrite"}).exitCode);
    EXPECT_EQ(Names{"b.png"}, inputsOf(out / "report.jsonl"));
}

TEST(CorrectInputs, inputs_are_never_replaced)
{
    const TemporaryFolder in;
    putImages(in, {"a.png"});
    const std::string before = contentOf(in / "a.png");
    ASSERT_EQ(0, symlink((in / "a.png").c_str(), (in / "link.png").c_str()));
    ASSERT_EQ(0, link((in / "a.png").c_str(), (in / "same.png").c_str()));
    for (const std::string& target :
         {"--output=" + in.path(), "--output=" + (in / "a.png"), "--overlay=" + (in / "./a.png"),
          "--report=" + (in / "a.png"), "--output=" + (in / "x/../a.png"), "--output=" + (in / "link.png"),
          "--report=" + (in / "same.png"), "--maps=" + (in / "same.png")})
    {
        const Outcome outcome = correct({in / "a.png", target, "--overwrite"});
        EXPECT_EQ(2, outcome.exitCode) << target;
        EXPECT_NE(std::string::npos, outcome.messages.find("would replace the input")) << outcome.messages;
    }
    // Neither is another input, nor one under the name of a link.
    EXPECT_EQ(2, correct({in / "link.png", "--output=" + (in / "link.png"), "--overwrite"}).exitCode);
    cv::imwrite(in / "b.png", streetImage());
    cv::utils::fs::createDirectories(in / "b");
    cv::imwrite(in / "b/a.png", streetImage());
    EXPECT_EQ(2,
              correct({in / "b/a.png", in / "a.png", in / "b.png", "--output=" + in.path(), "--overwrite"}).exitCode);
    EXPECT_EQ(before, contentOf(in / "a.png"));
    EXPECT_EQ((Names{"a.png", "b", "b.png", "link.png", "same.png"}), namesIn(in.path()));
}

TEST(CorrectInputs, results_that_cannot_be_written)
{
    const TemporaryFolder in;
    putImages(in, {"a.png"});
    writeContent(in / "file", "");
    EXPECT_EQ(1, correct({in / "a.png", "--output=" + (in / "file/out.png")}).exitCode);
    EXPECT_EQ((Names{"a.png", "file"}), namesIn(in.path()));
}

TEST(CorrectInputs, shards_are_all_inputs_once)
{
    const TemporaryFolder in, out;
    putImages(in, {"a.png", "b.png", "c.png", "d.png", "e.png"});
    std::multiset<std::string> done;
    for (const char* shard : {"1/3", "2/3", "3/3"})
    {
        const std::string report = (out / "report") + shard[0] + ".jsonl";
        EXPECT_EQ(0, correct({in.path(), "--report=" + report, std::string("--shard=") + shard}).exitCode);
        for (const std::string& input : inputsOf(report))
            done.insert(input);
    }
    EXPECT_EQ((std::multiset<std::string>{"a.png", "b.png", "c.png", "d.png", "e.png"}), done);
}

TEST(CorrectInputs, maps_of_several_images)
{
    const TemporaryFolder in, out;
    putImages(in, {"a.png", "b.jpg"});
    ASSERT_EQ(0, correct({in.path(), "--maps=" + (out / "maps/")}).exitCode);
    EXPECT_EQ((Names{"a.yml.gz", "b.yml.gz"}), namesIn(out / "maps"));
    for (const char* name : {"a.png", "b.jpg"})
    {
        ASSERT_EQ(0, correct({in / name, "--maps=" + (out / "alone.yml"), "--overwrite"}).exitCode);
        for (const char* node : {"map1", "map2"})
        {
            cv::Mat expected, got;
            cv::FileStorage(out / "alone.yml", cv::FileStorage::READ)[node] >> expected;
            cv::FileStorage(out / "maps/" + name[0] + ".yml.gz", cv::FileStorage::READ)[node] >> got;
            ASSERT_EQ(CV_32FC1, got.type());
            EXPECT_EQ(0, cv::norm(expected, got, cv::NORM_INF)) << name << node;
        }
    }
    // A single image goes to a folder if the name says so.
    ASSERT_EQ(0, correct({in / "a.png", "--maps=" + (out / "one/")}).exitCode);
    EXPECT_EQ(Names{"a.yml.gz"}, namesIn(out / "one"));
    putImages(in, {"a.jpg"});
    const Outcome sameStem = correct({in.path(), "--maps=" + (out / "none")});
    EXPECT_EQ(2, sameStem.exitCode);
    EXPECT_NE(std::string::npos, sameStem.messages.find("a.jpg")) << sameStem.messages;
}

TEST(CorrectInputs, files_that_are_not_what_they_should_be)
{
    const TemporaryFolder in;
    const std::string image = in / "a.png";
    cv::imwrite(image, cv::Mat(48, 64, CV_8U, cv::Scalar(7)));
    writeContent(in / "list.txt", "\xEF\xBB\xBF" + image + "\n");
    EXPECT_EQ(0, correct({"@" + (in / "list.txt"), "--report=-"}).exitCode);
    const Outcome folder = correct({"@" + in.path(), "--report=-"});
    EXPECT_EQ(1, folder.exitCode);
    EXPECT_NE(std::string::npos, folder.messages.find("the list can't be read")) << folder.messages;
    EXPECT_EQ(2, correct({image, "--lines=" + in.path(), "--report=-"}).exitCode);
    EXPECT_EQ(1, correct({image, "--maps=" + (in / "m.YML.GZ")}).exitCode);
    const Outcome model = correct({image, "--carry", "--model=none", "--report=-"});
    EXPECT_EQ(2, model.exitCode);
    EXPECT_NE(std::string::npos, model.messages.find("exclude each other")) << model.messages;
}

// The order of the frames of a drive, which a sequence, the column frame of a log and shards go by.
TEST(CorrectInputs, names_of_a_folder_count_as_numbers)
{
    Names inOrder;
    for (const char* name : {"000", "01", "1", "02", "f", "f2", "f2_b10", "f2a", "f10", "f10_b9", "f10_b10", "f010_b11",
                             "f99999999999999999998", "f99999999999999999999", "f100000000000000000000"})
        inOrder.push_back(name + std::string(".png"));
    const TemporaryFolder in, out;
    for (const std::string& name : inOrder)
        cv::imwrite(in / name, cv::Mat(48, 64, CV_8U, cv::Scalar(7)));
    EXPECT_EQ(0, correct({in.path(), "--report=" + (out / "report.jsonl")}).exitCode);
    EXPECT_EQ(inOrder, inputsOf(out / "report.jsonl"));
}

TEST(CorrectInputs, lists_and_patterns)
{
    const TemporaryFolder in, out;
    putImages(in, {"frame_9.png", "frame_10.png", "frame_x.png", "shot_0007.png", "shot_12.png"});
    const std::string report = out / "report.jsonl";
    EXPECT_EQ(0, correct({in / "frame_%d.png", "--report=" + report, "--overwrite"}).exitCode);
    EXPECT_EQ((Names{"frame_9.png", "frame_10.png"}), inputsOf(report));
    putImages(in, {"f_1.png", "f_01.png", "f_2.png"});
    EXPECT_EQ(0, correct({in / "f_%d.png", "--report=" + report, "--overwrite"}).exitCode);
    EXPECT_EQ((Names{"f_01.png", "f_1.png", "f_2.png"}), inputsOf(report));
    EXPECT_EQ(0, correct({in / "shot_%04d.png", "--report=" + report, "--overwrite"}).exitCode);
    EXPECT_EQ(Names{"shot_0007.png"}, inputsOf(report));
    EXPECT_EQ(1, correct({in / "none_%d.png", "--report=" + report, "--overwrite"}).exitCode);

    writeContent(in / "list.txt", (in / "shot_12.png") + "\r\n\n" + (in / "frame_x.png") + "\n");
    EXPECT_EQ(0, correct({"@" + (in / "list.txt"), "--report=" + report, "--overwrite"}).exitCode);
    EXPECT_EQ((Names{"shot_12.png", "frame_x.png"}), inputsOf(report));
    EXPECT_EQ(1, correct({"@" + (in / "missing.txt"), "--report=" + report, "--overwrite"}).exitCode);
}

}} // namespace
