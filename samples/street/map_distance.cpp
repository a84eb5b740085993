// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "map_distance.hpp"

namespace rsackermann_samples {

cv::Mat placesOf(const cv::Mat& columns, const cv::Mat& rows)
{
    const float none = -16384; // in both maps, see cv::rsackermann::WarpMapGenerator::initRectifyMap
    return (columns != none) | (rows != none);
}

double meanDistance(const cv::Mat& columns1, const cv::Mat& rows1, const cv::Mat& columns2, const cv::Mat& rows2,
                    const cv::Mat& mask)
{
    cv::Mat distance;
    cv::magnitude(columns1 - columns2, rows1 - rows2, distance);
    return cv::mean(distance, mask & placesOf(columns1, rows1) & placesOf(columns2, rows2))[0];
}

void identityMaps(const cv::Size& size, cv::Mat& columns, cv::Mat& rows)
{
    columns.create(size, CV_32FC1);
    rows.create(size, CV_32FC1);
    for (int y = 0; y < size.height; y++)
        for (int x = 0; x < size.width; x++)
        {
            columns.at<float>(y, x) = float(x);
            rows.at<float>(y, x) = float(y);
        }
}

} // namespace rsackermann_samples
