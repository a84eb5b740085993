// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "progress.hpp"

#include "opencv2/core/utility.hpp"
#include <algorithm>
#include <cmath>
#include <iostream>
#include <sys/ioctl.h>
#include <unistd.h>

namespace rsackermann_samples {

namespace {

double secondsSince(int64 tick)
{
    return double(cv::getTickCount() - tick) / cv::getTickFrequency();
}

// A duration as h:mm:ss or m:ss.
std::string clockOf(double seconds)
{
    const int s = int(std::lround(std::min(seconds, 359999.)));
    return s < 3600 ? cv::format("%d:%02d", s / 60, s % 60) : cv::format("%d:%02d:%02d", s / 3600, s / 60 % 60, s % 60);
}

// Columns of the terminal; a longer line would wrap and couldn't be rewritten.
size_t widthOfTerminal()
{
    winsize size = {};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size_t(size.ws_col) : 80u;
}

} // namespace

Progress::Progress()
    : isTerminal_(isatty(STDERR_FILENO) != 0), start_(cv::getTickCount()), shown_(start_), visible_(false)
{
}

void Progress::update(double done, double total, const std::string& what)
{
    const double interval = visible_ ? 0.2 : 1;
    if (!isTerminal_ || secondsSince(visible_ ? shown_ : start_) < interval)
        return;
    shown_ = cv::getTickCount();
    visible_ = true;
    std::string line = cv::format("%3.0f %%", 100 * std::min(done / total, 1.));
    if (done > 0)
        line += ", " + clockOf(secondsSince(start_) * std::max(total - done, 0.) / done) + " left";
    line += ", " + what;
    std::cerr << "\r\x1b[K" << line.substr(0, widthOfTerminal() - 1) << std::flush;
}

void Progress::clear()
{
    if (visible_)
        std::cerr << "\r\x1b[K" << std::flush;
    visible_ = false;
}

} // namespace rsackermann_samples
