// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "street_side.hpp"

namespace street {

StreetSide::StreetSide(const Facade& facade, double room, double stagger, double obstacles, unsigned seed)
    : facade_(facade), line_(facade.houses(), stagger, seed),
      obstacles_(obstacles, facade.houses().front().u0, facade.houses().back().u1, room, seed)
{
}

bool StreetSide::cast(const cv::Vec3d& origin, const cv::Vec3d& ray, double& distance, Surface& surface) const
{
    bool gable = false;
    const int house = line_.cast(origin, ray, distance, gable), obstacle = obstacles_.cast(origin, ray, distance);
    if (obstacle >= 0)
        surface = {Surface::OBSTACLE, obstacle};
    else if (house >= 0)
        surface = {gable ? Surface::GABLE : Surface::FRONT, house};
    return obstacle >= 0 || house >= 0;
}

bool StreetSide::sample(const Surface& surface, const cv::Vec3d& place, double footprint, cv::Vec3f& colour) const
{
    switch (surface.kind)
    {
    case Surface::FRONT:
        return facade_.sample(place[0], place[2], footprint, colour);
    case Surface::GABLE:
        colour = facade_.sampleGable(surface.number, place[1], place[2], footprint);
        return true;
    case Surface::OBSTACLE:
        colour = obstacles_.sample(surface.number, place, footprint);
        return true;
    case Surface::NOTHING:
        break;
    }
    return false;
}

} // namespace street
