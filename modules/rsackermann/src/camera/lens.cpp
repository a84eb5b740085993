// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "lens.hpp"

namespace cv { namespace rsackermann {

// The radial models are looked at in steps of this many radians from the optical axis.
static const double ANGLE_STEP = 1e-3;

// Largest radius up to which the distorted radius grows all the way, as a square.
static double radiusLimit(const double* k, bool fisheye)
{
    double last = 0;
    for (int i = 1; i * ANGLE_STEP < CV_PI / 2; i++)
    {
        const double theta = i * ANGLE_STEP;
        double denominator = 1;
        const double r = std::tan(theta), radius = fisheye ? theta * fisheyeFactor(k, theta * theta)
                                                           : r * brownFactor(k, r * r, denominator);
        if (!(radius > last) || !(denominator > 0))
        {
            const double limit = std::tan((i - 1) * ANGLE_STEP);
            return limit * limit;
        }
        last = radius;
    }
    return DBL_MAX;
}

// Projection of the untilted image plane to the sensor; see the documentation of calib3d.
static Matx33d tiltProjection(double tauX, double tauY)
{
    const double cx = std::cos(tauX), sx = std::sin(tauX), cy = std::cos(tauY), sy = std::sin(tauY);
    const Matx33d R = Matx33d(cy, 0, -sy, 0, 1, 0, sy, 0, cy) * Matx33d(1, 0, 0, 0, cx, sx, 0, -sx, cx);
    return Matx33d(R(2, 2), 0, -R(0, 2), 0, R(2, 2), -R(1, 2), 0, 0, 1) * R;
}

template <typename T>
Lens<T>::Lens(const RollingShutterCamera& camera)
    : kind(camera.lensModel == LENS_FISHEYE ? FISHEYE : NONE), tilted(false), fx(T(camera.cameraMatrix(0, 0))),
      fy(T(camera.cameraMatrix(1, 1))), cx(T(camera.cameraMatrix(0, 2))), cy(T(camera.cameraMatrix(1, 2)))
{
    double all[14] = {0};
    for (size_t i = 0; i < camera.distCoeffs.size(); i++)
    {
        all[i] = camera.distCoeffs[i];
        if (all[i] != 0 && kind == NONE)
            kind = BROWN;
    }
    for (int i = 0; i < 12; i++)
        k[i] = T(all[i]);
    tilted = kind == BROWN && (all[12] != 0 || all[13] != 0);
    const Matx33d projection = tiltProjection(all[12], all[13]);
    for (int i = 0; i < 9; i++)
        tilt[i] = T(projection.val[i]);
    const double limit = kind == NONE ? DBL_MAX : radiusLimit(all, kind == FISHEYE);
    maxRadius2 = T(std::min(limit, (double)std::numeric_limits<T>::max()));
}

template struct Lens<double>;
template struct Lens<float>;

// Newton's method on the angle, which stays within the growing part of the radial model.
static bool unprojectFisheye(const Lens<double>& lens, const Point2d& distorted, Point2d& ray)
{
    const double* k = lens.k;
    const double radius = norm(distorted), limit = std::atan(std::sqrt(lens.maxRadius2));
    double theta = std::min(radius, limit), error = 0;
    for (int i = 0; i < 30; i++)
    {
        const double t2 = theta * theta;
        error = theta * fisheyeFactor(k, t2) - radius;
        const double slope = 1 + t2 * (3 * k[0] + t2 * (5 * k[1] + t2 * (7 * k[2] + t2 * 9 * k[3])));
        if (std::abs(error) < 1e-15 || !(slope > 0))
            break;
        theta = std::min(std::max(theta - error / slope, 0.), limit);
    }
    ray = radius > 0 ? distorted * (std::tan(theta) / radius) : Point2d();
    return std::abs(error) < 1e-10;
}

// Newton's method from the distorted point; steps that don't come nearer are halved.
static bool unprojectBrown(const Lens<double>& lens, const Point2d& raw, const Point2d& distorted, Point2d& ray)
{
    const double target = 1e-10, h = 1e-7; // pixels; step of the numeric derivatives
    ray = distorted;
    // Where the model stops growing steps would lead anywhere.
    const double size2 = ray.dot(ray), largest2 = 0.81 * lens.maxRadius2;
    if (size2 > largest2)
        ray *= std::sqrt(largest2 / size2);
    Point2d at, dx, dy;
    if (!lens.project(ray.x, ray.y, at.x, at.y))
        return false;
    for (int i = 0; i < 30; i++)
    {
        const Point2d error = at - raw;
        const double length = norm(error);
        if (length < target)
            break;
        if (!lens.project(ray.x + h, ray.y, dx.x, dx.y) || !lens.project(ray.x, ray.y + h, dy.x, dy.y))
            break;
        dx = (dx - at) * (1 / h);
        dy = (dy - at) * (1 / h);
        const double det = dx.cross(dy);
        if (det == 0)
            break;
        Point2d step = Point2d(error.cross(dy), dx.cross(error)) * (1 / det);
        bool nearer = false;
        for (int halvings = 0; halvings < 10 && !nearer; halvings++, step *= 0.5)
        {
            Point2d next;
            nearer = lens.project(ray.x - step.x, ray.y - step.y, next.x, next.y) && norm(next - raw) < length;
            if (nearer)
            {
                ray -= step;
                at = next;
            }
        }
        if (!nearer)
            break;
    }
    return norm(at - raw) < 1e-7;
}

bool unproject(const Lens<double>& lens, const Point2d& raw, Point2d& ray)
{
    ray = Point2d((raw.x - lens.cx) / lens.fx, (raw.y - lens.cy) / lens.fy);
    if (!(ray.dot(ray) < DBL_MAX))
    {
        ray = Point2d();
        return false;
    }
    if (lens.kind == Lens<double>::NONE)
        return true;
    const Point2d distorted = ray;
    return lens.kind == Lens<double>::FISHEYE ? unprojectFisheye(lens, distorted, ray)
                                              : unprojectBrown(lens, raw, distorted, ray);
}

std::vector<Vec3d> bearingsOf(const RollingShutterCamera& camera, const Matx33d& R, const std::vector<Point2d>& raw)
{
    const Lens<double> lens(camera);
    std::vector<Vec3d> result;
    for (const Point2d& pixel : raw)
    {
        Point2d ray;
        unproject(lens, pixel, ray);
        result.push_back(R * Vec3d(ray.x, ray.y, 1));
    }
    return result;
}

}} // namespace cv::rsackermann
