// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "lens.hpp"

namespace cv {
namespace rsackermann {

// Radial factor of the distorted radius; the denominator is wanted for the pole of the rational model.
static double brownRadius(const double* k, double r, double& denominator)
{
    const double r2 = r * r;
    denominator = 1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]));
    return r * (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / denominator;
}

static double fisheyeRadius(const double* k, double theta)
{
    const double t2 = theta * theta;
    return theta * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
}

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
        const double radius = fisheye ? fisheyeRadius(k, theta) : brownRadius(k, std::tan(theta), denominator);
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

}} // namespace cv::rsackermann
