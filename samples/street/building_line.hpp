// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_BUILDING_LINE_HPP
#define RSACKERMANN_SAMPLES_BUILDING_LINE_HPP

#include "facade.hpp"

namespace street {

/** How far each house stands back from the plane of its row.

Places are (u, w, v): u metres along the street, w metres behind the plane of the row, v metres above the road.
*/
class BuildingLine
{
public:
    /** @param houses of the row.
        @param stagger largest distance of a house from the plane in metres.
        @param seed of the random numbers. */
    BuildingLine(const std::vector<Facade::House>& houses, double stagger, unsigned seed);

    /** The first house that a ray from within the street meets.
        @param distance in lengths of the ray; things farther than its value at the call aren't met.
        @param gable whether the side of the house is met and not its front.
        @return the house's number, or -1. */
    int cast(const cv::Vec3d& origin, const cv::Vec3d& ray, double& distance, bool& gable) const;

private:
    struct Block
    {
        double u0, u1, height, setback;
    };

    std::vector<Block> blocks_;
    double depth_; // of the houses
};

} // namespace street

#endif // RSACKERMANN_SAMPLES_BUILDING_LINE_HPP
