// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"

#include "opencv2/imgproc.hpp"

namespace opencv_test { namespace {

// Exif data with nothing but an orientation, in the byte order of Motorola.
std::string exifWithOrientation(int orientation)
{
    const char tiff[] = {'M', 'M', 0, 42, 0, 0, 0, 8, 0, 1, 1, 0x12, 0, 3, 0, 0, 0, 1, 0, char(orientation),
                         0,   0,   0, 0,  0, 0};
    return std::string(tiff, sizeof tiff);
}

// Puts the data behind the begin of a JPEG file.
void addExif(const std::string& path, const std::string& exif)
{
    std::string content = contentOf(path);
    const size_t length = 2 + 6 + exif.size();
    content.insert(2, std::string("\xFF\xE1") + char(length >> 8) + char(length & 255) + std::string("Exif\0\0", 6) +
                          exif);
    writeContent(path, content);
}

// As OpenCV shows it to those who don't ask for the sensor's rows.
cv::Size shownSize(const std::string& path)
{
    return cv::imread(path).size();
}

// Results of an image that is corrected and of one that stays as it is are turned alike, as the image is.
TEST(ImageKinds, orientation)
{
    const TemporaryFolder folder;
    cv::imwrite(folder / "street.jpg", streetImage());
    cv::imwrite(folder / "grey.jpg", cv::Mat(streetImage().size(), CV_8UC3, cv::Scalar::all(90)));
    const cv::Size upright = streetImage().size(), turned(upright.height, upright.width);
    for (const char* name : {"street.jpg", "grey.jpg"})
    {
        addExif(folder / name, exifWithOrientation(6));
        ASSERT_EQ(turned, shownSize(folder / name));
    }
    for (const char* format : {".jpg", ".png"})
        for (const char* name : {"street", "grey"})
        {
            const std::string output = folder / (std::string("o_") + name + format),
                              overlay = folder / (std::string("v_") + name + format);
            const Outcome outcome = correct(
                {folder / (std::string(name) + ".jpg"), "--output=" + output, "--overlay=" + overlay, "--report=-"});
            ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
            EXPECT_EQ(name == std::string("street"), nlohmann::json::parse(outcome.output)["status"] == "ok")
                << outcome.output;
            for (const std::string& path : {output, overlay})
            {
                EXPECT_NE(std::string::npos, contentOf(path).find(exifWithOrientation(6))) << path;
                EXPECT_EQ(upright, cv::imread(path, cv::IMREAD_UNCHANGED).size()) << path;
                if (format == std::string(".jpg"))
                {
                    EXPECT_EQ(turned, shownSize(path)) << path;
                }
            }
        }
    // From PNG, too.
    ASSERT_EQ(0, correct({folder / "o_street.png", "--output=" + (folder / "again.jpg")}).exitCode);
    EXPECT_EQ(turned, shownSize(folder / "again.jpg"));
}

std::string bigEndian(size_t value, int count)
{
    std::string bytes;
    for (int i = count - 1; i >= 0; i--)
        bytes += char(value >> 8 * i & 255);
    return bytes;
}

// A profile is what readers make of it, and is passed on as it is: of a JPEG file in two segments.
std::string profileSegments()
{
    std::string segments;
    for (const char number : {'\1', '\2'})
    {
        const std::string content = std::string("ICC_PROFILE\0", 12) + number + "\2" + "no real profile";
        segments += "\xFF\xE2" + bigEndian(content.size() + 2, 2) + content;
    }
    return segments;
}

std::string profileChunk()
{
    const std::string content = std::string("iCCPname\0\0", 10) + "no real profile";
    uint32_t checksum = 0xFFFFFFFF;
    for (const char c : content)
    {
        checksum ^= uchar(c);
        for (int i = 0; i < 8; i++)
            checksum = checksum >> 1 ^ (checksum & 1 ? 0xEDB88320 : 0);
    }
    return bigEndian(content.size() - 4, 4) + content + bigEndian(~checksum & 0xFFFFFFFF, 4);
}

TEST(ImageKinds, colour_profile)
{
    const TemporaryFolder folder;
    cv::Mat grey;
    cv::cvtColor(streetImage(), grey, cv::COLOR_BGR2GRAY);
    const struct
    {
        std::string input;
        cv::Mat image;
        std::string profile, output;
        bool isKept, isKeptInOverlay; //!< which has colours
    } cases[] = {{"a.jpg", streetImage(), profileSegments(), "b.jpg", true, true},
                 {"a.jpg", streetImage(), profileSegments(), "b.png", false, false},
                 {"a.jpg", grey, profileSegments(), "b.jpg", true, false},
                 {"a.jpg", cv::Mat(grey.size(), CV_8UC3, cv::Scalar::all(90)), profileSegments(), "b.jpg", true, true},
                 {"a.png", streetImage(), profileChunk(), "b.png", true, true},
                 {"a.png", streetImage(), profileChunk(), "b.jpg", false, false}};
    for (const auto& c : cases)
    {
        SCOPED_TRACE(c.input + " " + c.output + cv::format(" %d", c.image.channels()));
        cv::imwrite(folder / c.input, c.image);
        std::string content = contentOf(folder / c.input);
        content.insert(c.input == "a.jpg" ? 2 : 33, c.profile);
        writeContent(folder / c.input, content);
        const std::string overlay = folder / ("overlay_" + c.output);
        const Outcome outcome =
            correct({folder / c.input, "--output=" + (folder / c.output), "--overlay=" + overlay, "--overwrite"});
        ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_EQ(c.isKept, contentOf(folder / c.output).find(c.profile) != std::string::npos);
        EXPECT_EQ(c.isKeptInOverlay, contentOf(overlay).find(c.profile) != std::string::npos);
        EXPECT_EQ(c.image.size(), cv::imread(folder / c.output, cv::IMREAD_UNCHANGED).size());
    }
}

TEST(ImageKinds, one_bit)
{
    const TemporaryFolder folder;
    cv::Mat grey, binary;
    cv::cvtColor(streetImage(), grey, cv::COLOR_BGR2GRAY);
    cv::threshold(grey, binary, 110, 255, cv::THRESH_BINARY);
    cv::imwrite(folder / "in.png", binary, {cv::IMWRITE_PNG_BILEVEL, 1});
    cv::imwrite(folder / "in.pbm", binary);
    ASSERT_EQ(1, contentOf(folder / "in.png")[24]); // bits of a sample
    for (const char* name : {"in.png", "in.pbm"})
    {
        const Outcome outcome =
            correct({folder / name, "--report=-", "--output=" + (folder / "out.png"), "--overwrite"});
        ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_EQ("ok", nlohmann::json::parse(outcome.output)["status"]);
        EXPECT_EQ(CV_8UC1, cv::imread(folder / "out.png", cv::IMREAD_UNCHANGED).type());
    }
    // Between black and white there is grey, which the format doesn't have.
    const Outcome refused = correct({folder / "in.pbm", "--output=" + (folder / "out.pbm")});
    EXPECT_EQ(1, refused.exitCode);
    EXPECT_NE(std::string::npos, refused.messages.find(".pbm can't hold")) << refused.messages;
    EXPECT_FALSE(cv::utils::fs::exists(folder / "out.pbm"));
}

TEST(ImageKinds, float_is_refused)
{
    const TemporaryFolder folder;
    cv::Mat image;
    streetImage().convertTo(image, CV_32F, 1 / 255.);
    for (const char* name : {"in.tiff", "in.hdr"})
    {
        cv::imwrite(folder / name, image);
        const Outcome outcome = correct({folder / name, "--output=" + (folder / "out.tiff"), "--report=-"});
        EXPECT_EQ(1, outcome.exitCode);
        EXPECT_NE(std::string::npos, outcome.messages.find("CV_32FC3; only 8 and 16 bits")) << outcome.messages;
        EXPECT_EQ("failed", nlohmann::json::parse(outcome.output)["status"]);
        EXPECT_FALSE(cv::utils::fs::exists(folder / "out.tiff"));
    }
    cv::imwrite(folder / "in.png", streetImage());
    for (const char* name : {"out.hdr", "out.pic"})
    {
        EXPECT_EQ(1, correct({folder / "in.png", "--output=" + (folder / name)}).exitCode) << name;
        EXPECT_FALSE(cv::utils::fs::exists(folder / name)) << name;
    }
    // OpenCV itself doesn't read all of these.
    image.convertTo(image, CV_64F);
    cv::imwrite(folder / "in.tiff", image);
    EXPECT_EQ(1, correct({folder / "in.tiff", "--report=-"}).exitCode);
}

// By the programs, for the limit of cv::remap.
TEST(ImageKinds, very_long_is_refused)
{
    const TemporaryFolder folder;
    for (const cv::Size& size : {cv::Size(32767, 2), cv::Size(2, 32767), cv::Size(32766, 2)})
    {
        SCOPED_TRACE(size);
        cv::imwrite(folder / "in.png", cv::Mat(size, CV_8U, cv::Scalar(7)));
        const bool isTaken = size.width == 32766;
        for (const Outcome& outcome :
             {correct({folder / "in.png", "--output=" + (folder / "out.png"), "--overwrite"}),
              simulate({"--image=" + (folder / "in.png"), "--output=" + (folder / "out"), "--overwrite"})})
        {
            EXPECT_EQ(isTaken ? 0 : 1, outcome.exitCode) << outcome.messages;
            const std::string reason =
                folder / cv::format("in.png: the image has %d x %d pixels; up to 32766 along each side are supported",
                                    size.width, size.height);
            EXPECT_EQ(!isTaken, outcome.messages.find(reason) != std::string::npos) << outcome.messages;
        }
        EXPECT_EQ(isTaken, cv::utils::fs::exists(folder / "out.png"));
    }
}

TEST(ImageKinds, cmyk_is_refused)
{
    const TemporaryFolder folder;
    // The number of colours stands in the frame's header; what follows doesn't matter.
    cv::imwrite(folder / "in.jpg", streetImage());
    std::string content = contentOf(folder / "in.jpg");
    const size_t frame = content.find("\xFF\xC0");
    ASSERT_NE(std::string::npos, frame);
    ASSERT_EQ(3, content[frame + 9]);
    content[frame + 9] = 4;
    writeContent(folder / "in.jpg", content);
    // The kind of colours is entry 262 of a TIFF file, and 5 are those of printers.
    cv::imwrite(folder / "in.tiff", streetImage());
    content = contentOf(folder / "in.tiff");
    const size_t entry = content.find(std::string("\x06\x01\x03\0\x01\0\0\0", 8));
    ASSERT_NE(std::string::npos, entry);
    content[entry + 8] = 5;
    writeContent(folder / "in.tiff", content);
    for (const char* name : {"in.jpg", "in.tiff"})
    {
        const Outcome outcome = correct({folder / name, "--output=" + (folder / "out.png")});
        EXPECT_EQ(1, outcome.exitCode) << name;
        EXPECT_NE(std::string::npos, outcome.messages.find("CMYK")) << outcome.messages;
        EXPECT_FALSE(cv::utils::fs::exists(folder / "out.png"));
    }
}

// An alpha channel is moved as the colours are.
TEST(ImageKinds, alpha)
{
    const TemporaryFolder folder;
    std::vector<cv::Mat> channels;
    cv::split(streetImage(), channels);
    channels.push_back(channels[1]);
    cv::Mat image;
    cv::merge(channels, image);
    cv::imwrite(folder / "in.png", image);
    const Outcome outcome = correct({folder / "in.png", "--output=" + (folder / "out.png"), "--report=-"});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    ASSERT_EQ("ok", nlohmann::json::parse(outcome.output)["status"]);
    const cv::Mat corrected = cv::imread(folder / "out.png", cv::IMREAD_UNCHANGED);
    ASSERT_EQ(CV_8UC4, corrected.type());
    cv::split(corrected, channels);
    EXPECT_EQ(0, cv::norm(channels[1], channels[3], cv::NORM_INF));
    EXPECT_GT(cv::norm(image, corrected, cv::NORM_INF), 0);
}

TEST(ImageKinds, pages_that_are_left_out)
{
    const TemporaryFolder folder;
    cv::imwrite(folder / "one.tiff", streetImage());
    cv::imwrite(folder / "many.tif", std::vector<cv::Mat>(3, streetImage()));
    EXPECT_EQ("", correct({folder / "one.tiff", "--report=-"}).messages);
    const Outcome outcome = correct({folder / "many.tif", "--report=-"});
    EXPECT_EQ(0, outcome.exitCode);
    EXPECT_EQ((folder / "many.tif") + ": warning: only the first of 3 pages is read\n", outcome.messages);
}

}} // namespace
