// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "depth_places.hpp"
#include "../maps/remap_limits.hpp"

namespace cv { namespace rsackermann {

RectifyPlaces::RectifyPlaces(const ShutterGeometry& shutter_, const Matx33d& matrix, double way_, bool ofRaw_,
                             int maxIterations, double tolerance)
    : shutter(shutter_), rectifier(shutter_, maxIterations, tolerance), inverse(matrix.inv()), way(way_), ofRaw(ofRaw_)
{
}

bool RectifyPlaces::find(const Point2d& pixel, double inverseDepth, Point2d& place) const
{
    const Vec3d ray = inverse * Vec3d(pixel.x, pixel.y, 1);
    const double v = way * inverseDepth;
    if (ofRaw)
        return findOfRaw(ray, v, place) && isAddressable(place);
    Rectifier::Guess guess;
    return rectifier.solve(ray, shutter.up * ray, v, false, guess, place) && isAddressable(place);
}

// The depth in the global-shutter camera follows from the row that sees the point, and the row from that depth: a fixed
// point, at which the row's motion changes so little that a few rounds suffice.
bool RectifyPlaces::findOfRaw(const Vec3d& ray, double v, Point2d& place) const
{
    const int rounds = 20;
    const double enough = 1e-12;
    const Vec3d b = shutter.up * ray;
    double w = v;
    Rectifier::Guess guess;
    for (int i = 0; i < rounds; i++)
    {
        if (!rectifier.solve(ray, b, w, false, guess, place))
            return false;
        const double t = shutter.rowTime(place), last = w;
        const RowMotion m = shutter.motionAt(t);
        // w = v z, where z = far - w closer is the depth in the row's camera for depth 1 in the global-shutter camera
        const Vec3d camera(m.tau * m.s2, 0, m.tau * m.c2);
        const double far = depthInRow(b, m, t), closer = depthInRow(camera, m, t);
        if (!(1 + v * closer > 0))
            return false;
        w = v * far / (1 + v * closer);
        if (std::abs(w - last) <= enough * (1 + std::abs(w)))
            return true;
    }
    return false;
}

double RectifyPlaces::depthInRow(const Vec3d& b, const RowMotion& m, double t) const
{
    return (shutter.down * shutter.tilt(shutter.toRolling(b, 0, m), t))[2];
}

DistortPlaces::DistortPlaces(const ShutterGeometry& shutter_, const Matx33d& matrix_, double way_, bool ofRaw_)
    : shutter(shutter_), distorter(shutter_), matrix(matrix_), way(way_), ofRaw(ofRaw_)
{
}

bool DistortPlaces::find(const Point2d& pixel, double inverseDepth, Point2d& place) const
{
    const double v = way * inverseDepth;
    Vec3d ray;
    if (ofRaw)
    {
        Distorter::View view;
        if (!distorter.viewOfKnown(pixel, view) || !distorter.rayTo(view, v, ray))
            return false;
    }
    else if (!distorter.solve(pixel, v, ray))
        return false;
    place = pixelOf(matrix, ray);
    return isAddressable(place);
}

}} // namespace cv::rsackermann
