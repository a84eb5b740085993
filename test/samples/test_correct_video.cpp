// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"

#include "opencv2/imgproc.hpp"
#include "opencv2/videoio.hpp"

#include <sstream>

namespace opencv_test { namespace {

typedef nlohmann::ordered_json Json;

const int FRAMES = 4;
const double FRAMES_PER_SECOND = 12;

// A short drive: frames with and without motion, in an order that can be recognised.
void writeVideo(const std::string& path)
{
    cv::VideoWriter writer(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), FRAMES_PER_SECOND, streetImage().size());
    ASSERT_TRUE(writer.isOpened()) << path;
    for (int i = 0; i < FRAMES; i++)
    {
        cv::Mat frame = i % 2 ? cv::Mat(streetImage().size(), CV_8UC3, cv::Scalar::all(90)) : streetImage();
        cv::rectangle(frame, cv::Rect(0, 340, 40 * (i + 1), 40), cv::Scalar(0, 0, 255), cv::FILLED);
        writer.write(frame);
    }
}

std::vector<cv::Mat> framesOf(const std::string& path)
{
    std::vector<cv::Mat> frames;
    cv::VideoCapture capture(path);
    for (cv::Mat frame; capture.read(frame);)
        frames.push_back(frame.clone());
    return frames;
}

class CorrectVideo : public testing::Test
{
protected:
    CorrectVideo() : video_(in_ / "drive.avi") { writeVideo(video_); }

    Arguments arguments() const { return {video_, "--camera=" + streetFolder() + "/camera.yml", "--wall=2.5"}; }

    TemporaryFolder in_, out_;
    std::string video_;
};

TEST_F(CorrectVideo, each_frame_is_corrected_as_an_image)
{
    ASSERT_EQ(0,
              correct(arguments() + Arguments{"--output=" + (out_ / "out.avi"), "--overlay=" + (out_ / "overlay.avi"),
                                              "--report=" + (out_ / "report.jsonl")})
                  .exitCode);
    EXPECT_EQ((std::vector<std::string>{"out.avi", "overlay.avi", "report.jsonl"}), namesIn(out_.path()));
    const std::vector<cv::Mat> before = framesOf(video_), after = framesOf(out_ / "out.avi"),
                               overlay = framesOf(out_ / "overlay.avi");
    const std::vector<std::string> lines = linesOf(out_ / "report.jsonl");
    ASSERT_EQ(size_t(FRAMES), before.size());
    ASSERT_EQ(size_t(FRAMES), after.size());
    ASSERT_EQ(size_t(FRAMES), overlay.size());
    ASSERT_EQ(size_t(FRAMES), lines.size());
    EXPECT_EQ(FRAMES_PER_SECOND, cv::VideoCapture(out_ / "out.avi").get(cv::CAP_PROP_FPS));
    for (int i = 0; i < FRAMES; i++)
    {
        cv::imwrite(out_ / "frame.png", before[i]);
        const Outcome alone = correct({out_ / "frame.png", arguments()[1], arguments()[2],
                                       "--output=" + (out_ / "alone.png"), "--report=-", "--overwrite"});
        ASSERT_EQ(0, alone.exitCode);
        const Json expected = Json::parse(alone.output), got = Json::parse(lines[i]);
        EXPECT_EQ(video_, got["input"]);
        EXPECT_EQ(i, got["frame"]);
        EXPECT_EQ(i % 2 ? "too_few_segments" : "ok", got["status"]);
        for (const char* key :
             {"status", "alpha", "beta", "delta", "wall_ratio", "segments", "inliers", "mean_shift_px"})
            EXPECT_EQ(expected[key], got[key]) << key;
        // The codec loses some grey levels.
        const cv::Mat image = cv::imread(out_ / "alone.png");
        EXPECT_LT(cv::norm(image, after[i], cv::NORM_L1) / (3. * image.total()), 3);
        if (i % 2 == 0)
        {
            EXPECT_GT(cv::norm(before[i], after[i], cv::NORM_L1), 2 * cv::norm(image, after[i], cv::NORM_L1));
        }
    }
}

// Cameras have endings of their own for usual containers; a result in one that can't be written has another name.
TEST_F(CorrectVideo, endings_of_cameras)
{
    const std::string stream = in_ / "drive.ts";
    {
        cv::VideoWriter writer(stream, cv::VideoWriter::fourcc('P', 'I', 'M', '1'), 25, streetImage().size());
        ASSERT_TRUE(writer.isOpened());
        for (int i = 0; i < FRAMES; i++)
            writer.write(streetImage());
    }
    const std::string insv = in_ / "drive.insv", mov = in_ / "drive.MOV";
    {
        cv::VideoWriter writer(mov, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), 25, streetImage().size());
        ASSERT_TRUE(writer.isOpened());
        for (int i = 0; i < FRAMES; i++)
            writer.write(streetImage());
    }
    writeContent(insv, contentOf(mov));
    for (const std::string& input : {stream, insv})
    {
        const Outcome outcome = correct({input, arguments()[1], arguments()[2], "--report=-", "--overwrite",
                                         "--output=" + (out_ / (input == stream ? "out.ts" : "out.avi"))});
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_EQ(FRAMES, std::count(outcome.output.begin(), outcome.output.end(), '\n')) << outcome.output;
    }
    EXPECT_EQ(size_t(FRAMES), framesOf(out_ / "out.ts").size());
    const Outcome unwritable = correct({insv, arguments()[1], arguments()[2], "--output=" + (out_ / "out.insv")});
    EXPECT_EQ(1, unwritable.exitCode);
    EXPECT_NE(std::string::npos, unwritable.messages.find("video that can be written")) << unwritable.messages;
}

// A drive whose picture grows as that of a street, so that each frame follows from the one before.
cv::Mat approachingFrame(int i)
{
    const cv::Mat street = streetImage();
    cv::Mat frame;
    const double larger = 1 + 0.03 * i, kept = (1 - larger) / 2;
    cv::warpAffine(street, frame, cv::Matx23d(larger, 0, kept * street.cols, 0, larger, kept * street.rows),
                   street.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
    return frame;
}

void writeApproach(const std::string& path, int frames)
{
    cv::VideoWriter writer(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), FRAMES_PER_SECOND, streetImage().size());
    for (int i = 0; i < frames; i++)
        writer.write(approachingFrame(i));
}

TEST_F(CorrectVideo, motion_is_carried_where_asked_for)
{
    const int frames = 4;
    const std::string approach = in_ / "approach.avi";
    writeApproach(approach, frames);
    std::vector<double> sigma[3];
    const char* const ways[] = {"", "--carry", "--smooth"};
    for (int k = 0; k < 3; k++)
    {
        const std::string report = out_ / cv::format("%d.jsonl", k);
        Arguments all = {approach, "--camera=" + streetFolder() + "/camera.yml", "--wall=2.5", "--report=" + report};
        if (k > 0)
            all.push_back(ways[k]);
        ASSERT_EQ(0, correct(all).exitCode);
        const std::vector<std::string> lines = linesOf(report);
        ASSERT_EQ(size_t(frames), lines.size());
        for (const std::string& line : lines)
        {
            const Json json = Json::parse(line);
            sigma[k].push_back(json["yaw_rate_sigma"].is_null() ? 0 : json["yaw_rate_sigma"].get<double>());
        }
    }
    // An image alone knows the yaw rate as well as gravity; two of them, by what moves between them.
    for (int i = 0; i < frames; i++)
    {
        EXPECT_GT(sigma[1][i], 0) << i;
        EXPECT_LT(sigma[1][i], 0.3 * sigma[0][i]) << i;
    }
    // The frames in the middle have one on either side.
    for (int i = 1; i + 1 < frames; i++)
        EXPECT_LT(sigma[2][i], sigma[1][i]) << i;
}

// Images before and after a video are no frames of its sequence, be they as near.
TEST_F(CorrectVideo, motion_is_not_carried_between_images_and_videos)
{
    const int frames = 3;
    const std::string approach = in_ / "approach.avi", before = in_ / "before.png", after = in_ / "after.png";
    writeApproach(approach, frames);
    cv::imwrite(before, approachingFrame(0));
    cv::imwrite(after, approachingFrame(frames));
    const auto motionsOf = [](const Arguments& inputs, const char* way) {
        const Outcome outcome =
            correct(inputs + Arguments{"--camera=" + streetFolder() + "/camera.yml", "--wall=2.5", way, "--report=-"});
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        std::vector<std::string> motions;
        std::istringstream stream(outcome.output);
        for (std::string line; std::getline(stream, line);)
        {
            const Json json = Json::parse(line);
            motions.push_back(Json({json["alpha"], json["yaw_rate_sigma"], json["expected_px_left"]}).dump());
        }
        return motions;
    };
    for (const char* way : {"--carry", "--smooth"})
    {
        std::vector<std::string> apart;
        for (const std::string& input : {before, approach, after})
        {
            const std::vector<std::string> motions = motionsOf({input}, way);
            apart.insert(apart.end(), motions.begin(), motions.end());
        }
        EXPECT_EQ(apart, motionsOf({before, approach, after}, way)) << way;
    }
}

TEST_F(CorrectVideo, images_and_videos_to_a_folder)
{
    cv::imwrite(in_ / "image.png", streetImage());
    EXPECT_EQ(
        0, correct({video_, in_ / "image.png", "--output=" + (out_ / "results"), "--report=" + (out_ / "report.jsonl")})
               .exitCode);
    EXPECT_EQ((std::vector<std::string>{"drive.avi", "image.png"}), namesIn(out_ / "results"));
    EXPECT_EQ(size_t(FRAMES), framesOf(out_ / "results/drive.avi").size());
    EXPECT_EQ(size_t(FRAMES + 1), linesOf(out_ / "report.jsonl").size());
}

// A video has a clock of its own: it begins another sequence, and so does what comes after it.
TEST_F(CorrectVideo, clocks_of_images_and_videos)
{
    cv::imwrite(in_ / "image.png", streetImage());
    writeContent(in_ / "log.csv", "file,time_s\nimage.png,50\n");
    for (const Arguments& inputs : {Arguments{video_, in_ / "image.png"}, Arguments{in_ / "image.png", video_}})
    {
        const Outcome outcome = correct(inputs + Arguments{"--camera=" + streetFolder() + "/camera.yml", "--carry",
                                                           "--log=" + (in_ / "log.csv"), "--report=-"});
        EXPECT_EQ(0, outcome.exitCode);
        EXPECT_EQ("", outcome.messages);
    }
}

TEST_F(CorrectVideo, read_out_longer_than_the_time_between_frames)
{
    const auto messagesOf = [&](const std::string& readOut) {
        return correct({video_, "--focal=816", "--carry", "--report=-", "--readout=" + readOut}).messages;
    };
    EXPECT_NE(std::string::npos,
              messagesOf("0.1").find(video_ + ": the read-out of 0.1 s is longer than the 0.0833 s between frames"))
        << messagesOf("0.1");
    EXPECT_EQ(std::string::npos, messagesOf("0.08").find("read-out")) << messagesOf("0.08");
}

// The frames that are there are corrected, and the exit code says that some are missing.
TEST_F(CorrectVideo, cut_short)
{
    cutShort(video_, in_ / "cut.avi", 0.4);
    const size_t left = framesOf(in_ / "cut.avi").size();
    ASSERT_LT(left, size_t(FRAMES - 1));
    ASSERT_GT(left, 0u);
    const Outcome outcome =
        correct({in_ / "cut.avi", "--output=" + (out_ / "out.avi"), "--report=" + (out_ / "report.jsonl")});
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("cut short")) << outcome.messages;
    EXPECT_EQ(left, framesOf(out_ / "out.avi").size());
    const std::vector<std::string> lines = linesOf(out_ / "report.jsonl");
    ASSERT_EQ(left + 1, lines.size());
    EXPECT_EQ(left, Json::parse(lines[0])["frames"].get<size_t>());
    EXPECT_EQ("failed", Json::parse(lines[left])["status"]);
}

TEST_F(CorrectVideo, files_that_are_no_videos)
{
    writeContent(in_ / "empty.mp4", "");
    writeContent(in_ / "text.avi", "This is no video.\n");
    for (const char* name : {"empty.mp4", "text.avi", "missing.mkv"})
    {
        const Outcome outcome = correct({in_ / name, "--output=" + (out_ / "out.avi")});
        EXPECT_EQ(1, outcome.exitCode) << name;
        EXPECT_NE(std::string::npos, outcome.messages.find(name)) << outcome.messages;
        EXPECT_TRUE(namesIn(out_.path()).empty()) << name;
    }
}

TEST_F(CorrectVideo, results_that_cannot_be_written)
{
    for (const char* name : {"out.png", "out", "out.txt"})
    {
        EXPECT_EQ(1, correct({video_, "--output=" + (out_ / name)}).exitCode) << name;
        EXPECT_TRUE(namesIn(out_.path()).empty()) << name;
    }
    const std::string before = contentOf(video_);
    EXPECT_EQ(2, correct({video_, "--output=" + video_, "--overwrite"}).exitCode);
    EXPECT_EQ(before, contentOf(video_));
    EXPECT_EQ(std::vector<std::string>{"drive.avi"}, namesIn(in_.path()));
}

TEST_F(CorrectVideo, existing_results)
{
    writeContent(out_ / "out.avi", "precious");
    EXPECT_EQ(1, correct({video_, "--output=" + (out_ / "out.avi")}).exitCode);
    EXPECT_EQ(0, correct({video_, "--output=" + (out_ / "out.avi"), "--skip_existing"}).exitCode);
    EXPECT_EQ("precious", contentOf(out_ / "out.avi"));
    EXPECT_EQ(0, correct({video_, "--output=" + (out_ / "out.avi"), "--overwrite"}).exitCode);
    EXPECT_EQ(size_t(FRAMES), framesOf(out_ / "out.avi").size());
}

TEST_F(CorrectVideo, missing_maps_are_made)
{
    const Arguments all = arguments() + Arguments{"--output=" + (out_ / "out.avi"), "--maps=" + (out_ / "maps")};
    cv::utils::fs::createDirectories(out_ / "maps/drive"); // what has the name of the video isn't in the way
    ASSERT_EQ(0, correct(arguments() + Arguments{"--output=" + (out_ / "out.avi")}).exitCode);
    const std::string video = contentOf(out_ / "out.avi");
    const std::vector<std::string> complete = {"drive", "drive_000000.yml.gz", "drive_000001.yml.gz",
                                               "drive_000002.yml.gz", "drive_000003.yml.gz"};
    for (const char* missing : {"drive_000000.yml.gz", "drive_000002.yml.gz", "drive_000003.yml.gz"})
    {
        std::remove((out_ / "maps/" + missing).c_str());
        const Outcome outcome = correct(all + Arguments{"--skip_existing"});
        ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_EQ(complete, namesIn(out_ / "maps"));
        EXPECT_EQ(video, contentOf(out_ / "out.avi"));
    }
}

TEST_F(CorrectVideo, maps_of_each_frame)
{
    EXPECT_EQ(2, correct(arguments() + Arguments{"--maps=" + (out_ / "maps.yml.gz")}).exitCode);
    ASSERT_EQ(0, correct(arguments() + Arguments{"--maps=" + (out_ / "maps")}).exitCode);
    EXPECT_EQ((std::vector<std::string>{"drive_000000.yml.gz", "drive_000001.yml.gz", "drive_000002.yml.gz",
                                        "drive_000003.yml.gz"}),
              namesIn(out_ / "maps"));
    const std::vector<cv::Mat> frames = framesOf(video_);
    cv::imwrite(out_ / "frame.png", frames[2]);
    ASSERT_EQ(
        0, correct({out_ / "frame.png", arguments()[1], arguments()[2], "--maps=" + (out_ / "frame.yml.gz")}).exitCode);
    cv::Mat expected, got;
    cv::FileStorage(out_ / "frame.yml.gz", cv::FileStorage::READ)["map1"] >> expected;
    cv::FileStorage(out_ / "maps/drive_000002.yml.gz", cv::FileStorage::READ)["map1"] >> got;
    ASSERT_EQ(CV_32FC1, got.type());
    EXPECT_EQ(0, cv::norm(expected, got, cv::NORM_INF));
}

TEST_F(CorrectVideo, depth_of_each_frame)
{
    cv::utils::fs::createDirectories(in_ / "depth");
    const auto depthOf = [this](int frame) { return in_ / cv::format("depth/drive_%06d.png", frame); };
    for (int i = 0; i < FRAMES; i++)
    {
        cv::Mat depth = cv::Mat::zeros(streetImage().size(), CV_16U);
        depth(cv::Rect(310, 320, 20, 40)) = 4000 + 1000 * i; // of the road, where no vertical is
        cv::imwrite(depthOf(i), depth);
    }
    const Arguments all = arguments() + Arguments{"--speed=60", "--depth=" + (in_ / "depth")};
    const Outcome outcome = correct(all + Arguments{"--maps=" + (out_ / "maps"), "--report=-"});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const std::vector<cv::Mat> frames = framesOf(video_);
    for (int i = 0; i < FRAMES; i += 2) // the others show nothing
    {
        cv::imwrite(out_ / "frame.png", frames[i]);
        const Outcome alone = correct({out_ / "frame.png", all[1], all[2], all[3], "--depth=" + depthOf(i),
                                       "--maps=" + (out_ / "alone.yml.gz"), "--report=-", "--overwrite"});
        EXPECT_NE(std::string::npos, alone.output.find("\"depth_used\":true"));
        EXPECT_EQ(contentOf(out_ / "alone.yml.gz"), contentOf(out_ / cv::format("maps/drive_%06d.yml.gz", i)));
    }

    const std::string content = contentOf(depthOf(1));
    EXPECT_EQ(2, correct(all + Arguments{"--report=" + depthOf(1), "--overwrite"}).exitCode);
    EXPECT_EQ(content, contentOf(depthOf(1)));
    EXPECT_EQ(2, correct(arguments() + Arguments{"--depth=" + depthOf(1), "--report=-"}).exitCode);
}

// As an image of a folder that has no depth; in the video the lens of such a frame is undone.
TEST_F(CorrectVideo, frames_whose_depth_is_missing_or_damaged)
{
    cv::utils::fs::createDirectories(in_ / "depth");
    const auto depthOf = [this](int frame) { return in_ / cv::format("depth/drive_%06d.png", frame); };
    for (int i = 0; i < FRAMES; i++)
        cv::imwrite(depthOf(i), cv::Mat(streetImage().size(), CV_16U, cv::Scalar(4000 + 1000 * i)));
    for (const bool carry : {false, true})
    {
        SCOPED_TRACE(carry);
        const TemporaryFolder out;
        const std::string report = out / "report.jsonl";
        const Arguments all = arguments() + Arguments{"--speed=60", "--depth=" + (in_ / "depth")} +
                              (carry ? Arguments{"--carry"} : Arguments());
        const auto results = [&](const char* name) {
            return Arguments{"--output=" + (out / (name + std::string(".avi"))), "--maps=" + (out / name)};
        };
        cv::imwrite(depthOf(1), cv::Mat(streetImage().size(), CV_16U, cv::Scalar(5000)));
        cv::imwrite(depthOf(3), cv::Mat(streetImage().size(), CV_16U, cv::Scalar(7000)));
        ASSERT_EQ(0, correct(all + results("sound")).exitCode);
        writeContent(depthOf(1), contentOf(depthOf(1)).substr(0, 40));
        std::remove(depthOf(3).c_str());
        const Outcome outcome = correct(all + results("lacking") + Arguments{"--report=" + report});
        EXPECT_EQ(1, outcome.exitCode);
        std::vector<std::string> maps;
        for (int i = 0; i < FRAMES; i++)
        {
            const Json line = Json::parse(linesOf(report).at(size_t(i)));
            EXPECT_EQ(i, line["frame"]);
            EXPECT_EQ(FRAMES, line["frames"]);
            const bool isLacking = i == 1 || i == 3;
            EXPECT_EQ(isLacking, line["status"] == "failed") << line;
            if (!isLacking)
                maps.push_back(cv::format("drive_%06d.yml.gz", i));
            else
            {
                EXPECT_NE(std::string::npos, line["error"].get<std::string>().find(depthOf(i))) << line;
                EXPECT_NE(std::string::npos, outcome.messages.find(cv::format("drive.avi: frame %d: ", i) + depthOf(i)))
                    << outcome.messages;
            }
        }
        EXPECT_EQ(size_t(FRAMES), linesOf(report).size());
        EXPECT_EQ(maps, namesIn(out / "lacking"));
        EXPECT_EQ(contentOf(out / "sound/drive_000000.yml.gz"), contentOf(out / "lacking/drive_000000.yml.gz"));
        EXPECT_EQ(size_t(FRAMES), framesOf(out / "lacking.avi").size());
        // It is incomplete, as an image without its result is.
        EXPECT_EQ(1, correct(all + results("lacking") + Arguments{"--report=" + report, "--skip_existing"}).exitCode);
        EXPECT_EQ(size_t(FRAMES), linesOf(report).size());
    }
    for (int i = 0; i < FRAMES; i++)
        std::remove(depthOf(i).c_str());
    cv::imwrite(in_ / "depth/other.png", cv::Mat(streetImage().size(), CV_16U, cv::Scalar(5000)));
    const Outcome none = correct(arguments() + Arguments{"--speed=60", "--depth=" + (in_ / "depth"),
                                                         "--output=" + (out_ / "none.avi"), "--report=-"});
    EXPECT_EQ(1, none.exitCode);
    EXPECT_NE(std::string::npos, none.messages.find("no frame of the video can be corrected")) << none.messages;
    EXPECT_FALSE(cv::utils::fs::exists(out_ / "none.avi"));
    EXPECT_EQ("failed", Json::parse(none.output)["status"]);
}

TEST_F(CorrectVideo, log_by_frame_and_by_time)
{
    const Arguments plain = arguments() + Arguments{"--report=-"};
    const auto framesOfReport = [](const Outcome& outcome) {
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        std::vector<Json> frames;
        std::istringstream stream(outcome.output);
        for (std::string line; std::getline(stream, line);)
            frames.push_back(Json::parse(line));
        EXPECT_EQ(size_t(FRAMES), frames.size());
        frames.resize(FRAMES);
        return frames;
    };
    const std::vector<Json> given = framesOfReport(correct(plain + Arguments{"--speed=66"})),
                            unknown = framesOfReport(correct(plain));
    const auto withLog = [&](const std::string& content) {
        writeContent(in_ / "log.csv", content);
        return framesOfReport(correct(plain + Arguments{"--log=" + (in_ / "log.csv")}));
    };
    ASSERT_NE(given[2]["alpha"], unknown[2]["alpha"]);
    const std::vector<Json> byNumber = withLog("frame,speed_kmh\n2,66\n"),
                            byFile = withLog("file,frame,speed_kmh\ndrive.avi,2,66\nother.avi,0,66\n");
    EXPECT_EQ(unknown[0]["alpha"], byNumber[0]["alpha"]);
    EXPECT_EQ(given[2]["alpha"], byNumber[2]["alpha"]);
    EXPECT_EQ(unknown[0]["alpha"], byFile[0]["alpha"]);
    EXPECT_EQ(given[2]["alpha"], byFile[2]["alpha"]);
    // Frame 2 of 12 frames per second is at 1/6 s.
    const std::vector<Json> byTime = withLog("time_s,speed_kmh\n0.1,58\n0.2,70\n");
    EXPECT_EQ(unknown[0]["alpha"], byTime[0]["alpha"]);
    EXPECT_NEAR(given[2]["alpha"].get<double>(), byTime[2]["alpha"].get<double>(),
                1e-4 * std::abs(given[2]["alpha"].get<double>()));
    const std::vector<Json> byTimeOfRow = withLog("frame,time_s,speed_kmh\n2,10,\n,9,50\n,11,82\n");
    EXPECT_EQ(given[2]["alpha"], byTimeOfRow[2]["alpha"]);
}

TEST_F(CorrectVideo, log_of_no_frame)
{
    const char *rows = "the log has no effect: its rows name none of the frames",
               *samples = "the samples of the log have no effect: all frames are outside of their times, ";
    const std::pair<const char*, const char*> logs[] = {
        {"frame,speed_kmh\n3,66\n", ""},
        {"frame,speed_kmh\n4,66\n", rows},
        {"file,frame,speed_kmh\nother.avi,0,66\n", rows},
        {"time_s,speed_kmh\n0.2,66\n0.3,66\n", ""},
        {"time_s,speed_kmh\n0.3,66\n1,66\n", samples},
        {"file,time_s,speed_kmh\nother.avi,0,66\nother.avi,1,66\n", samples}};
    for (const std::pair<const char*, const char*>& log : logs)
    {
        writeContent(in_ / "log.csv", log.first);
        const Outcome outcome = correct(arguments() + Arguments{"--report=-", "--log=" + (in_ / "log.csv")});
        EXPECT_EQ(0, outcome.exitCode);
        EXPECT_NE(std::string::npos, outcome.messages.find(log.second)) << log.first << outcome.messages;
        EXPECT_EQ(!*log.second, outcome.messages.empty()) << log.first << outcome.messages;
    }
}

TEST_F(CorrectVideo, number_of_a_frame_of_two_videos)
{
    const std::string other = in_ / "other.avi";
    writeVideo(other);
    const std::pair<const char*, int> logs[] = {{"frame,speed_kmh\n2,66\n", 2},
                                                {"file,frame,speed_kmh\nother.avi,1,60\n,2,66\n", 2},
                                                {"file,frame,speed_kmh\nother.avi,2,66\n", 0}};
    for (const std::pair<const char*, int>& log : logs)
    {
        writeContent(in_ / "log.csv", log.first);
        const Outcome outcome = correct({video_, other, "--report=-", "--log=" + (in_ / "log.csv")});
        EXPECT_EQ(log.second, outcome.exitCode) << log.first << outcome.messages;
        EXPECT_EQ(log.second == 2,
                  outcome.messages.find("the log's column frame needs the column file") != std::string::npos)
            << outcome.messages;
    }
}

TEST_F(CorrectVideo, pixels_that_are_not_square)
{
    const std::pair<const char*, const char*> shapes[] = {
        {"4/3", "1.333 times as wide as high"}, {"1", ""}, {"8/9", "0.8889 times as wide as high"}};
    for (const auto& shape : shapes)
    {
        const Outcome made = runCommand("ffmpeg -nostdin -v error -y -i '" + video_ +
                                        "' -c:v mpeg4 -vf setsar=" + shape.first + " '" + (in_ / "shape.mp4") + "'");
        ASSERT_EQ(0, made.exitCode) << made.messages << " (is ffmpeg installed?)";
        const Arguments one = {in_ / "shape.mp4", "--overwrite"}, results = {"--output=" + out_.path()};
        const Outcome outcome = correct(one + results);
        EXPECT_EQ(0, outcome.exitCode);
        EXPECT_EQ(*shape.second != 0, outcome.messages.find("pixels") != std::string::npos) << outcome.messages;
        EXPECT_NE(std::string::npos, outcome.messages.find(shape.second)) << outcome.messages;
        EXPECT_EQ(std::string::npos, correct(one + Arguments{"--report=-"}).messages.find("pixels"));
    }
}

TEST_F(CorrectVideo, lines_are_for_images)
{
    writeContent(in_ / "lines.txt", "1 2 3 4\n");
    EXPECT_EQ(2, correct({video_, "--report=-", "--lines=" + (in_ / "lines.txt")}).exitCode);
    EXPECT_TRUE(namesIn(out_.path()).empty());
}

}} // namespace
