// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "facade.hpp"
#include "texture.hpp"

#include <algorithm>
#include <cmath>

namespace street {

namespace {

const double FIRST = -40, LAST = 260, TOP = 20; // extent of the facades in metres
const int COLUMNS = int(LAST - FIRST), ROWS = int(TOP);

cv::Vec3f randomColour(cv::RNG& rng, double low, double high)
{
    const float grey = float(rng.uniform(low, high));
    // Not as arguments, whose order is the compiler's choice: a street is to look the same whatever compiled it.
    const float red = grey * float(rng.uniform(0.95, 1.15)), green = grey * float(rng.uniform(0.9, 1.05)),
                blue = grey * float(rng.uniform(0.75, 1.05));
    return cv::Vec3f(blue, green, red);
}

} // namespace

Facade::Facade(unsigned seed, double clutter, double brightness) : clutter_(clutter), brightness_(brightness), slant_(0)
{
    cv::RNG rng(seed * 2654435761u + 12345);
    double u = FIRST;
    while (u < LAST)
    {
        const double end = std::min(LAST, u + rng.uniform(4.5, 11.));
        paintHouse(rng, u, end, rng.uniform(8., 16.));
        u = end;
    }
    buildIndex();
}

void Facade::paint(double u0, double u1, double v0, double v1, const cv::Vec3f& colour, bool isBrick)
{
    const Patch patch = {u0, u1, v0, v1, slant_, colour * brightness_, isBrick};
    patches_.push_back(patch);
}

void Facade::drawSlant(cv::RNG& rng)
{
    const double magnitude = rng.uniform(0.03, 0.3), side = rng.uniform(0, 2) ? 1 : -1;
    slant_ = rng.uniform(0., 1.) < clutter_ ? side * magnitude : 0;
}

void Facade::paintOpening(cv::RNG& rng, double u0, double u1, double v0, double v1, const cv::Vec3f& frame, bool sill)
{
    drawSlant(rng);
    const double surround = rng.uniform(0.06, 0.16), bar = 0.05;
    paint(u0 - surround, u1 + surround, v0 - (sill ? 0.1 : 0), v1 + surround, frame);
    const cv::Vec3f glass = randomColour(rng, 20, 75);
    const int across = rng.uniform(1, 4), up = sill ? rng.uniform(1, 4) : 1;
    const double width = (u1 - u0 + bar) / across, height = (v1 - v0 + bar) / up;
    const double slant = slant_;
    for (int i = 0; i < across; i++)
        for (int j = 0; j < up; j++)
        {
            // Panes lean with their window: each begins where the slanted frame has come to.
            const double shift = slant * (j * height + (sill ? 0.1 : 0));
            paint(u0 + i * width + shift, u0 + (i + 1) * width - bar + shift, v0 + j * height,
                  v0 + (j + 1) * height - bar, glass * rng.uniform(0.8, 1.2));
        }
    slant_ = 0;
    if (sill)
        paint(u0 - 0.2, u1 + 0.2, v0 - 0.2, v0 - 0.1, frame * 0.75);
}

void Facade::paintHouse(cv::RNG& rng, double u0, double u1, double height)
{
    const cv::Vec3f wall = randomColour(rng, 90, 190), frame = rng.uniform(0, 2) ? wall * 1.3 : wall * 0.6;
    const double ground = rng.uniform(2.9, 3.6), storey = rng.uniform(2.6, 3.2), plinth = rng.uniform(0.3, 0.7);
    const bool isBrick = rng.uniform(0, 3) > 0;
    const House house = {u0, u1, height, wall, isBrick};
    houses_.push_back(house);
    paint(u0, u1, 0, height, wall, isBrick);
    paint(u0, u1, 0, plinth, wall * 0.65);
    paint(u0, u1, height - 0.35, height, wall * 0.7);
    paint(u0, u1, ground - 0.15, ground, wall * 1.2);

    drawSlant(rng);
    paint(u0 + 0.1, u0 + 0.22, 0, height, wall * 0.45); // pipe for the rain
    slant_ = 0;

    const int bays = std::max(1, int((u1 - u0 - 0.5) / rng.uniform(1.4, 2.3)));
    const double bay = (u1 - u0 - 0.5) / bays;
    const double narrow = rng.uniform(0.45, 0.7) * bay;
    const int door = rng.uniform(0, bays);
    for (int i = 0; i < bays; i++)
    {
        const double middle = u0 + 0.4 + (i + 0.5) * bay;
        const double half = 0.5 * (rng.uniform(0, 3) ? narrow : 0.75 * bay);
        if (i == door)
            paintOpening(rng, middle - 0.5, middle + 0.5, 0, rng.uniform(2.1, 2.5), frame, false);
        else
        {
            const double top = ground - rng.uniform(0.4, 0.7), bottom = plinth + rng.uniform(0.1, 0.4);
            paintOpening(rng, middle - half, middle + half, bottom, top, frame, true);
        }
        const double windowHeight = rng.uniform(1.3, 1.8);
        for (double v = ground + 0.7; v + windowHeight + 0.6 < height; v += storey)
            paintOpening(rng, middle - narrow / 2, middle + narrow / 2, v, v + windowHeight, frame, true);
    }
}

void Facade::buildIndex()
{
    cells_.resize(size_t(COLUMNS) * ROWS);
    for (size_t i = 0; i < patches_.size(); i++)
    {
        const Patch& p = patches_[i];
        const double shift = p.slant * (p.v1 - p.v0);
        const int c0 = std::max(0, int(p.u0 + std::min(0., shift) - FIRST)),
                  c1 = std::min(COLUMNS - 1, int(p.u1 + std::max(0., shift) - FIRST));
        const int r0 = std::max(0, int(p.v0)), r1 = std::min(ROWS - 1, int(p.v1));
        for (int r = r0; r <= r1; r++)
            for (int c = c0; c <= c1; c++)
                cells_[size_t(r) * COLUMNS + c].push_back(int(i));
    }
}

bool Facade::sample(double u, double v, double footprint, cv::Vec3f& colour) const
{
    if (!(u >= FIRST && u < LAST && v >= 0 && v < TOP))
        return false;
    const std::vector<int>& cell = cells_[size_t(v) * COLUMNS + size_t(u - FIRST)];
    for (std::vector<int>::const_reverse_iterator it = cell.rbegin(); it != cell.rend(); ++it)
    {
        const Patch& p = patches_[*it];
        if (v < p.v0 || v >= p.v1)
            continue;
        const double along = u - p.slant * (v - p.v0);
        if (along < p.u0 || along >= p.u1)
            continue;
        colour = p.bricks ? p.colour * (1 + bricks(u, v, footprint)) : p.colour;
        return true;
    }
    return false;
}

cv::Vec3f Facade::sampleGable(int house, double depth, double v, double footprint) const
{
    // Darker than the front, as a wall that the sun doesn't reach: the corner between the two is an edge.
    const House& h = houses_[house];
    const cv::Vec3f colour = h.colour * (0.75f * brightness_);
    return h.bricks ? colour * (1 + bricks(depth, v, footprint)) : colour;
}

cv::Vec3f sampleRoad(double u, double a, double width, double footprint)
{
    const double pavement = 0.45, kerb = 0.12;
    const double side = std::min(a, width - a); // distance from the nearer wall
    cv::Vec3f colour;
    if (side < pavement) // slabs with joints across
    {
        colour = cv::Vec3f(150, 155, 158);
        const double slab = 0.8, along = u / slab - std::floor(u / slab);
        if (along * slab < 0.03)
            colour *= 1 - 0.3 * visibility(0.1, footprint);
        colour *= 1 + 0.08 * (cellNoise(int(std::floor(u / slab)), a < width / 2) - 0.5);
        return colour;
    }
    if (side < pavement + kerb)
        return cv::Vec3f(205, 205, 200);
    colour = cv::Vec3f(78, 76, 74);
    const double grain = 0.04;
    colour *= 1 + 0.15 * visibility(grain, footprint) *
                      (cellNoise(int(std::floor(u / grain)), int(std::floor(a / grain))) - 0.5);
    const double period = 4.5, phase = u / period - std::floor(u / period);
    const bool centreLine = std::abs(a - width / 2) < 0.06 && phase < 0.6;
    const bool edgeLine = side > pavement + kerb + 0.18 && side < pavement + kerb + 0.28;
    if (centreLine || edgeLine)
        colour = cv::Vec3f(225, 228, 228);
    return colour;
}

} // namespace street
