// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../checks.hpp"
#include "compensation.hpp"
#include "row_tilt.hpp"

namespace cv { namespace rsackermann {

void RotationCurve::check(const Mat& vectors)
{
    REJECT_IF(vectors.dims != 2 || vectors.type() != CV_64FC1 || !isPossible(vectors.size()),
              "motion.rotationCurve is a %d x %d matrix of type %s; %s of type CV_64FC1 are expected", vectors.rows,
              vectors.cols, typeToString(vectors.type()).c_str(), possibleSizes().c_str());
    for (int i = 0; i < vectors.rows; i++)
    {
        const double angle = norm(Vec3d(vectors.ptr<double>(i)));
        REJECT_IF(!(angle <= CV_PI),
                  "row %d of motion.rotationCurve is a rotation by %g; at most pi, radians, is expected", i, angle);
    }
}

RotationCurve::RotationCurve(const RollingShutterCamera& camera, const Mat& vectors) : time0(0), perTime(0)
{
    if (vectors.empty())
        return;
    check(vectors);
    const int last = vectors.rows - 1;
    for (int i = 0; i <= last; i++)
        values.push_back(Vec3d(vectors.ptr<double>(i)));
    time0 = camera.rowTime(Point2d());
    const double readOut = camera.rowTime(Point2d(camera.imageSize.width - 1, camera.imageSize.height - 1)) - time0;
    perTime = readOut != 0 ? last / readOut : 0;

    // Tridiagonal: b[i - 1] + 4 b[i] + b[i + 1] = 6 second differences, and none bends at the ends.
    bends.assign(values.size(), Vec3d());
    std::vector<double> above(values.size(), 0.);
    for (int i = 1; i < last; i++)
    {
        const double pivot = 1 / (4 - above[i - 1]);
        above[i] = pivot;
        bends[i] = (6 * (values[i - 1] - 2 * values[i] + values[i + 1]) - bends[i - 1]) * pivot;
    }
    for (int i = last - 1; i > 0; i--)
        bends[i] -= bends[i + 1] * above[i];
}

Vec3d RotationCurve::at(double time) const
{
    const int last = int(values.size()) - 1;
    const double place = (time - time0) * perTime, inside = place > 0 ? std::min(place, double(last)) : 0;
    const int i = std::min(int(inside), last - 1);
    const double f = inside - i, g = 1 - f, beyond = place - inside;
    const Vec3d chord = values[i + 1] - values[i];
    Vec3d value = values[i] + chord * f - (bends[i] * (1 + g) + bends[i + 1] * (1 + f)) * (f * g / 6);
    if (beyond != 0)
        value += (chord + (bends[i] * (1 - 3 * g * g) + bends[i + 1] * (3 * f * f - 1)) * (1. / 6)) * beyond;
    return value;
}

// Rodrigues' formula.
Matx33d RotationCurve::rotation(double time) const
{
    const Vec3d v = at(time);
    double sinc, cosine, sincHalf, cosHalf;
    const double angle = norm(v);
    sincAndCos(angle, sinc, cosine);
    sincAndCos(angle / 2, sincHalf, cosHalf);
    const Matx33d cross(0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0);
    return Matx33d::eye() + sinc * cross + 0.5 * sincHalf * sincHalf * (cross * cross);
}

}} // namespace cv::rsackermann
