// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_SHUTTER_GEOMETRY_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_SHUTTER_GEOMETRY_HPP

#include "../camera/lens.hpp"
#include "../motion/compensation.hpp"
#include "../motion/row_tilt.hpp"
#include "../scene/inverse_depth_offset.hpp"
#include "../scene/planes.hpp"

namespace cv { namespace rsackermann {

/** The geometry between the global-shutter camera and the raw image (doc/theory.md, "Warp").

*Rays* are directions (x, y, z) of any scale in the camera frame, *bearings* the same turned into the upright frame of
the motion. A bearing b of the global-shutter camera and the bearing q of the camera at a row time are tied by q =
tilt(t)^T R(-theta) (b - tau w (s2, 0, c2)), where w belongs to the scale of b as in Scene::inverseDepth and tilt(t) is
that of RowTilt.
*/
class ShutterGeometry
{
public:
    ShutterGeometry(const RollingShutterCamera& camera, const AckermannMotion& motion)
        : moving(motion.status == MOTION_OK), scene(motion), depthOffset(motion), lens(camera),
          up(motion.uprightRotation(camera)), down(up.t()), rowTilt(camera, motion), alpha(motion.alpha),
          heading(motion.heading(camera)), byRows(camera.isRowShutter()), time0(camera.rowTime(Point2d(0, 0))),
          timeStep(camera.rowTime(Point2d(1, 1)) - time0)
    {
    }

    double rowTime(const Point2d& raw) const { return time0 + timeStep * (byRows ? raw.y : raw.x); }

    //! Row time per pixel.
    double timePerPixel() const { return std::abs(timeStep); }

    RowMotion motionAt(double t) const { return RowMotion(alpha, heading, t); }

    //! Whether the camera is still between the walls; otherwise the planes mean nothing.
    bool isInside(const RowMotion& m) const { return scene.isInside(m.tau * m.s2, m.tau * m.c2); }

    //! w of the point that is seen with a bearing of the global-shutter camera.
    double inverseDepth(const Vec3d& b) const { return scene.inverseDepth(b) + depthOffset.at(b); }

    //! Bearing of the global-shutter camera to the bearing of the moved camera.
    Vec3d toRolling(const Vec3d& b, double w, const RowMotion& m) const
    {
        const double shift = m.tau * w;
        const double x = b[0] - shift * m.s2, z = b[2] - shift * m.c2;
        return Vec3d(m.c * x - m.s * z, b[1], m.s * x + m.c * z);
    }

    //! A bearing that is only turned and moved as the row at a time sees it, which is tilted as well.
    Vec3d tilt(const Vec3d& q, double t) const { return rowTilt.isNone() ? q : rowTilt.at(t).t() * q; }

    //! Inverse of tilt().
    Vec3d tiltBack(const Vec3d& q, double t) const { return rowTilt.isNone() ? q : rowTilt.at(t) * q; }

    //! Whether rows turn by a curve that has knots.
    bool hasCurve() const { return moving && !rowTilt.curve.empty(); }

    //! Whether there are so few knots of that curve between two row times that the checks of a patch notice them.
    bool isSmoothBetween(double from, double to) const
    {
        const int most = 2;
        return !hasCurve() || rowTilt.curve.pieces(from, to) <= most;
    }

    //! Bearing of the moved camera, without its tilt, in the orientation of the global-shutter camera.
    static Vec3d rotateBack(const Vec3d& q, const RowMotion& m)
    {
        Vec3d rotated(0, q[1], 0);
        m.turn(q[0], q[2], rotated[0], rotated[2]);
        return rotated;
    }

    //! The raw pixel of a ray; false if there is none.
    bool project(const Vec3d& ray, Point2d& raw) const
    {
        return ray[2] > 0 && lens.project(ray[0] / ray[2], ray[1] / ray[2], raw.x, raw.y);
    }

    bool moving; //!< false: there is only a lens
    Scene scene;
    InverseDepthOffset depthOffset;
    Lens<double> lens;
    Matx33d up;   //!< camera frame to upright frame
    Matx33d down; //!< upright frame to camera frame

private:
    RowTilt rowTilt;
    double alpha;
    Heading heading;
    bool byRows;
    double time0, timeStep;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_SHUTTER_GEOMETRY_HPP
