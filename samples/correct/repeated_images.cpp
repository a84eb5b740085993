// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "repeated_images.hpp"

#include "opencv2/imgproc.hpp"
#include <algorithm>
#include <limits>

namespace rsackermann_samples {

double ImageChange::to(const cv::Mat& image)
{
    cv::Mat some;
    cv::resize(image, some, cv::Size(128, 96), 0, 0, cv::INTER_NEAREST);
    const double change = !before_.empty() && some.type() == before_.type()
                              ? cv::norm(some, before_, cv::NORM_L1) / double(some.total())
                              : std::numeric_limits<double>::quiet_NaN();
    before_ = some;
    return change;
}

static int countRepeated(const std::vector<double>& changes)
{
    const int longest = 5;     // from 5 to 30 images a second; those of a car that stands are more
    const double share = 0.25; // of the others' change
    int count = 0;
    for (size_t i = 1; i < changes.size(); i++)
    {
        size_t end = i;
        double most = 0;
        for (; end < changes.size() && changes[end] < share * changes[i - 1]; end++)
            most = std::max(most, changes[end]);
        const int run = int(end - i);
        if (run > 0 && run <= longest && end < changes.size() && most < share * changes[end])
            count += run;
        i += run;
    }
    return count;
}

std::string repeatedImages(const std::vector<double>& changes)
{
    const int count = countRepeated(changes), least = 3;
    if (count < least || count < int(changes.size()) / 10)
        return "";
    return cv::format("%d of %d images nearly repeat the one before, as converters of frame rates add them: times are "
                      "then not those at which images were taken, and motions err; give the images as the camera took "
                      "them, or without those (ffmpeg -vf mpdecimate -fps_mode vfr)",
                      count, int(changes.size()));
}

} // namespace rsackermann_samples
