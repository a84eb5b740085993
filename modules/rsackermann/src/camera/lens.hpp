// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CAMERA_LENS_HPP
#define OPENCV_RSACKERMANN_SRC_CAMERA_LENS_HPP

#include "opencv2/rsackermann/camera.hpp"
#include <cmath>

namespace cv { namespace rsackermann {

//! Brown's radial factor, for a squared radius; its denominator becomes 0 at the pole of the rational model.
template <typename T>
T brownFactor(const T* k, T r2, T& denominator)
{
    denominator = 1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]));
    return (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / denominator;
}

//! The fisheye's factor of the angle to the optical axis, for its square.
template <typename T>
T fisheyeFactor(const T* k, T theta2)
{
    return 1 + theta2 * (k[0] + theta2 * (k[1] + theta2 * (k[2] + theta2 * k[3])));
}

/** The lens from undistorted points (x, y) on the plane z = 1 to raw pixels, as cv::projectPoints and
cv::fisheye::projectPoints define it.

Beyond the radius where the radial model stops growing (or has a pole) it would show a scene point a second time; such
points have no image.
*/
template <typename T>
struct Lens
{
    enum Kind { NONE, BROWN, FISHEYE };

    Kind kind;
    bool tilted; // the sensor isn't perpendicular to the optical axis (14 coefficients)
    T fx, fy, cx, cy;
    T k[12]; // k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4, or the four of the fisheye
    T tilt[9];
    T maxRadius2; // square of the largest radius x^2 + y^2 that has an image

    explicit Lens(const RollingShutterCamera& camera);

    //! False if the point has no image; then the pixel is undefined.
    bool project(T x, T y, T& u, T& v) const
    {
        if (kind == NONE)
        {
            u = fx * x + cx;
            v = fy * y + cy;
            return true;
        }
        const T r2 = x * x + y * y;
        if (!(r2 <= maxRadius2))
            return false;
        T xd, yd;
        if (kind == FISHEYE)
        {
            const T scale = fisheyeScale(r2);
            xd = x * scale;
            yd = y * scale;
        }
        else if (!brown(x, y, r2, xd, yd))
            return false;
        u = fx * xd + cx;
        v = fy * yd + cy;
        return true;
    }

private:
    T fisheyeScale(T r2) const
    {
        const T r = std::sqrt(r2);
        const T theta = std::atan(r), radial = fisheyeFactor(k, theta * theta);
        return r > 0 ? theta * radial / r : radial;
    }

    bool brown(T x, T y, T r2, T& xd, T& yd) const
    {
        T denominator;
        const T radial = brownFactor(k, r2, denominator), xy2 = 2 * x * y;
        xd = x * radial + k[2] * xy2 + k[3] * (r2 + 2 * x * x) + r2 * (k[8] + r2 * k[9]);
        yd = y * radial + k[2] * (r2 + 2 * y * y) + k[3] * xy2 + r2 * (k[10] + r2 * k[11]);
        if (!tilted)
            return true;
        const T z = tilt[6] * xd + tilt[7] * yd + tilt[8];
        if (!(z > 0))
            return false;
        const T tx = (tilt[0] * xd + tilt[1] * yd + tilt[2]) / z;
        yd = (tilt[3] * xd + tilt[4] * yd + tilt[5]) / z;
        xd = tx;
        return true;
    }
};

/** The inverse of Lens::project.
@return false if the lens model shows no ray at that pixel; then the ray is only near.
*/
bool unproject(const Lens<double>& lens, const Point2d& raw, Point2d& ray);

//! Least depth of a direction that counts as ahead, of its length; and of a depth, of that at the reference row.
const double IN_FRONT = 0.1;

//! Raw pixels to their undistorted rays (x, y, 1), rotated by R; finite, but meaningless if the lens model has none.
std::vector<Vec3d> bearingsOf(const RollingShutterCamera& camera, const Matx33d& R, const std::vector<Point2d>& raw);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CAMERA_LENS_HPP
