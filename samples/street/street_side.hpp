// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_STREET_SIDE_HPP
#define RSACKERMANN_SAMPLES_STREET_SIDE_HPP

#include "building_line.hpp"
#include "obstacles.hpp"

namespace street {

/** One side of a street: a row of houses and the obstacles before them.

Places are (u, w, v): u metres along the street, w metres behind the plane of the row, v metres above the road.
*/
class StreetSide
{
public:
    //! The thing that is met at the side of the street.
    struct Surface
    {
        enum Kind {
            FRONT, // of a house
            GABLE, // side of a house
            OBSTACLE,
            NOTHING // the sky
        };
        Kind kind;
        int number; // of the house or obstacle
    };

    /** @param facade of the houses.
        @param room metres between the plane of the row and the camera's way.
        @param stagger largest distance of a house from the plane in metres.
        @param obstacles number on 100 m.
        @param seed of the random numbers. */
    StreetSide(const Facade& facade, double room, double stagger, double obstacles, unsigned seed);

    /** The first surface that a ray meets.
        @param distance in lengths of the ray; things farther than its value at the call aren't met.
        @return whether there is one; surface and distance stay as they are otherwise. */
    bool cast(const cv::Vec3d& origin, const cv::Vec3d& ray, double& distance, Surface& surface) const;

    //! Colour (BGR, 0..255) of a surface at a place; false if the sky is seen.
    bool sample(const Surface& surface, const cv::Vec3d& place, double footprint, cv::Vec3f& colour) const;

private:
    Facade facade_;
    BuildingLine line_;
    Obstacles obstacles_;
};

} // namespace street

#endif // RSACKERMANN_SAMPLES_STREET_SIDE_HPP
