// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "car_paint.hpp"

#include <algorithm>
#include <cmath>

namespace street {

namespace {

const cv::Vec3f GLASS(62, 52, 45), RUBBER(25, 25, 25), SHADE(38, 37, 36);
const double SILL = 0.9; // metres of the windows' lower sides above the road

cv::Vec3f sampleSide(double x, double v, double length, double height, const cv::Vec3f& body)
{
    for (double axle : {0.17 * length, 0.8 * length})
    {
        const double r = std::hypot(x - axle, v - 0.3);
        if (r < 0.3)
            return r < 0.18 ? cv::Vec3f(140, 140, 140) : RUBBER;
    }
    if (v < 0.22)
        return SHADE;
    // Windows lean inwards at both ends and have an upright pillar in the middle.
    const double above = v - SILL, from = 0.12 * length + 0.7 * above, to = 0.8 * length - 0.9 * above;
    if (above > 0 && v < height - 0.12 && x > from && x < to && std::abs(x - 0.46 * length) > 0.05)
        return GLASS;
    const bool gap = v > 0.3 && v < SILL && (std::abs(x - 0.46 * length) < 0.012 || std::abs(x - 0.7 * length) < 0.012);
    return gap || std::abs(v - 0.55) < 0.02 ? body * 0.5 : body;
}

cv::Vec3f sampleEnd(double w, double v, double width, double height, const cv::Vec3f& body)
{
    const double side = std::min(w, width - w); // distance from the nearer side
    if (v < 0.22)
        return side < 0.22 ? RUBBER : SHADE;
    if (v < 0.5)
        // Plate and bumper
        return std::abs(w - width / 2) < 0.26 && v > 0.33 && v < 0.45 ? cv::Vec3f(215, 220, 220) : body * 0.55;
    if (v > SILL && v < height - 0.1)
        return side > 0.12 + 0.3 * (v - SILL) ? GLASS : body * 0.85;
    return side < 0.16 && v > 0.62 && v < 0.85 ? cv::Vec3f(45, 40, 170) : body * 0.85; // lamps
}

} // namespace

cv::Vec3f sampleCar(const cv::Vec3d& place, const cv::Vec3d& size, const cv::Vec3f& body)
{
    const double side = std::min(place[1], size[1] - place[1]), end = std::min(place[0], size[0] - place[0]),
                 roof = size[2] - place[2];
    if (roof < std::min(side, end))
        return body * 1.1;
    return side < end ? sampleSide(place[0], place[2], size[0], size[2], body)
                      : sampleEnd(place[1], place[2], size[1], size[2], body);
}

} // namespace street
