// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "video_timing.hpp"
#include "options.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include <cmath>

namespace rsackermann_samples {

FrameClock::FrameClock(const cv::VideoCapture& capture)
{
    const double rate = capture.get(cv::CAP_PROP_FPS);
    interval_ = 1 / (rate > 0 && rate <= 1000 ? rate : 30); // not every format says so
    time_ = -interval_;
}

double FrameClock::timeOfFrame(const cv::VideoCapture& capture)
{
    const double told = capture.get(cv::CAP_PROP_POS_MSEC) / 1000;
    // Some containers round to milliseconds; then the announced rate is the better clock.
    const double next = time_ + interval_, rounding = 1.001e-3;
    time_ = std::isfinite(told) && told > time_ && std::abs(told - next) > rounding ? told : next;
    return time_;
}

double meanRate(const std::string& path)
{
    cv::VideoCapture capture = openVideo(path);
    FrameClock clock(capture);
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
