// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DISTORTER_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DISTORTER_HPP

#include "../camera/rays.hpp"
#include "shutter.hpp"

namespace cv {
namespace rsackermann {

/** Finds the ray of the global-shutter camera to the point that a raw pixel sees, in closed form (doc/theory.md, "Warp").

Of the planes the nearest along the ray is seen; a ray that meets none sees a point at infinity (w = 0). The planes
surround the camera without hiding one another until it passes a wall; a row at whose instant it would have done so sees
nothing.
*/
class Distorter
{
public:
    Distorter(const RollingShutterCamera& camera_, const Shutter& shutter_) : camera(camera_), shutter(shutter_) {}

    //! Rays of raw pixels; (NaN, NaN) where the lens has none.
    void undistort(const std::vector<Point2d>& raw, std::vector<Point2d>& rays) const
    {
        undistortedRays(camera, raw, rays);
        if (shutter.lens.kind == Lens<double>::NONE)
            return;
        // The inverse of the lens model is found by iteration, which goes astray outside of the image of the lens.
        const double tolerance = 1e-3;
        for (size_t i = 0; i < raw.size(); i++)
        {
            Point2d back;
            if (!shutter.project(Vec3d(rays[i].x, rays[i].y, 1), back) || !(norm(back - raw[i]) < tolerance))
                rays[i] = Point2d(NAN, NAN);
        }
    }

    //! Ray of the global-shutter camera to the point of the planes that a raw pixel sees; false where there is none.
    bool solve(const Point2d& raw, const Point2d& rawRay, Vec3d& ray) const
    {
        ray = Vec3d(rawRay.x, rawRay.y, 1);
        if (shutter.moving)
        {
            const RowMotion m = shutter.motionAt(shutter.rowTime(raw));
            if (!shutter.isInside(m))
                return false;
            const Vec3d a = Shutter::turnBack(shutter.up * ray, m);
            const double w = shutter.scene.inverseDepth(a, m.tau * m.s2, m.tau * m.c2);
            ray = shutter.down * Shutter::moveBack(a, w, m);
        }
        return ray[2] > 0;
    }

    /** The same for a point of known depth.
    @param raw pixel.
    @param rawRay its ray.
    @param inverseDepth of the point along the optical axis of the global-shutter camera, times the way per unit of row
    time; negative in reverse.
    @param ray receives the ray.
    */
    bool solve(const Point2d& raw, const Point2d& rawRay, double inverseDepth, Vec3d& ray) const
    {
        ray = Vec3d(rawRay.x, rawRay.y, 1);
        if (!shutter.moving)
            return true;
        // The depth of the bearing a + w tau (s2, 0, c2) is w / inverseDepth, which is linear in w.
        const RowMotion m = shutter.motionAt(shutter.rowTime(raw));
        const Vec3d a = Shutter::turnBack(shutter.up * ray, m);
        const double approach = 1 - m.tau * (shutter.down * Vec3d(m.s2, 0, m.c2))[2] * inverseDepth;
        if (!(approach > 0))
            return false;
        const double w = inverseDepth * (shutter.down * a)[2] / approach;
        ray = shutter.down * Shutter::moveBack(a, w, m);
        return ray[2] > 0;
    }

private:
    const RollingShutterCamera& camera;
    const Shutter& shutter;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DISTORTER_HPP
