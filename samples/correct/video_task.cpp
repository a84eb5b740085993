// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "video_task.hpp"
#include "map_file.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/videoio.hpp"
#include <cmath>
#include <map>

namespace rsackermann_samples {

namespace {

// A video that appears complete or not at all.
class VideoFile
{
public:
    VideoFile(const std::string& path, double framesPerSecond, const cv::Size& size) : path_(path), size_(size), file_(path)
    {
        // Codecs that every build of FFmpeg has, and for AVI OpenCV itself.
        static const std::map<std::string, std::string> codecs = {
            {".avi", "MJPG"}, {".mkv", "MJPG"}, {".mjpeg", "MJPG"}, {".mp4", "mp4v"}, {".m4v", "mp4v"},
            {".mov", "mp4v"}, {".webm", "VP80"}, {".wmv", "WMV2"}, {".mpg", "PIM1"}, {".mpeg", "PIM1"}};
        const std::map<std::string, std::string>::const_iterator it = codecs.find(extension(path));
        if (it == codecs.end())
            throw InputError(path + ": the extension is none of a video");
        const std::string& c = it->second;
        if (!writer_.open(file_.temporaryName(), cv::VideoWriter::fourcc(c[0], c[1], c[2], c[3]), framesPerSecond, size))
            throw InputError(path + ": the video can't be written");
    }

    void add(const cv::Mat& frame)
    {
        // A writer leaves out what doesn't fit and says nothing.
        if (frame.size() != size_)
            throw InputError(path_ + ": the size of the frames changes");
        writer_.write(frame);
    }

    void commit()
    {
        writer_.release();
        if (!cv::utils::fs::exists(file_.temporaryName()))
            throw InputError(path_ + " can't be written");
        file_.commit();
    }

private:
    std::string path_;
    cv::Size size_;
    AtomicFile file_;
    cv::VideoWriter writer_; // closed before the file is removed
};

// Times of a video's frames from its container; where it doesn't tell them they have equal distances.
class FrameClock
{
public:
    explicit FrameClock(double framesPerSecond) : interval_(1 / framesPerSecond), time_(-interval_) {}

    // Of the frame that was read last.
    double timeOfFrame(const cv::VideoCapture& capture)
    {
        const double told = capture.get(cv::CAP_PROP_POS_MSEC) / 1000;
        time_ = std::isfinite(told) && told > time_ ? told : time_ + interval_;
        return time_;
    }

private:
    double interval_, time_;
};

void addTo(std::unique_ptr<VideoFile>& video, const std::string& path, double framesPerSecond, const cv::Mat& frame)
{
    if (path.empty())
        return;
    if (!video)
        video.reset(new VideoFile(path, framesPerSecond, frame.size()));
    video->add(frame);
}

} // namespace

void correctVideo(const std::string& input, const Targets& targets, const DriveLog& log, FrameCorrector& corrector, std::vector<std::string>& lines,
                  const std::function<void(double)>& progress)
{
    if (!cv::utils::fs::exists(input))
        throw InputError("there is no such file");
    cv::VideoCapture capture(input);
    if (!capture.isOpened())
        throw InputError("the video can't be read");
    // The sensor's rows count, hence no turning of pictures from a camera that was held upright.
    capture.set(cv::CAP_PROP_ORIENTATION_AUTO, 0);
    const double announced = capture.get(cv::CAP_PROP_FRAME_COUNT), rate = capture.get(cv::CAP_PROP_FPS);
    const double framesPerSecond = rate > 0 && rate <= 1000 ? rate : 30; // not every format says so

    corrector.reset();
    std::unique_ptr<VideoFile> output, overlay;
    std::vector<std::string> frameLines;
    FrameClock clock(framesPerSecond);
    for (cv::Mat image; capture.read(image);)
    {
        const int number = int(frameLines.size());
        CorrectedFrame frame = corrector.correct(image, log.of(input, number, clock.timeOfFrame(capture)));
        addTo(output, targets.output, framesPerSecond, frame.image);
        addTo(overlay, targets.overlay, framesPerSecond, frame.overlay);
        frame.report.input = input;
        if (!targets.maps.empty())
            writeMaps(targets.mapsOfFrame(number), frame.map1, frame.map2);
        frame.report.frame = number;
        frameLines.push_back(reportLine(frame.report));
        progress(announced > 0 ? std::min(double(frameLines.size()) / announced, 1.) : 0);
    }
    if (frameLines.empty())
        throw InputError("no frame of the video can be read");
    if (overlay)
        overlay->commit();
    if (output)
        output->commit();
    lines.swap(frameLines);
    // Containers that tell the duration only may be wrong by one frame.
    if (announced > double(lines.size()) + 1)
        throw InputError(cv::format("the video is cut short: %d of %.0f frames could be read", int(lines.size()), announced));
}

} // namespace rsackermann_samples
