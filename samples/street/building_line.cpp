// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "building_line.hpp"

#include <algorithm>
#include <limits>

namespace street {

BuildingLine::BuildingLine(const std::vector<Facade::House>& houses, double stagger, unsigned seed)
    : depth_(stagger > 0 ? 10 : 0) // houses in line are the painted plane alone: they have no sides to be seen
{
    cv::RNG rng(seed * 2246822519u + 6789);
    for (const Facade::House& house : houses)
    {
        const Block block = {house.u0, house.u1, house.height, rng.uniform(0., 1.) * stagger};
        blocks_.push_back(block);
    }
}

int BuildingLine::cast(const cv::Vec3d& origin, const cv::Vec3d& ray, double& distance, bool& gable) const
{
    if (origin[1] >= 0 || ray[1] <= 0)
        return -1;
    double enter = -origin[1] / ray[1]; // where the ray comes to the land of a house
    const double end = std::min(distance, (depth_ - origin[1]) / ray[1]), u = origin[0] + ray[0] * enter;
    const std::vector<Block>::const_iterator first =
        std::upper_bound(blocks_.begin(), blocks_.end(), u, [](double value, const Block& b) { return value < b.u1; });
    if (first == blocks_.end() || u < first->u0)
        return -1;
    for (int i = int(first - blocks_.begin()); i >= 0 && i < int(blocks_.size()) && enter <= end;
         i += ray[0] > 0 ? 1 : -1)
    {
        const Block& block = blocks_[i];
        const double front = (block.setback - origin[1]) / ray[1], at = std::max(front, enter);
        const double border = (ray[0] > 0 ? block.u1 : block.u0) - origin[0];
        const double leave = ray[0] == 0 ? std::numeric_limits<double>::infinity() : border / ray[0];
        // Whoever is above the roof stays there: the camera is lower.
        if (at <= std::min(leave, end) && origin[2] + ray[2] * at < block.height)
        {
            distance = at;
            gable = enter > front;
            return i;
        }
        enter = leave;
    }
    return -1;
}

} // namespace street
