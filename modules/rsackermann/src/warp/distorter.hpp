// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DISTORTER_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DISTORTER_HPP

#include "shutter_geometry.hpp"

namespace cv { namespace rsackermann {

/** Finds the ray of the global-shutter camera to the point that a raw pixel sees, in closed form unless there is an
inverse-depth offset (doc/theory.md, "Warp").

Of the planes the nearest along the ray is seen; a ray that meets none sees a point at infinity (w = 0, and the offset).
The planes
surround the camera without hiding one another until it passes a wall; a row at whose instant it would have done so sees
nothing.
*/
class Distorter
{
public:
    explicit Distorter(const ShutterGeometry& shutter_) : shutter(shutter_) {}

    //! The view of a raw pixel, whatever its depth.
    struct View
    {
        Vec3d direction; // bearing in the orientation of the global-shutter camera
        double x, z;     // place of the camera
    };

    //! The view of a raw pixel of known depth; false if there is none.
    bool viewOfKnown(const Point2d& raw, View& v) const
    {
        Vec3d ray;
        if (!undistort(raw, ray))
            return false;
        v.direction = shutter.up * ray;
        v.x = v.z = 0;
        if (!shutter.moving)
            return true;
        const double t = shutter.rowTime(raw);
        const RowMotion m = shutter.motionAt(t);
        v.direction = ShutterGeometry::rotateBack(shutter.tiltBack(v.direction, t), m);
        v.x = m.tau * m.s2;
        v.z = m.tau * m.c2;
        return true;
    }

    //! The same of a pixel that sees one of the planes, which the camera must not have passed.
    bool view(const Point2d& raw, View& v) const
    {
        return viewOfKnown(raw, v) && (!shutter.moving || shutter.scene.isInside(v.x, v.z));
    }

    //! Ray of the global-shutter camera to the point of a view that has the scaled inverse depth w; false if it is
    //! behind.
    bool rayTo(const View& v, double w, Vec3d& ray) const
    {
        ray = shutter.down * (v.direction + Vec3d(w * v.x, 0, w * v.z));
        return ray[2] > 0;
    }

    /** The scaled inverse depth of the scene in a view; false if there is none.

    The offset says by how much the point is nearer at the place where the global-shutter camera sees it, which depends
    on that: a fixed point. It is a contraction unless the offset is steep; then the pixel sees nothing. */
    bool findInverseDepth(const View& v, double& w) const
    {
        const int iterations = 30;
        const double enough = 1e-13;
        w = shutter.scene.inverseDepth(v.direction, v.x, v.z);
        if (shutter.depthOffset.empty())
            return true;
        for (int i = 0; i < iterations; i++)
        {
            const double last = w, added = shutter.depthOffset.at(v.direction + Vec3d(w * v.x, 0, w * v.z));
            w = shutter.scene.inverseDepth(v.direction, v.x, v.z, added);
            if (std::abs(w - last) <= enough * (1 + std::abs(w)))
                return true;
        }
        return false;
    }

    //! Ray of the global-shutter camera to the point of the planes that a raw pixel sees; false if there is none.
    bool solve(const Point2d& raw, Vec3d& ray) const
    {
        View v;
        double w = 0;
        return view(raw, v) && (!shutter.moving || findInverseDepth(v, w)) && rayTo(v, w, ray);
    }

    /** The same for a point of known depth.
    @param raw pixel.
    @param inverseDepth of the point along the optical axis of the global-shutter camera, times the way per unit of row
    time; negative in reverse.
    @param ray receives the ray.
    */
    bool solve(const Point2d& raw, double inverseDepth, Vec3d& ray) const
    {
        View v;
        return viewOfKnown(raw, v) && rayToDepth(v, inverseDepth, ray);
    }

    //! The same for a view.
    bool rayToDepth(const View& v, double inverseDepth, Vec3d& ray) const
    {
        // The depth of a point is w / inverseDepth, which is linear in w.
        const double approach = 1 - (shutter.down * Vec3d(v.x, 0, v.z))[2] * inverseDepth;
        return approach > 0 && rayTo(v, inverseDepth * (shutter.down * v.direction)[2] / approach, ray);
    }

private:
    bool undistort(const Point2d& raw, Vec3d& ray) const
    {
        Point2d p;
        const bool found = unproject(shutter.lens, raw, p);
        ray = Vec3d(p.x, p.y, 1);
        return found;
    }

    const ShutterGeometry& shutter;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DISTORTER_HPP
