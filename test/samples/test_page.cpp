// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// The data and pictures of the page that rsackermann_page writes; test/check_page.py looks at it in a browser.

#include "program.hpp"

#ifdef RSACKERMANN_WITH_VIDEOIO
#include "opencv2/videoio.hpp"
#endif

namespace opencv_test { namespace {

using nlohmann::json;

const char* const BEGIN = "<script type=\"application/json\" id=\"drive\">";

// Three images in a folder, of which the last one has failed, with names that HTML, JSON and addresses would misread.
class Page : public testing::Test
{
protected:
    Page()
    {
        for (const char* made : {"raw", "corrected", "overlay"})
            cv::utils::fs::createDirectories(folder / made);
        for (const char* name : {"a<script>\"&'.png", "ö #%?.png"})
        {
            cv::imwrite(folder / "raw/" + name, cv::Mat(60, 80, CV_16UC1, cv::Scalar(40 * 257)));
            cv::imwrite(folder / "corrected/" + name, cv::Mat(60, 80, CV_8UC4, cv::Scalar(250, 0, 0, 9)));
            cv::imwrite(folder / "overlay/" + name, cv::Mat(60, 80, CV_8UC3, cv::Scalar(0, 250, 0)));
            lines.push_back({{"input", folder / "raw/" + name},
                             {"status", "ok"},
                             {"yaw_rate_deg_s", 12.5},
                             {"speed_km_h", nullptr},
                             {"relief", {{"columns", 4}}},
                             {"rotation_curve", {{0, 0, 0}, {0, 0, 0}}}});
        }
        lines.push_back(
            {{"input", folder / "raw/damaged.png"}, {"status", "failed"}, {"error", "it's </script> short"}});
    }

    Outcome make(const Arguments& options) const { return make(options, folder / "page.html"); }

    Outcome make(const Arguments& options, const std::string& output) const
    {
        std::string report;
        for (const json& line : lines)
            report += line.dump() + "\n";
        writeContent(folder / "report.jsonl", report);
        return runProgram(PAGE_PROGRAM,
                          Arguments{"--report=" + (folder / "report.jsonl"), "--output=" + output} + options);
    }

    Arguments results() const { return {"--corrected=" + (folder / "corrected"), "--overlay=" + (folder / "overlay")}; }

    json data() const
    {
        const std::string page = contentOf(folder / "page.html");
        const size_t begin = page.find(BEGIN), end = page.find("</script>", begin);
        if (begin == std::string::npos || end == std::string::npos)
            return json();
        return json::parse(page.substr(begin + std::strlen(BEGIN), end - begin - std::strlen(BEGIN)));
    }

    const TemporaryFolder folder;
    std::vector<json> lines;
};

std::string decoded(const std::string& base64)
{
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : base64.substr(0, base64.find('=')))
    {
        bits = bits << 6 | unsigned(digits.find(c));
        if ((count += 6) >= 8)
            bytes += char(bits >> (count -= 8) & 255);
    }
    return bytes;
}

cv::Mat embedded(const json& address)
{
    const std::string text = address, begin = "data:image/jpeg;base64,";
    EXPECT_EQ(0u, text.find(begin));
    EXPECT_EQ(0u, (text.size() - begin.size()) % 4);
    const std::string bytes = decoded(text.substr(begin.size()));
    return cv::imdecode(std::vector<uchar>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
}

void expectColour(const cv::Scalar& expected, const cv::Mat& picture, const cv::Size& size = cv::Size(80, 60))
{
    ASSERT_EQ(size, picture.size());
    EXPECT_LT(cv::norm(cv::mean(picture) - expected), 5) << cv::mean(picture);
}

TEST_F(Page, holds_lines_and_pictures)
{
    const Outcome outcome = make(results());
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    EXPECT_EQ("", outcome.messages);
    EXPECT_EQ((Arguments{"corrected", "overlay", "page.html", "raw", "report.jsonl"}), namesIn(folder.path()));
    const json page = data();
    EXPECT_EQ(folder / "report.jsonl", page["report"]);
    ASSERT_EQ(3u, page["frames"].size());
    for (size_t i = 0; i < 2; i++)
    {
        const json& frame = page["frames"][i];
        EXPECT_EQ(lines[i]["input"], frame["input"]);
        EXPECT_EQ(12.5, frame["yaw_rate_deg_s"]);
        EXPECT_TRUE(frame["speed_km_h"].is_null());
        EXPECT_FALSE(frame.contains("relief"));
        EXPECT_FALSE(frame.contains("rotation_curve"));
        expectColour(cv::Scalar(40, 40, 40), embedded(frame["raw"]));
        expectColour(cv::Scalar(250, 0, 0), embedded(frame["corrected"]));
        expectColour(cv::Scalar(0, 250, 0), embedded(frame["overlay"]));
    }
    EXPECT_EQ(lines[2], page["frames"][2]);
    // Nothing is loaded from elsewhere.
    const std::string text = contentOf(folder / "page.html");
    for (const char* other : {"http", "src=\"", "href", "@import", "url(\""})
        EXPECT_EQ(std::string::npos, text.find(other)) << other;
}

TEST_F(Page, pictures_of_many_frames_are_beside_it)
{
    const Outcome outcome = make(results() + Arguments{"--embed=2", "--width=40"});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const json page = data();
    EXPECT_EQ("page_files", page["folder"]);
    EXPECT_EQ((Arguments{"000000_corrected.jpg", "000000_overlay.jpg", "000000_raw.jpg", "000001_corrected.jpg",
                         "000001_overlay.jpg", "000001_raw.jpg"}),
              namesIn(folder / "page_files"));
    EXPECT_EQ("000001_corrected.jpg", page["frames"][1]["corrected"]);
    expectColour(cv::Scalar(250, 0, 0), cv::imread(folder / "page_files/000001_corrected.jpg"), cv::Size(40, 30));
}

TEST_F(Page, pictures_of_an_older_page_are_removed)
{
    const std::string others = folder / "page_files/";
    ASSERT_EQ(0, make(results() + Arguments{"--embed=0"}).exitCode);
    const Arguments mine = {"0000001_raw.jpg", "000001_raw.jpeg", "000001_raw.png",
                            "000002_mine.jpg", "00000_raw.jpg",   "mine.jpg"};
    for (const std::string& name : mine)
        writeContent(others + name, "mine");
    writeContent(others + "1234567_raw.jpg", "of a longer drive");
    lines.erase(lines.begin() + 1, lines.end());
    ASSERT_EQ(0, make({"--embed=0", "--overwrite"}).exitCode);
    Arguments left = mine + Arguments{"000000_raw.jpg"};
    std::sort(left.begin(), left.end());
    EXPECT_EQ(left, namesIn(others));
    // They are in the page.
    ASSERT_EQ(0, make({"--embed=1", "--overwrite"}).exitCode);
    EXPECT_EQ(mine, namesIn(others));
    // One that is read.
    lines[0]["input"] = others + "000005_raw.jpg";
    cv::imwrite(others + "000005_raw.jpg", cv::Mat(60, 80, CV_8U, cv::Scalar(40)));
    const Outcome outcome = make({"--embed=1", "--overwrite"});
    EXPECT_EQ(2, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("would replace the input")) << outcome.messages;
    EXPECT_TRUE(cv::utils::fs::exists(others + "000005_raw.jpg"));
}

TEST_F(Page, what_exists_stays)
{
    writeContent(folder / "page.html", "mine");
    Outcome outcome = make(results());
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("page.html exists (--overwrite replaces it)"));
    EXPECT_EQ("mine", contentOf(folder / "page.html"));
    EXPECT_EQ(0, make(results() + Arguments{"--overwrite"}).exitCode);
    EXPECT_EQ(3u, data()["frames"].size());

    std::remove((folder / "page.html").c_str());
    cv::utils::fs::createDirectories(folder / "page_files");
    outcome = make({"--embed=0"});
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("page_files exists")) << outcome.messages;
    EXPECT_FALSE(cv::utils::fs::exists(folder / "page.html"));
}

TEST_F(Page, what_is_read_is_not_replaced)
{
    cv::utils::fs::createDirectories(folder / "page_files");
    cv::imwrite(folder / "page_files/000001_raw.jpg", cv::Mat(60, 80, CV_8U, cv::Scalar(7)));
    lines[0]["input"] = folder / "page_files/000001_raw.jpg";
    const std::string image = contentOf(folder / "page_files/000001_raw.jpg");
    for (const std::string& output : {folder / "page.html", lines[1]["input"].get<std::string>(),
                                      folder / "corrected/ö #%?.png", folder / "report.jsonl"})
    {
        const Outcome outcome = make(results() + Arguments{"--overwrite", "--embed=0"}, output);
        EXPECT_EQ(2, outcome.exitCode) << output;
        EXPECT_NE(std::string::npos, outcome.messages.find("would replace the input")) << outcome.messages;
    }
    EXPECT_EQ(image, contentOf(folder / "page_files/000001_raw.jpg"));
    EXPECT_FALSE(cv::utils::fs::exists(folder / "page.html"));
}

// The page is there with what could be read.
TEST_F(Page, missing_pictures_are_counted)
{
    cv::utils::fs::remove_all(folder / "overlay");
    std::remove((folder / "corrected/ö #%?.png").c_str());
    const Outcome outcome = make({"--corrected=" + (folder / "corrected"), "--overlay=" + (folder / "overlay/")});
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("there is no such file")) << outcome.messages;
    EXPECT_NE(std::string::npos, outcome.messages.find("3 pictures are missing")) << outcome.messages;
    EXPECT_TRUE(data()["frames"][0].contains("corrected"));
    EXPECT_FALSE(data()["frames"][1].contains("corrected"));
}

TEST_F(Page, refused)
{
    const std::pair<const char*, const char*> options[] = {{"--width=0", "--width"},
                                                           {"--embed=-1", "--embed"},
                                                           {"--corrected=", "--corrected"},
                                                           {"--corrected=report.jsonl", "isn't a folder"},
                                                           {"more.jsonl", "more.jsonl"}};
    for (const std::pair<const char*, const char*>& option : options)
    {
        const Outcome outcome = make({option.first});
        EXPECT_EQ(2, outcome.exitCode) << option.first;
        EXPECT_NE(std::string::npos, outcome.messages.find(option.second)) << outcome.messages;
    }
    EXPECT_EQ(2, runProgram(PAGE_PROGRAM, {"--report=" + (folder / "report.jsonl")}).exitCode);
    lines[1].erase("status");
    const Outcome damaged = make({});
    EXPECT_EQ(1, damaged.exitCode);
    EXPECT_NE(std::string::npos, damaged.messages.find("report.jsonl, line 2")) << damaged.messages;
    lines.clear();
    EXPECT_EQ(1, make({}).exitCode);
    EXPECT_FALSE(cv::utils::fs::exists(folder / "page.html"));
}

// A run that goes on, or another shard, may write a line again.
TEST_F(Page, last_line_of_a_frame_counts)
{
    lines.push_back(lines[0]);
    lines.back()["status"] = "not_significant";
    ASSERT_EQ(0, make({}).exitCode);
    ASSERT_EQ(3u, data()["frames"].size());
    EXPECT_EQ("not_significant", data()["frames"][0]["status"]);
}

// What rsackermann_correct has made of a single image, which goes to files.
TEST_F(Page, single_image)
{
    const std::string raw = streetFolder() + "/rolling.png", out = folder / "out.png", overlay = folder / "overlay.png";
    const Outcome corrected = correct({raw, "--camera=" + streetFolder() + "/camera.yml", "--output=" + out,
                                       "--overlay=" + overlay, "--report=" + (folder / "one.jsonl")});
    ASSERT_EQ(0, corrected.exitCode) << corrected.messages;
    const Outcome outcome = runProgram(PAGE_PROGRAM, {"--report=" + (folder / "one.jsonl"), "--corrected=" + out,
                                                      "--overlay=" + overlay, "--output=" + (folder / "page.html")});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const json frame = data()["frames"][0];
    EXPECT_LT(differenceInside(cv::imread(raw), embedded(frame["raw"])), 4);
    EXPECT_LT(differenceInside(cv::imread(out), embedded(frame["corrected"])), 4);
    EXPECT_GT(differenceInside(embedded(frame["raw"]), embedded(frame["corrected"])), 4);
    // Thin lines of strong colours lose more in a JPEG.
    EXPECT_LT(differenceInside(cv::imread(overlay), embedded(frame["overlay"])), 8);
}

#ifdef RSACKERMANN_WITH_VIDEOIO
// Frames of a video, of which a line is missing; the video has a line as well if it is cut short.
TEST_F(Page, videos)
{
    for (const char* kind : {"raw", "corrected"})
    {
        cv::VideoWriter video(folder / kind + "/drive.avi", cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10,
                              cv::Size(80, 60));
        for (int i = 0; i < 5; i++)
            video.write(cv::Mat(60, 80, CV_8UC3, cv::Scalar::all(50 * i + (kind[0] == 'r' ? 0 : 20))));
    }
    lines.clear();
    for (const int frame : {0, 1, 3, 4, 9})
        lines.push_back({{"input", folder / "raw/drive.avi"}, {"frame", frame}, {"status", "ok"}});
    lines.push_back({{"input", folder / "raw/drive.avi"}, {"status", "failed"}, {"error", "the video is cut short"}});
    const Outcome outcome = make({"--corrected=" + (folder / "corrected")});
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("frame 9 of the video can't be read")) << outcome.messages;
    EXPECT_NE(std::string::npos, outcome.messages.find("2 pictures are missing")) << outcome.messages;
    const json frames = data()["frames"];
    ASSERT_EQ(6u, frames.size());
    for (size_t i = 0; i < 4; i++)
    {
        const int value = 50 * lines[i]["frame"].get<int>();
        expectColour(cv::Scalar(value, value, value), embedded(frames[i]["raw"]));
        expectColour(cv::Scalar(value + 20, value + 20, value + 20), embedded(frames[i]["corrected"]));
    }
    EXPECT_FALSE(frames[4].contains("raw"));
    EXPECT_EQ(lines[5], frames[5]);
}
#endif

}} // namespace opencv_test::
