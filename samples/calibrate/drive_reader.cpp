// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "drive_reader.hpp"
#include "files.hpp"
#include "image_times.hpp"
#include "options.hpp"
#include "output/interrupt.hpp"
#ifdef RSACKERMANN_WITH_VIDEOIO
#include "video_ends.hpp"
#include "video_timing.hpp"
#endif

#include <cmath>

namespace rsackermann_samples {

namespace {

const double INTERVAL = 1. / 30; // seconds from image to image if the log doesn't tell how many
// Seconds, so that nobody takes one video for the continuation of another
const double BETWEEN_DRIVES = 3600;

class DriveReader
{
public:
    DriveReader(const std::vector<Input>& inputs, const DriveLog& log,
                const std::function<void(const DriveFrame&, double)>& use)
        : inputs_(inputs), log_(log), use_(use), missing_(missingTimes(inputs, log)), next_(0), offset_(0)
    {
    }

    void readImageFile(size_t index)
    {
        const Input& input = inputs_[index];
        DriveFrame frame;
        frame.facts = log_.of(input.name, input.number, missing_[index]);
        frame.isTimeGiven = !std::isnan(frame.facts.time);
        if (!frame.isTimeGiven)
            frame.facts.time = next_ + (input.intervals - 1) * INTERVAL;
        next_ = frame.facts.time + INTERVAL; // even if it can't be read: the next one comes after it
        if (!input.isFile())
            throw InputError(input.error);
        frame.image = readImage(input.name);
        hand(frame, double(index + 1) / double(inputs_.size()));
    }

#ifdef RSACKERMANN_WITH_VIDEOIO
    void readVideoFile(size_t index)
    {
        const std::string& input = inputs_[index].name;
        cv::VideoCapture capture = openVideo(input);
        const FrameIndex frames = readFrameIndex(input);
        FrameClock clock(capture, frames);
        const double announced = announcedFrames(frames, capture);
        offset_ = index > 0 ? next_ + BETWEEN_DRIVES : 0;
        int number = 0;
        DriveFrame frame;
        for (; capture.read(frame.image); number++)
        {
            frame.facts = log_.of(input, number, clock.timeOfFrame(capture));
            next_ = frame.facts.time += offset_;
            hand(frame, (double(index) + (announced > 0 ? std::min((number + 1) / announced, 1.) : 0)) /
                            double(inputs_.size()));
        }
        if (number == 0)
            throw InputError("no frame of the video can be read");
        next_ += BETWEEN_DRIVES;
        checkEnd(input, frames, announced, number);
    }
#endif

private:
    void hand(const DriveFrame& frame, double done)
    {
        if (interruptSignal())
            throw Interrupted();
        use_(frame, done);
    }

    const std::vector<Input>& inputs_;
    const DriveLog& log_;
    const std::function<void(const DriveFrame&, double)>& use_;
    const std::vector<double> missing_; // times of images
    double next_, offset_;              // of time: of an image that comes next, and of the present video
};

} // namespace

void readDrive(const InputList& list, const DriveLog& log, const std::function<void(const DriveFrame&, double)>& use,
               const std::function<void(const std::string&, const std::string&)>& fail)
{
    DriveReader reader(list.inputs, log, use);
    for (size_t i = 0; i < list.inputs.size(); i++)
        try
        {
            if (!list.inputs[i].isFile() || !isVideo(list.inputs[i].name))
                reader.readImageFile(i);
#ifdef RSACKERMANN_WITH_VIDEOIO
            else
                reader.readVideoFile(i);
#endif
        }
        catch (const Interrupted&)
        {
            throw;
        }
        catch (const UsageError&) // of all inputs
        {
            throw;
        }
        catch (const cv::Exception& e)
        {
            fail(list.inputs[i].name, e.err);
        }
        catch (const std::exception& e)
        {
            fail(list.inputs[i].name, e.what());
        }
}

} // namespace rsackermann_samples
