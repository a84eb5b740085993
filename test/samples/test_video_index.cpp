// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Videos that FFmpeg writes and OpenCV can't: with edit lists, rates that vary and frames in another order than they
// are shown in.

#include "program.hpp"
#include "../../samples/correct/frame_index.hpp"

#include <fstream>
#include <sstream>

namespace opencv_test { namespace {

typedef nlohmann::ordered_json Json;

const char* const FFMPEG = "ffmpeg -nostdin -v error -y ";

// Frames at times of which no two distances in a row are equal.
const int FRAMES = 60;
int millisecondsOf(int frame)
{
    return 33 * frame + 12 * (frame % 3) + 5 * (frame % 2);
}

class VideoIndex : public testing::TestWithParam<std::tuple<std::string, std::string>>
{
protected:
    VideoIndex() : whole_(in_ / ("whole." + std::get<1>(GetParam())))
    {
        write(cv::format("-f lavfi -i testsrc=size=160x120:rate=30 -frames:v %d -vf \"settb=1/1000,"
                         "setpts='33*N+12*mod(N,3)+5*mod(N,2)'\" -fps_mode passthrough -enc_time_base 1/1000 -c:v %s "
                         "-g 15 -bf 2",
                         FRAMES, std::get<0>(GetParam()).c_str()),
              whole_);
    }

    static void write(const std::string& options, const std::string& path)
    {
        const Outcome outcome = runCommand(FFMPEG + options + " '" + path + "'");
        ASSERT_EQ(0, outcome.exitCode) << outcome.messages << " (is ffmpeg installed?)";
    }

    bool isMatroska() const { return std::get<1>(GetParam()) == "mkv"; }

    std::string of(const std::string& name) const { return in_ / (name + "." + std::get<1>(GetParam())); }

    // The times that the report tells; checks the exit code.
    std::vector<double> timesOf(const std::string& video, int exitCode = 0) const
    {
        const Outcome outcome = correct({video, "--report=-"});
        EXPECT_EQ(exitCode, outcome.exitCode) << outcome.messages;
        EXPECT_EQ(exitCode != 0, outcome.messages.find("cut short") != std::string::npos) << outcome.messages;
        std::vector<double> times;
        std::istringstream lines(outcome.output);
        for (std::string line; std::getline(lines, line);)
        {
            const Json json = Json::parse(line);
            if (json["status"] != "failed")
                times.push_back(json["time_s"].get<double>());
        }
        return times;
    }

    // Compares with the frames of the whole video from one of them on.
    static void expectTimes(const std::vector<double>& times, int first, size_t count)
    {
        ASSERT_EQ(count, times.size());
        for (size_t i = 0; i < count; i++)
        {
            const double expected = (millisecondsOf(first + int(i)) - millisecondsOf(first)) / 1000.;
            EXPECT_NEAR(expected, times[i], 1.1e-3) << i << " after frame " << first;
        }
    }

    TemporaryFolder in_;
    const std::string whole_;
};

// Decoders give the last frames back when there is no packet left.
TEST_P(VideoIndex, times_up_to_the_last_frame)
{
    expectTimes(timesOf(whole_), 0, FRAMES);
}

// A cut without new coding begins with the frame before from which the others can be decoded: MP4 hides it.
TEST_P(VideoIndex, trimmed_at_the_begin)
{
    write("-ss 0.7 -i '" + whole_ + "' -c copy", of("trimmed"));
    int first = 0;
    while (millisecondsOf(first) < 700)
        first++;
    first = isMatroska() ? 15 : first;
    expectTimes(timesOf(of("trimmed")), first, size_t(FRAMES - first));
}

TEST_P(VideoIndex, trimmed_at_both_ends)
{
    write("-ss 0.7 -t 0.8 -i '" + whole_ + "' -c copy", of("trimmed"));
    const std::vector<double> times = timesOf(of("trimmed"));
    EXPECT_GT(times.size(), 20u);
    EXPECT_LT(times.size(), isMatroska() ? 40u : 30u);
}

TEST_P(VideoIndex, cut_short)
{
    write("-ss 0.7 -i '" + whole_ + "' -c copy" + (isMatroska() ? "" : " -movflags faststart"), of("trimmed"));
    const size_t all = timesOf(of("trimmed")).size();
    cutShort(of("trimmed"), of("cut"), 0.8);
    const size_t left = timesOf(of("cut"), 1).size();
    EXPECT_GT(left, 0u);
    EXPECT_LT(left, all);
}

// OpenCV reads the frames of the first fragment alone, which isn't the whole video.
TEST_P(VideoIndex, fragments)
{
    if (isMatroska())
        return;
    write("-i '" + whole_ + "' -c copy -movflags frag_keyframe+empty_moov", of("fragments"));
    const Outcome outcome = correct({of("fragments"), "--report=-"});
    const size_t lines = size_t(std::count(outcome.output.begin(), outcome.output.end(), '\n'));
    if (outcome.exitCode == 0)
        EXPECT_EQ(size_t(FRAMES), lines);
    else
        EXPECT_NE(std::string::npos, outcome.messages.find(cv::format("of %d frames", FRAMES))) << outcome.messages;
}

INSTANTIATE_TEST_CASE_P(Formats, VideoIndex,
                        testing::Combine(testing::Values("libx264", "mpeg4"), testing::Values("mp4", "mov", "mkv")));

// Numbers of four bytes.
std::string bytesOf(const std::vector<uint32_t>& numbers)
{
    std::string bytes;
    for (const uint32_t number : numbers)
        for (int shift = 24; shift >= 0; shift -= 8)
            bytes += char(number >> shift & 0xff);
    return bytes;
}

std::string box(const std::string& name, const std::string& content)
{
    return bytesOf({uint32_t(8 + content.size())}) + name + content;
}

// Frames may have durations, sizes, flags and offsets of their own, in this order, or those of their fragment or track.
TEST(FrameIndex, each_field_of_a_fragment)
{
    const TemporaryFolder in;
    const uint32_t id = 7, second = 1000, ofTrack = 40, ofFragment = 50, steps[] = {30, 35, 45, 40},
                   offsets[] = {0, 20, uint32_t(-5), 10};
    const std::string track =
                          box("tkhd", bytesOf({0, 0, 0, id})) +
                          box("mdia", box("mdhd", bytesOf({0, 0, 0, second})) + box("hdlr", bytesOf({0, 0}) + "vide")),
                      movie = box("moov", box("mvhd", bytesOf({0, 0, 0, second})) + box("trak", track) +
                                              box("mvex", box("trex", bytesOf({0, id, 1, ofTrack}))));
    for (int fields = 0; fields < 16; fields++)
        for (int defaults = 0; defaults < 2; defaults++)
        {
            std::vector<uint32_t> header(1, defaults ? 8 : 0), run = {uint32_t(fields << 8), 4};
            header.push_back(id);
            if (defaults)
                header.push_back(ofFragment);
            std::vector<double> expected;
            double time = 0;
            for (int i = 0; i < 4; i++)
            {
                if (fields & 1)
                    run.push_back(steps[i]);
                if (fields & 2)
                    run.push_back(1111); // bytes
                if (fields & 4)
                    run.push_back(2222); // flags
                if (fields & 8)
                    run.push_back(offsets[i]);
                expected.push_back((time + (fields & 8 ? int32_t(offsets[i]) : 0)) / second);
                time += fields & 1 ? steps[i] : defaults ? ofFragment : ofTrack;
            }
            std::sort(expected.begin(), expected.end());
            const std::string path = in / "fragments.mp4";
            std::ofstream(path, std::ios::binary)
                << box("ftyp", "isom") << movie
                << box("moof", box("traf", box("tfhd", bytesOf(header)) + box("trun", bytesOf(run))));
            const std::vector<double> times = rsackermann_samples::readFrameIndex(path).times;
            ASSERT_EQ(4u, times.size()) << fields << " " << defaults;
            for (size_t i = 0; i < 4; i++)
                EXPECT_NEAR(expected[i] - expected[0], times[i], 1e-9) << fields << " " << defaults << " " << i;
        }
}

}} // namespace
