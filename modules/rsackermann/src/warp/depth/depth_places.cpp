// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "depth_places.hpp"
#include "../maps/remap_limits.hpp"

namespace cv { namespace rsackermann {

RectifyPlaces::RectifyPlaces(const ShutterGeometry& shutter_, const Matx33d& matrix, double way_, bool ofRaw_,
                             int maxIterations, double tolerance)
    : DepthPlaces(shutter_, way_, ofRaw_), rectifier(shutter_, maxIterations, tolerance), inverse(matrix.inv())
{
}

bool RectifyPlaces::find(const Point2d& pixel, double inverseDepth, Point2d& place, Guess& guess) const
{
    const Vec3d ray = inverse * Vec3d(pixel.x, pixel.y, 1), b = shutter.up * ray;
    const double v = way * inverseDepth;
    // w = v z, where z = far - w closer is the depth in the row's camera for depth 1 in the global-shutter camera
    const auto inRow = [&](const RowMotion& m, double t) {
        const Vec3d camera(m.tau * m.s2, 0, m.tau * m.c2);
        const double far = depthInRow(b, m, t), closer = depthInRow(camera, m, t);
        return 1 + v * closer > 0 ? v * far / (1 + v * closer) : std::numeric_limits<double>::quiet_NaN();
    };
    const bool found = ofRaw ? rectifier.solve(ray, b, inRow, false, guess.row, place)
                             : rectifier.solve(ray, b, v, false, guess.row, place);
    return found && isAddressable(place);
}

double RectifyPlaces::depthInRow(const Vec3d& b, const RowMotion& m, double t) const
{
    return (shutter.down * shutter.tilt(shutter.toRolling(b, 0, m), t))[2];
}

DistortPlaces::DistortPlaces(const ShutterGeometry& shutter_, const Matx33d& matrix_, double way_, bool ofRaw_)
    : DepthPlaces(shutter_, way_, ofRaw_), distorter(shutter_), matrix(matrix_)
{
}

bool DistortPlaces::find(const Point2d& pixel, double inverseDepth, Point2d& place, Guess& guess) const
{
    if (!guess.hasView || guess.pixel != pixel)
    {
        guess.pixel = pixel;
        guess.hasView = distorter.viewOfKnown(pixel, guess.view);
    }
    const double v = way * inverseDepth;
    Vec3d ray;
    if (!guess.hasView || !(ofRaw ? distorter.rayTo(guess.view, v, ray) : distorter.rayToDepth(guess.view, v, ray)))
        return false;
    place = pixelOf(matrix, ray);
    return isAddressable(place);
}

}} // namespace cv::rsackermann
