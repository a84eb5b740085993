// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "drive_reader.hpp"
#include "program.hpp"

#ifdef RSACKERMANN_WITH_VIDEOIO
#include "opencv2/videoio.hpp"
#endif

namespace opencv_test { namespace {

using namespace rsackermann_samples;

class ReadDrive : public testing::Test
{
protected:
    void addImage()
    {
        const std::string path = folder_ / cv::format("%03d.png", int(names_.size()));
        cv::imwrite(path, cv::Mat(48, 64, CV_8U, cv::Scalar(7)));
        names_.push_back(path);
    }

    void addUnreadable()
    {
        const std::string path = folder_ / cv::format("%03d.png", int(names_.size()));
        writeContent(path, "no image");
        names_.push_back(path);
    }

    //! The times of all frames that can be read.
    std::vector<double> times(const DriveLog& log = DriveLog())
    {
        std::vector<double> result;
        failures_ = 0;
        readDrive(
            listInputs(names_), log, [&](const DriveFrame& frame, double) { result.push_back(frame.facts.time); },
            [&](const std::string&, const std::string&) { failures_++; });
        return result;
    }

    const TemporaryFolder folder_;
    Arguments names_;
    int failures_;
};

TEST_F(ReadDrive, image_that_cannot_be_read_takes_its_time)
{
    for (const bool isThere : {true, false})
    {
        names_.clear();
        addImage();
        addUnreadable();
        addImage();
        if (!isThere)
            std::remove(names_[1].c_str());
        const std::vector<double> t = times();
        ASSERT_EQ(2u, t.size());
        EXPECT_EQ(1, failures_);
        EXPECT_EQ(0, t[0]); // as of the first frame of a video
        EXPECT_NEAR(2 / 30., t[1], 1e-9);

        writeContent(folder_ / "log.csv", "file,time_s\n000.png,5\n001.png,5.5\n");
        const std::vector<double> given = times(DriveLog(folder_ / "log.csv"));
        ASSERT_EQ(2u, given.size());
        EXPECT_EQ(5, given[0]);
        EXPECT_NEAR(6, given[1], 1e-9); // as far apart as the others

        writeContent(folder_ / "log.csv", "frame,time_s\n0,5\n1,5.5\n2,7\n");
        const std::vector<double> byNumber = times(DriveLog(folder_ / "log.csv"));
        ASSERT_EQ(2u, byNumber.size());
        EXPECT_EQ(7, byNumber[1]);
    }
}

// As of a sequence: a drive of 10 images a second isn't one of images that are now 1/30 s apart, now more.
TEST_F(ReadDrive, images_without_a_row_have_times_between_others)
{
    for (int i = 0; i < 5; i++)
        addImage();
    writeContent(folder_ / "log.csv", "file,time_s\n001.png,7.1\n003.png,7.3\n");
    const std::vector<double> t = times(DriveLog(folder_ / "log.csv"));
    ASSERT_EQ(names_.size(), t.size());
    for (int i = 0; i < 5; i++)
        EXPECT_NEAR(7 + 0.1 * i, t[size_t(i)], 1e-9);
}

// Of a numbered pattern, a folder or a list: as many frames as the numbers are apart, unless they count something else.
TEST_F(ReadDrive, missing_numbers_take_their_time)
{
    // A reader goes by what is in a file, not by its name.
    std::vector<uchar> bytes;
    cv::imencode(".png", cv::Mat(48, 64, CV_8U, cv::Scalar(7)), bytes);
    const std::string png(bytes.begin(), bytes.end());
    for (const int step : {1, 2, 40})
    {
        const double frames = step == 40 ? 1 : step;
        const std::string images = folder_ / cv::format("of_%d", step);
        cv::utils::fs::createDirectory(images);
        std::vector<std::string> files;
        std::string lines;
        for (const int number : {5, 6, 7, 9, 10})
        {
            files.push_back(images + cv::format("/f2_%d.jp2", step * number));
            writeContent(files.back(), png);
            lines += files.back() + "\n";
        }
        writeContent(images + ".txt", lines);
        const std::vector<std::vector<std::string>> all = {
            {images}, {images + "/f2_%d.jp2"}, {"@" + images + ".txt"}, files};
        for (const std::vector<std::string>& names : all)
        {
            names_ = names;
            const std::string& name = names[0];
            const std::vector<double> t = times();
            ASSERT_EQ(5u, t.size());
            for (const int i : {0, 1, 2})
                EXPECT_NEAR(i * frames / 30, t[i], 1e-9) << name;
            for (const int i : {3, 4})
                EXPECT_NEAR((i + 1) * frames / 30, t[i], 1e-9) << name;
        }
        // Names that differ in more than a number say nothing of times.
        writeContent(images + "/g2_30.jp2", png);
        names_ = {images};
        EXPECT_NEAR(5 / 30., times().back(), 1e-9);
    }
}

// A video may be named with or without its folders, in rows of frames as well as in samples.
TEST_F(ReadDrive, names_of_videos_in_a_log)
{
    for (const char* name : {"drive.avi", "/some/where/drive.avi"})
    {
        writeContent(folder_ / "log.csv", std::string("file,time_s,frame,speed_kmh\n") + name + ",0,,10\n" + name +
                                              ",1,,20\n" + name + ",,7,70\n");
        const DriveLog log(folder_ / "log.csv");
        EXPECT_EQ(15, log.of("/some/where/drive.avi", 3, 0.5).speed) << name;
        EXPECT_EQ(70, log.of("/some/where/drive.avi", 7, 0.5).speed) << name;
        EXPECT_TRUE(std::isnan(log.of("/some/where/else.avi", 7, 0.5).speed)) << name;
    }
}

#ifdef RSACKERMANN_WITH_VIDEOIO
TEST_F(ReadDrive, videos_are_drives_of_their_own)
{
    addImage();
    for (int i = 0; i < 2; i++)
    {
        names_.push_back(folder_ / cv::format("%d.avi", i));
        cv::VideoWriter video(names_.back(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, cv::Size(64, 48));
        ASSERT_TRUE(video.isOpened());
        for (int k = 0; k < 3; k++)
            video.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(50 * k)));
    }
    addImage();
    addImage();
    const std::vector<double> t = times();
    ASSERT_EQ(9u, t.size());
    for (const int begin : {1, 4, 7})
        EXPECT_GT(t[begin] - t[begin - 1], 60) << begin;
    for (const int next : {2, 3, 5, 6})
        EXPECT_NEAR(0.04, t[next] - t[next - 1], 1e-6) << next;
    EXPECT_NEAR(1 / 30., t[8] - t[7], 1e-9);
}

// The frames that are there count, and the exit code says that some are missing.
TEST_F(ReadDrive, video_that_is_cut_short)
{
    names_ = {folder_ / "whole.avi"};
    cv::Mat frame(240, 320, CV_8UC3);
    cv::randu(frame, 0, 255);
    cv::VideoWriter video(names_[0], cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, frame.size());
    for (int k = 0; k < 4; k++)
        video.write(frame);
    video.release();
    EXPECT_EQ(4u, times().size());
    EXPECT_EQ(0, failures_);
    cutShort(names_[0], folder_ / "cut.avi", 0.6);
    names_ = {folder_ / "cut.avi"};
    const size_t left = times().size();
    EXPECT_GT(left, 0u);
    EXPECT_LT(left, 4u);
    EXPECT_EQ(1, failures_);
}
#endif

}} // namespace
