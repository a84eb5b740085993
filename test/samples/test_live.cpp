// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"

#include "opencv2/videoio.hpp"

namespace opencv_test { namespace {

Outcome live(const Arguments& arguments)
{
    return runProgram(LIVE_PROGRAM, arguments);
}

const cv::Size SIZE(480, 300);
const double LINE_DELAY = 25e-3 / SIZE.height;

// A video of a bend, four frames at 30 frames a second, and a grey picture.
class Live : public testing::Test
{
protected:
    Live() : video_(folder_ / "drive.avi"), slow_(folder_ / "slow.avi"), picture_(folder_ / "picture.png")
    {
        const int code = cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
        cv::VideoWriter writer(video_, code, 30, SIZE), slow(slow_, code, 10, SIZE);
        for (int before = 3; before >= 0; before--)
        {
            // A line far behind the image is the one at whose instant the car is where it is in the last frame.
            const double reference = (SIZE.height - 1) / 2. + before / 30. / LINE_DELAY;
            simulate({"--output=" + street_.path(), "--overwrite", "--size=480x300", "--focal=400",
                      cv::format("--line_delay=%.9g", LINE_DELAY), "--left=6", "--right=7", "--speed=54",
                      "--yaw_rate=30", "--noise=0", cv::format("--reference=%.9g", reference)});
            const cv::Mat frame = cv::imread(street_ / "rolling.png");
            writer.write(frame);
            slow.write(frame);
        }
        writer.write(cv::Mat(SIZE, CV_8UC3, cv::Scalar::all(90)));
        camera_ = "--camera=" + (street_ / "camera.yml");
    }

    TemporaryFolder folder_, street_;
    std::string camera_, video_, slow_, picture_; // slow_: the same frames, 10 a second
};

TEST_F(Live, raw_and_corrected_image_are_side_by_side)
{
    const Outcome outcome = live({video_, camera_, "--frames=4", "--picture=" + picture_});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const cv::Mat picture = cv::imread(picture_), raw = cv::imread(street_ / "rolling.png"),
                  truth = cv::imread(street_ / "global.png");
    ASSERT_EQ(cv::Size(2 * SIZE.width, SIZE.height), picture.size());
    const int numbers = SIZE.height / 6; // lines of numbers at the top
    const cv::Rect left(0, numbers, SIZE.width, SIZE.height - numbers), right(left + cv::Point(SIZE.width, 0));
    EXPECT_LT(differenceInside(raw(left), picture(left)), 0.5 * differenceInside(truth(left), picture(left)));
    EXPECT_LT(differenceInside(truth(left), picture(right)), 0.7 * differenceInside(truth(left), picture(left)));
    EXPECT_GT(cv::norm(raw.rowRange(0, numbers), picture(cv::Rect(0, 0, SIZE.width, numbers)), cv::NORM_INF), 150);
}

TEST_F(Live, goes_by_the_times_of_frames)
{
    cv::Mat pictures[2];
    for (const bool isSlow : {false, true})
    {
        ASSERT_EQ(
            0, live({isSlow ? slow_ : video_, camera_, "--frames=4", "--picture=" + picture_, "--overwrite"}).exitCode);
        pictures[isSlow] = cv::imread(picture_);
    }
    const cv::Rect corrected(SIZE.width, SIZE.height / 6, SIZE.width, SIZE.height - SIZE.height / 6);
    EXPECT_GT(cv::norm(pictures[0](corrected), pictures[1](corrected), cv::NORM_INF), 20);
}

TEST_F(Live, goes_on_to_the_end)
{
    ASSERT_EQ(0, live({video_, camera_, "--picture=" + picture_}).exitCode);
    // as the decoder sees it, whose grey isn't the same everywhere
    cv::VideoCapture video(video_);
    cv::Mat frame, last;
    while (video.read(frame))
        last = frame.clone();
    EXPECT_LT(cv::norm(last, cv::Mat(SIZE, CV_8UC3, cv::Scalar::all(90)), cv::NORM_INF), 5);
    EXPECT_LT(differenceInside(last, cv::imread(picture_).colRange(SIZE.width, 2 * SIZE.width)), 1);
}

// What there is is shown.
TEST_F(Live, video_that_is_cut_short)
{
    cutShort(video_, folder_ / "cut.avi", 0.6);
    const Outcome outcome = live({folder_ / "cut.avi", camera_, "--picture=" + picture_});
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find((folder_ / "cut.avi") + ": the video is cut short"))
        << outcome.messages;
    EXPECT_EQ(cv::Size(2 * SIZE.width, SIZE.height), cv::imread(picture_).size());
    EXPECT_EQ(0, live({folder_ / "cut.avi", camera_, "--frames=1", "--picture=" + picture_, "--overwrite"}).exitCode);
}

TEST_F(Live, no_display)
{
    for (const char* display : {"", "DISPLAY=:987"})
    {
        const Outcome outcome = runCommand(std::string("env -u DISPLAY -u WAYLAND_DISPLAY -u QT_QPA_PLATFORM ") +
                                           display + " '" LIVE_PROGRAM "' '" + video_ + "'");
        EXPECT_EQ(1, outcome.exitCode) << display;
        EXPECT_NE(std::string::npos, outcome.messages.find("no window can be opened")) << outcome.messages;
        EXPECT_NE(std::string::npos, outcome.messages.find("--picture")) << outcome.messages;
    }
}

TEST_F(Live, usage)
{
    const Outcome help = live({"--help"});
    EXPECT_EQ(0, help.exitCode);
    for (const char* name : {"--camera", "--wall", "--frames", "--picture", "--overwrite"})
        EXPECT_NE(std::string::npos, help.output.find(name)) << name;
    EXPECT_EQ(2, live({}).exitCode);
    EXPECT_EQ(2, live({video_, video_}).exitCode);
    EXPECT_EQ(2, live({video_, "--frames=-1", "--picture=" + picture_}).exitCode);
    EXPECT_EQ(2, live({video_, "--frame=1", "--picture=" + picture_}).exitCode);
    EXPECT_EQ(1, live({"/no/such/video.avi", "--picture=" + picture_}).exitCode);
    EXPECT_EQ(1, live({video_, "--frames=1", "--picture=/dev/null/x.png"}).exitCode);
    const Outcome missing = live({"/no/such/video.avi", "--picture=" + picture_});
    EXPECT_NE(std::string::npos, missing.messages.find("/no/such/video.avi: there is no such file"))
        << missing.messages;
    const std::string before = contentOf(street_ / "rolling.png");
    EXPECT_EQ(2, live({street_ / "rolling.png", "--picture=" + (street_ / "rolling.png")}).exitCode);
    EXPECT_EQ(before, contentOf(street_ / "rolling.png"));
    EXPECT_EQ(2, live({video_, "--picture=" + (folder_ / "picture.unknown")}).exitCode);
    EXPECT_EQ((std::vector<std::string>{"drive.avi", "slow.avi"}), namesIn(folder_.path()));
}

TEST_F(Live, existing_picture)
{
    writeContent(picture_, "mine");
    const Arguments arguments = {video_, "--frames=1", "--picture=" + picture_};
    const Outcome refused = live(arguments);
    EXPECT_EQ(1, refused.exitCode);
    EXPECT_NE(std::string::npos, refused.messages.find("picture.png exists (--overwrite replaces it)"))
        << refused.messages;
    EXPECT_EQ("mine", contentOf(picture_));
    EXPECT_EQ(0, live(arguments + Arguments{"--overwrite"}).exitCode);
    EXPECT_FALSE(cv::imread(picture_).empty());
}

// OpenCV reads a numbered image as the first one of a sequence.
TEST_F(Live, images_of_a_sequence_stay)
{
    const cv::Mat image(SIZE, CV_8UC3, cv::Scalar::all(90));
    for (int i = 0; i < 3; i++)
        cv::imwrite(folder_ / cv::format("%06d.png", i), image);
    for (const char* name : {"000000.png", "000002.png"})
    {
        const std::string before = contentOf(folder_ / name);
        const Outcome outcome = live({folder_ / "000000.png", "--picture=" + (folder_ / name), "--overwrite"});
        EXPECT_EQ(2, outcome.exitCode) << name;
        EXPECT_NE(std::string::npos, outcome.messages.find("would replace the input")) << outcome.messages;
        EXPECT_EQ(before, contentOf(folder_ / name)) << name;
    }
    EXPECT_EQ(0, live({folder_ / "000000.png", "--picture=" + picture_}).exitCode);
}

}} // namespace
