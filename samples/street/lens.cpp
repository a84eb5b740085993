// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "lens.hpp"

#include <cmath>

namespace street {

cv::Point2d distortPoint(const std::vector<double>& lens, const cv::Point2d& ideal)
{
    if (lens.empty())
        return ideal;
    double k[8] = {0};
    for (size_t i = 0; i < lens.size() && i < 8; i++)
        k[i] = lens[i];
    const double x = ideal.x, y = ideal.y, r2 = x * x + y * y;
    const double radial = (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / (1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
    return cv::Point2d(x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x),
                       y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y);
}

cv::Point2d undistortPoint(const std::vector<double>& lens, const cv::Point2d& distorted)
{
    if (lens.empty())
        return distorted;
    cv::Point2d p = distorted;
    for (int i = 0; i < 20; i++)
    {
        const double h = 1e-6;
        const cv::Point2d f = distortPoint(lens, p) - distorted;
        const cv::Point2d dx =
            (distortPoint(lens, p + cv::Point2d(h, 0)) - distortPoint(lens, p - cv::Point2d(h, 0))) * (0.5 / h);
        const cv::Point2d dy =
            (distortPoint(lens, p + cv::Point2d(0, h)) - distortPoint(lens, p - cv::Point2d(0, h))) * (0.5 / h);
        const double det = dx.x * dy.y - dy.x * dx.y;
        const cv::Point2d step((f.x * dy.y - dy.x * f.y) / det, (dx.x * f.y - f.x * dx.y) / det);
        p -= step;
        if (std::abs(step.x) + std::abs(step.y) < 1e-12)
            break;
    }
    return p;
}

} // namespace street
