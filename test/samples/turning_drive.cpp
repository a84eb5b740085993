// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "turning_drive.hpp"

#include "opencv2/imgproc.hpp"
#include <cmath>

namespace opencv_test {

// A picture of the cylinder: as many pixels to the radian as the camera has.
static cv::Mat cylinderTexture()
{
    cv::RNG rng(3);
    cv::Mat noise(700, 2000, CV_8U), texture;
    rng.fill(noise, cv::RNG::UNIFORM, 0, 256);
    cv::GaussianBlur(noise, texture, cv::Size(), 2);
    cv::normalize(texture, texture, 0, 255, cv::NORM_MINMAX);
    return texture;
}

cv::Mat TurningDrive::frame(double time) const
{
    static const cv::Mat texture = cylinderTexture();
    const cv::Point2d centre((size.width - 1) / 2., (size.height - 1) / 2.);
    cv::Mat columns(size, CV_32F), rows(size, CV_32F), image;
    for (int y = 0; y < size.height; y++)
    {
        const double yaw = yawRate * CV_PI / 180 * (time + (y - centre.y) * readout / size.height);
        for (int x = 0; x < size.width; x++)
        {
            const double u = (x - centre.x) / focal, v = (y - centre.y) / focal;
            columns.at<float>(y, x) = float(texture.cols / 2. + focal * (std::atan(u) + yaw - 0.2));
            rows.at<float>(y, x) = float(texture.rows / 2. + focal * v / std::hypot(1, u));
        }
    }
    cv::remap(texture, image, columns, rows, cv::INTER_CUBIC);
    return image;
}

} // namespace opencv_test
