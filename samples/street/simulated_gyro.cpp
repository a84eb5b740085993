// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "simulated_gyro.hpp"

#include <cmath>

namespace street {

void SimulatedGyro::measure(const std::function<cv::Vec3d(double)>& trueRates, double begin, double end, cv::Mat& times,
                            cv::Mat& rates) const
{
    CV_Assert(rate > 0 && noise >= 0 && begin < end);
    const int count = int(std::ceil((end - begin) * rate)) + 1;
    times.create(count, 1, CV_64F);
    rates.create(count, 3, CV_64F);
    cv::RNG rng(seed * 2654435761u + 17);
    for (int i = 0; i < count; i++)
    {
        const double seconds = begin + i / rate;
        const cv::Vec3d shown = trueRates(seconds) + bias;
        times.at<double>(i) = seconds + delay;
        for (int k = 0; k < 3; k++)
            rates.at<double>(i, k) = shown[k] + rng.gaussian(noise);
    }
}

} // namespace street
