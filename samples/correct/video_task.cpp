// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "video_task.hpp"
#include "files.hpp"
#include "gyro_clock.hpp"
#include "map_file.hpp"
#include "output/interrupt.hpp"
#include "video_ends.hpp"
#include "video_file.hpp"
#include "video_timing.hpp"

#include "opencv2/core/utils/filesystem.hpp"

namespace rsackermann_samples {

namespace {

// The frames of a video, of which one is read ahead if it is wanted.
class FrameReader
{
public:
    FrameReader(cv::VideoCapture& capture, const FrameIndex& index, const DriveLog& log, const std::string& input)
        : capture_(capture), clock_(capture, index), log_(log), input_(input), number_(-1), isAhead_(false)
    {
    }

    bool read()
    {
        if (isAhead_)
        {
            image_ = ahead_;
            ahead_ = cv::Mat();
            facts_ = factsAhead_;
            isAhead_ = false;
        }
        else if (!readNext(image_, facts_))
            return false;
        number_++;
        return true;
    }

    NextFrame next()
    {
        isAhead_ = readNext(ahead_, factsAhead_);
        return isAhead_ ? NextFrame(ahead_, factsAhead_.time) : NextFrame();
    }

    int number() const { return number_; }
    const cv::Mat& image() const { return image_; }
    const FrameFacts& facts() const { return facts_; }

private:
    bool readNext(cv::Mat& image, FrameFacts& facts)
    {
        image = cv::Mat(); // the one before may still be in use
        if (!capture_.read(image))
            return false;
        facts = log_.of(input_, number_ + 1, clock_.timeOfFrame(capture_));
        return true;
    }

    cv::VideoCapture& capture_;
    FrameClock clock_;
    const DriveLog& log_;
    const std::string& input_;
    int number_;
    bool isAhead_;
    cv::Mat image_, ahead_;
    FrameFacts facts_, factsAhead_;
};

// By its first frames.
double gyroDelayOf(const std::string& input, const FrameIndex& index, const Job& job)
{
    cv::VideoCapture capture = openVideo(input);
    FrameReader reader(capture, index, job.log, input);
    return gyroDelay(job, [&](cv::Mat& image, FrameFacts& facts) {
        const bool isRead = reader.read();
        image = reader.image();
        facts = reader.facts();
        return isRead;
    });
}

// A frame whose depth is missing or damaged fails as an image does; the others are corrected.
CorrectedFrame correctFrame(FrameCorrector& corrector, const cv::Mat& image, const NextFrame& next,
                            const std::string& depthFile)
{
    try
    {
        return corrector.correct(image, next, depthFile);
    }
    catch (const InputError& e)
    {
        return corrector.uncorrected(image, e.what());
    }
}

void addTo(std::unique_ptr<VideoFile>& video, const std::string& path, double framesPerSecond, const cv::Mat& frame)
{
    if (path.empty())
        return;
    if (!video)
        video.reset(new VideoFile(path, framesPerSecond, frame.size()));
    video->add(frame);
}

void writeMapsOfFrame(const std::string& path, const Job& job, const CorrectedFrame& frame)
{
    if (cv::utils::fs::exists(path))
    {
        if (job.skipExisting)
            return;
        if (!job.overwrite)
            throw InputError(path + " exists (--overwrite replaces it)");
    }
    AtomicFile file(path);
    writeMaps(file, frame.map1, frame.map2);
    file.commit();
}

} // namespace

void correctVideo(const std::string& input, const Targets& targets, const Job& job, FrameCorrector& corrector,
                  std::vector<FrameReport>& reports, const std::function<void(double)>& progress)
{
    cv::VideoCapture capture = openVideo(input);
    const bool isWritten = !targets.output.empty() || !targets.overlay.empty();
    const FrameIndex index = readFrameIndex(input);
    const double announced = announcedFrames(index, capture), framesPerSecond = isWritten ? meanRate(input) : 0;
    const double aspect = pixelAspect(capture);
    FrameReader reader(capture, index, job.log, input);
    if (needsGyroClock(job))
        corrector.setGyroDelay(gyroDelayOf(input, index, job));

    std::unique_ptr<VideoFile> output, overlay;
    std::vector<FrameReport> frames;
    while (reader.read())
    {
        if (interruptSignal())
            throw Interrupted();
        const int number = reader.number();
        const NextFrame next = corrector.wantsNext() ? reader.next() : NextFrame();
        corrector.beginFrame(reader.facts());
        CorrectedFrame frame = correctFrame(corrector, reader.image(), next, job.depth.fileOfFrame(input, number));
        addTo(output, targets.output, framesPerSecond, frame.image);
        addTo(overlay, targets.overlay, framesPerSecond, frame.overlay);
        if (!targets.maps.empty() && frame.report.error.empty())
            writeMapsOfFrame(targets.mapsOfFrame(number), job, frame);
        frame.report.input = input;
        frame.report.frame = number;
        frame.report.pixelAspect = aspect;
        frames.push_back(frame.report);
        progress(announced > 0 ? std::min(double(frames.size()) / announced, 1.) : 0);
    }
    if (frames.empty())
        throw InputError("no frame of the video can be read");
    if (std::all_of(frames.begin(), frames.end(), [](const FrameReport& report) { return !report.error.empty(); }))
        throw InputError("no frame of the video can be corrected; the first one: " + frames[0].error);
    for (const std::unique_ptr<VideoFile>* video : {&overlay, &output})
        if (*video)
            (*video)->close();
    for (const std::unique_ptr<VideoFile>* video : {&overlay, &output})
        if (*video)
            (*video)->commit();
    for (FrameReport& report : frames)
        report.frames = int(frames.size());
    reports.swap(frames);
    checkEnd(input, index, announced, int(reports.size()));
}

} // namespace rsackermann_samples
