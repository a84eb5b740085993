// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "texture.hpp"

#include <algorithm>
#include <cmath>

namespace street {

double cellNoise(int a, int b)
{
    unsigned h = unsigned(a) * 0x9E3779B1u ^ (unsigned(b) * 0x85EBCA77u + 0xC2B2AE3Du);
    h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
    h = (h ^ (h >> 12)) * 0x297A2D39u;
    return (h ^ (h >> 15)) * (1 / 4294967296.);
}

double visibility(double size, double footprint)
{
    return std::min(1., std::max(0., 1.5 - footprint / size));
}

double bricks(double u, double v, double footprint)
{
    const double length = 0.24, course = 0.083, joint = 0.012;
    const double visible = visibility(course / 2, footprint);
    if (visible <= 0)
        return 0;
    const int row = int(std::floor(v / course));
    const double shifted = u + (row & 1) * length / 2;
    const int column = int(std::floor(shifted / length));
    const bool inJoint = v - row * course < joint || shifted - column * length < joint;
    return visible * (inJoint ? 0.15 : 0.12 * (cellNoise(column, row) - 0.5) - 0.03);
}

// Random numbers at the corners of a grid of unit cells, and smoothly between them; on average 0.
static double smoothNoise(double u, double v)
{
    const double fu = std::floor(u), fv = std::floor(v);
    const int a = int(fu), b = int(fv);
    const double x = u - fu, y = v - fv, s = x * x * (3 - 2 * x), t = y * y * (3 - 2 * y);
    return (cellNoise(a, b) * (1 - s) + cellNoise(a + 1, b) * s) * (1 - t) +
           (cellNoise(a, b + 1) * (1 - s) + cellNoise(a + 1, b + 1) * s) * t - 0.5;
}

double stains(double u, double v, double footprint)
{
    const double smallest = 0.04, largest = 1.3;
    double sum = 0;
    for (double size = smallest; size < largest; size *= 2)
    {
        const double visible = visibility(size / 3, footprint);
        if (visible > 0)
            sum += visible * smoothNoise(u / size, v / size);
    }
    return sum;
}

} // namespace street
