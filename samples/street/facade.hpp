// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_FACADE_HPP
#define RSACKERMANN_SAMPLES_FACADE_HPP

#include "opencv2/core.hpp"
#include <vector>

namespace street {

/** A row of houses, painted on a plane: u metres along the street, v metres above the road.

The paint is a list of parallelograms with horizontal upper and lower sides; later ones cover earlier ones.
*/
class Facade
{
public:
    struct House
    {
        double u0, u1, height;
        cv::Vec3f colour; // of the wall
        bool bricks;
    };

    /** @param seed of the random numbers.
        @param clutter share of windows, doors and pipes that are slanted instead of upright.
        @param brightness of the whole wall. */
    Facade(unsigned seed, double clutter, double brightness);

    /** Colour (BGR, 0..255) at a place.
        @param footprint size of a pixel on the wall in metres: finer details fade away.
        @param colour result.
        @return false above the roof. */
    bool sample(double u, double v, double footprint, cv::Vec3f& colour) const;

    //! The houses in the order of u, without gaps.
    const std::vector<House>& houses() const { return houses_; }

    //! Colour of the side of a house, depth metres behind the plane of the facades.
    cv::Vec3f sampleGable(int house, double depth, double v, double footprint) const;

private:
    struct Patch
    {
        double u0, u1, v0, v1;
        double slant; // metres along u per metre of height above v0
        cv::Vec3f colour;
        bool bricks;
    };

    void paint(double u0, double u1, double v0, double v1, const cv::Vec3f& colour, bool bricks = false);
    void paintHouse(cv::RNG& rng, double u0, double u1, double height);
    void paintOpening(cv::RNG& rng, double u0, double u1, double v0, double v1, const cv::Vec3f& frame, bool sill);
    void drawSlant(cv::RNG& rng);
    void buildIndex();

    double clutter_, brightness_;
    double slant_; // of the patches being painted
    std::vector<House> houses_;
    std::vector<Patch> patches_;
    std::vector<std::vector<int>> cells_; // patches that touch a cell of one square metre
};

//! Colour of the road at u metres along it and a metres to the right of its left kerb, if the road is width metres
//! wide.
cv::Vec3f sampleRoad(double u, double a, double width, double footprint);

} // namespace street

#endif // RSACKERMANN_SAMPLES_FACADE_HPP
