// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "obstacles.hpp"
#include "car_paint.hpp"
#include "texture.hpp"

#include <algorithm>
#include <cmath>

namespace street {

namespace {

const double CELL = 4; // metres of a stretch of the index
const double DEGREE = CV_PI / 180;

// The part of a ray within a box; the ends are narrowed.
bool clip(const cv::Vec3d& low, const cv::Vec3d& high, const cv::Vec3d& origin, const cv::Vec3d& ray, double& enter,
          double& leave)
{
    for (int k = 0; k < 3; k++)
    {
        const double a = (low[k] - origin[k]) / ray[k], b = (high[k] - origin[k]) / ray[k];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

} // namespace

Obstacles::Obstacles(double density, double from, double to, double room, unsigned seed) : from_(from)
{
    if (density <= 0 || room < 1.5) // nearer to the camera's way they would be in it
        return;
    cv::RNG rng(seed * 3266489917u + 4321);
    const double space = 100 / density;
    const bool wide = room >= 2.8;
    for (double u = from; u + space <= to; u += space)
    {
        const Kind kind = Kind(rng.uniform(wide ? CAR : POST, TRUNK + 1));
        if (kind == CAR)
            park(rng, u, space, room);
        else
            plant(rng, u, space, kind);
    }
    buildIndex();
}

void Obstacles::park(cv::RNG& rng, double u, double space, double room)
{
    const double length = rng.uniform(3.9, 4.5), width = rng.uniform(1.65, 1.75), height = rng.uniform(1.42, 1.58);
    // At the kerb, or on the pavement if the street is narrow.
    const double kerb = std::min(0.57, std::max(0.1, room - width - 1.2));
    const double begin = u + rng.uniform(0., 1.) * std::max(0., space - length);
    const double grey = rng.uniform(40., 200.);
    const double blue = grey * rng.uniform(0.7, 1.2), green = grey * rng.uniform(0.7, 1.1),
                 red = grey * rng.uniform(0.7, 1.2);
    const cv::Vec3f colour = cv::Vec3d(blue, green, red);
    const cv::Vec3d low(begin, -kerb - width, 0), high(begin + length, -kerb, height);
    const Obstacle car = {CAR, low, high, cv::Vec3d(), cv::Vec3d(), 0, colour};
    obstacles_.push_back(car);
}

void Obstacles::plant(cv::RNG& rng, double u, double space, Kind kind)
{
    const bool isTrunk = kind == TRUNK;
    const double radius = isTrunk ? rng.uniform(0.1, 0.175) : 0.05,
                 height = isTrunk ? rng.uniform(3., 5.) : rng.uniform(4., 6.);
    const double along = u + rng.uniform(0., 1.) * space, before = rng.uniform(0.3, 1.);
    const cv::Vec3d foot(along, -before, 0);
    const double lean = isTrunk ? std::max(-12., std::min(12., rng.gaussian(4))) * DEGREE : 0;
    const int direction = rng.uniform(0, 2); // along or across the street
    cv::Vec3d axis(0, 0, std::cos(lean));
    axis[direction] = std::sin(lean);
    const cv::Vec3d top = foot + axis * (height / axis[2]);
    const double reach = radius / axis[2]; // a leaning cylinder is wider where it is cut level
    Obstacle pole = {kind, foot, top, foot, axis, radius, cv::Vec3f()};
    for (int k = 0; k < 2; k++)
    {
        pole.low[k] = std::min(foot[k], top[k]) - reach;
        pole.high[k] = std::max(foot[k], top[k]) + reach;
    }
    const float grey = float(rng.uniform(50., 150.));
    pole.colour = isTrunk ? cv::Vec3f(grey * 0.6f, grey * 0.8f, grey * 0.9f) : cv::Vec3f(grey, grey, grey);
    obstacles_.push_back(pole);
}

void Obstacles::buildIndex()
{
    for (size_t i = 0; i < obstacles_.size(); i++)
    {
        const Obstacle& o = obstacles_[i];
        const size_t first = size_t(std::max(0., (o.low[0] - from_) / CELL)),
                     last = size_t(std::max(0., (o.high[0] - from_) / CELL));
        cells_.resize(std::max(cells_.size(), last + 1));
        for (size_t c = first; c <= last; c++)
            cells_[c].push_back(int(i));
        for (int k = 0; k < 3; k++)
        {
            low_[k] = i == 0 ? o.low[k] : std::min(low_[k], o.low[k]);
            high_[k] = i == 0 ? o.high[k] : std::max(high_[k], o.high[k]);
        }
    }
}

bool Obstacles::meet(const Obstacle& obstacle, const cv::Vec3d& origin, const cv::Vec3d& ray, double& distance)
{
    double enter = 0, leave = distance;
    if (!clip(obstacle.low, obstacle.high, origin, ray, enter, leave))
        return false;
    if (obstacle.kind != CAR)
    {
        // Ray and foot as seen along the axis: there the cylinder is a circle.
        const cv::Vec3d offset = origin - obstacle.foot;
        const cv::Vec3d across = ray - obstacle.axis * obstacle.axis.dot(ray),
                        from = offset - obstacle.axis * obstacle.axis.dot(offset);
        const double a = across.dot(across), b = across.dot(from),
                     c = from.dot(from) - obstacle.radius * obstacle.radius;
        const double discriminant = b * b - a * c;
        if (discriminant < 0)
            return false;
        const double at = (-b - std::sqrt(discriminant)) / a;
        // The box ends where the cylinder ends, at its foot and top.
        if (!(at >= enter && at <= leave))
            return false;
        enter = at;
    }
    distance = enter;
    return true;
}

int Obstacles::cast(const cv::Vec3d& origin, const cv::Vec3d& ray, double& distance) const
{
    double enter = 0, leave = distance;
    if (obstacles_.empty() || !clip(low_, high_, origin, ray, enter, leave))
        return -1;
    auto cellAt = [&](double at) { return int((origin[0] + ray[0] * at - from_) / CELL); };
    const int count = int(cells_.size()), step = ray[0] > 0 ? 1 : -1;
    int nearest = -1, last = cellAt(leave);
    for (int c = std::max(0, std::min(count - 1, cellAt(enter))); c >= 0 && c < count && (last - c) * step >= 0;
         c += step)
        for (int i : cells_[c])
            if (meet(obstacles_[i], origin, ray, distance))
            {
                nearest = i;
                last = cellAt(distance);
            }
    return nearest;
}

cv::Vec3f Obstacles::sample(int obstacle, const cv::Vec3d& place, double footprint) const
{
    const Obstacle& o = obstacles_[obstacle];
    if (o.kind == CAR)
        return sampleCar(place - o.low, o.high - o.low, o.colour);
    cv::Vec3d normal = place - o.foot;
    normal -= o.axis * o.axis.dot(normal);
    normal *= 1 / o.radius;
    cv::Vec3f colour = o.colour * (0.75 - 0.3 * normal[1]); // the light comes from the street
    if (o.kind == TRUNK)                                    // bark
    {
        const double grain = 0.03, around = std::atan2(normal[1], normal[0]) * o.radius;
        const int column = int(std::floor(around / grain)), row = int(std::floor(place[2] / (6 * grain)));
        colour *= 1 + 0.5 * visibility(grain, footprint) * (cellNoise(column, row) - 0.5);
    }
    return colour;
}

} // namespace street
