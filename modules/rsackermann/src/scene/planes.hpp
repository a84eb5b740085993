// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SCENE_PLANES_HPP
#define OPENCV_RSACKERMANN_SRC_SCENE_PLANES_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace cv { namespace rsackermann {

/** The three planes of the scene (doc/theory.md, "Depth"): scaled inverse depth w, linear on every plane.

Directions behind every plane are at infinity (w = 0). All w have the sign of the speed.
*/
struct Scene
{
    enum Plane { INFINITE = 0, LEFT_WALL = 1, RIGHT_WALL = 2, ROAD = 3, PLANES = 4 };

    double B, D, lambda, G;
    double direction; // 1 forward, -1 reverse

    Scene() : B(0), D(0), lambda(0), G(0), direction(1) {}
    explicit Scene(const AckermannMotion& m)
        : B(m.wallSlope), D(m.wallOffset), lambda(m.wallRatio), G(m.roadSlope), direction(m.direction < 0 ? -1 : 1)
    {
    }

    /** w z of the nearest plane, for the point that a camera at another place than the global-shutter camera's sees in
    the direction (x, y, z), which has any scale and needn't point forward.

    The place is (x, z) in the unit of length in which depths are 1/w, inside the walls (isInside). The global-shutter
    camera sees the point in the direction ray + inverseDepth(...) (place.x, 0, place.z).
    @param added to the w z of each plane at the point that is seen.
    */
    double inverseDepth(const Vec3d& ray, double placeX = 0, double placeZ = 0, double added = 0) const
    {
        double planes[PLANES];
        inverseDepths(ray, placeX, placeZ, planes, added);
        return nearestOf(planes[INFINITE], planes[LEFT_WALL], planes[RIGHT_WALL], planes[ROAD]);
    }

    //! The same for each Plane, whether or not another one hides it.
    void inverseDepths(const Vec3d& ray, double placeX, double placeZ, double planes[PLANES], double added = 0) const
    {
        const double left = D * ray[2] - B * ray[0];
        const double passed = D * placeZ - B * placeX;
        planes[INFINITE] = added;
        planes[LEFT_WALL] = (left + added) / (1 - passed);
        planes[RIGHT_WALL] = (-lambda * left + added) / (1 + lambda * passed);
        planes[ROAD] = G * ray[1] + added;
    }

    //! Whether a camera at that place hasn't passed a wall. The planes never hide one another from such a place.
    bool isInside(double placeX, double placeZ) const
    {
        const double passed = D * placeZ - B * placeX;
        return passed < 1 && -lambda * passed < 1;
    }

private:
    double nearestOf(double infinite, double left, double right, double road) const
    {
        const double w = std::max(std::max(direction * left, direction * right), direction * road);
        return direction * std::max(w, direction * infinite);
    }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SCENE_PLANES_HPP
