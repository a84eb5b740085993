// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "image_times.hpp"
#include "files.hpp"
#include "opencv2/rsackermann/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rsackermann_samples {

std::vector<double> missingTimes(const std::vector<Input>& inputs, const DriveLog& log)
{
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> places, times, result(inputs.size(), unknown);
    std::vector<size_t> known;
    for (size_t i = 0; i < inputs.size(); i++)
    {
        places.push_back(inputs[i].intervals + (i > 0 ? places[i - 1] : 0));
        times.push_back(isVideo(inputs[i].name) ? unknown : log.of(inputs[i].name, inputs[i].number, unknown).time);
        if (std::isfinite(times[i]))
            known.push_back(i);
    }
    for (size_t i = 0, next = 0; i < inputs.size() && known.size() > 1; i++)
    {
        while (next < known.size() && known[next] < i)
            next++;
        const size_t end = std::min(std::max(next, size_t(1)), known.size() - 1), a = known[end - 1], b = known[end];
        const double interval = (times[b] - times[a]) / (places[b] - places[a]);
        if (std::isnan(times[i]) && !isVideo(inputs[i].name) && interval > 0 &&
            interval < cv::rsackermann::LONGEST_INTERVAL)
            result[i] = times[a] + interval * (places[i] - places[a]);
    }
    return result;
}

} // namespace rsackermann_samples
