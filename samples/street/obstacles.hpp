// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_OBSTACLES_HPP
#define RSACKERMANN_SAMPLES_OBSTACLES_HPP

#include "opencv2/core.hpp"
#include <vector>

namespace street {

/** Parked cars, posts and leaning trunks of trees between the street and a row of houses.

Places are (u, w, v): u metres along the street, w metres behind the plane of the row, v metres above the road.
*/
class Obstacles
{
public:
    /** @param density number of obstacles on 100 m.
        @param from, to extent of the row along the street in metres.
        @param room metres between the plane of the row and the camera's way. Cars park only if 2.8 m are there: they
       would stand in the way otherwise.
        @param seed of the random numbers. */
    Obstacles(double density, double from, double to, double room, unsigned seed);

    /** The first obstacle that a ray meets.
        @param distance in lengths of the ray; things farther than its value at the call aren't met.
        @return the obstacle's number, or -1. */
    int cast(const cv::Vec3d& origin, const cv::Vec3d& ray, double& distance) const;

    //! Colour (BGR, 0..255) of an obstacle at a place on it.
    cv::Vec3f sample(int obstacle, const cv::Vec3d& place, double footprint) const;

private:
    enum Kind { CAR, POST, TRUNK };

    struct Obstacle
    {
        Kind kind;
        cv::Vec3d low, high;  // corners of the box around it; a car fills its box
        cv::Vec3d foot, axis; // of a post or trunk; the axis has length 1
        double radius;
        cv::Vec3f colour;
    };

    void park(cv::RNG& rng, double u, double space, double room);
    void plant(cv::RNG& rng, double u, double space, Kind kind);
    void buildIndex();
    static bool meet(const Obstacle& obstacle, const cv::Vec3d& origin, const cv::Vec3d& ray, double& distance);

    double from_;
    cv::Vec3d low_, high_; // corners of the box around all
    std::vector<Obstacle> obstacles_;
    std::vector<std::vector<int>> cells_; // obstacles that touch a stretch of the street
};

} // namespace street

#endif // RSACKERMANN_SAMPLES_OBSTACLES_HPP
