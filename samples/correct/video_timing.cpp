// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "video_timing.hpp"
#include "options.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include <cmath>

namespace rsackermann_samples {

static const double ROUNDING = 1.001e-3; // some containers round to milliseconds

FrameClock::FrameClock(const cv::VideoCapture& capture, const FrameIndex& index) : index_(index.times), next_(0)
{
    const double rate = capture.get(cv::CAP_PROP_FPS);
    interval_ = 1 / (rate > 0 && rate <= 1000 ? rate : 30); // not every format says so
    time_ = -interval_;
}

// The time of the next frame in the index; 0, as OpenCV does it, if it is unknown.
double FrameClock::indexedTime(double reported)
{
    if (next_ == 0 && !index_.empty()) // OpenCV takes the time of decoding for that of the first frame
        return index_[next_++];
    // Frames after the last packet have no reported time, and damaged ones don't appear.
    while (reported > 0 && next_ < index_.size() && index_[next_] < reported - ROUNDING)
        next_++;
    if (next_ >= index_.size() || (reported > 0 && std::abs(index_[next_] - reported) > ROUNDING))
        index_.clear();
    return index_.empty() ? reported : index_[next_++];
}

double FrameClock::timeOfFrame(const cv::VideoCapture& capture)
{
    const double reported = indexedTime(capture.get(cv::CAP_PROP_POS_MSEC) / 1000);
    // The announced rate is a better clock than milliseconds.
    const double next = time_ + interval_;
    time_ = std::isfinite(reported) && reported > time_ && std::abs(reported - next) > ROUNDING ? reported : next;
    return time_;
}

double meanRate(const std::string& path)
{
    cv::VideoCapture capture = openVideo(path);
    FrameClock clock(capture, readFrameIndex(path));
    double first = 0, last = 0;
    int count = 0;
    for (; capture.grab(); count++)
    {
        last = clock.timeOfFrame(capture);
        first = count == 0 ? last : first;
    }
    const double announced = clock.announcedRate(), mean = count > 1 ? (count - 1) / (last - first) : announced;
    // Times are rounded to milliseconds and the like; the announced rate is exact.
    const bool same = std::abs(mean - announced) * std::max(count - 1, 1) < 0.01 * announced * (count + 10.);
    return same || !(mean > 0 && mean <= 1000) ? announced : mean;
}

int countFrames(const std::string& path)
{
    cv::VideoCapture capture = openVideo(path);
    int count = 0;
    while (capture.grab())
        count++;
    return count;
}

double pixelAspect(const cv::VideoCapture& capture)
{
    const double width = capture.get(cv::CAP_PROP_SAR_NUM), height = capture.get(cv::CAP_PROP_SAR_DEN);
    return width > 0 && height > 0 ? width / height : 1;
}

cv::VideoCapture openVideo(const std::string& path)
{
    if (!cv::utils::fs::exists(path))
        throw InputError("there is no such file");
    cv::VideoCapture capture(path);
    if (!capture.isOpened())
        throw InputError("the video can't be read");
    // No turning of pictures from a camera that was held upright.
    capture.set(cv::CAP_PROP_ORIENTATION_AUTO, 0);
    return capture;
}

} // namespace rsackermann_samples
