// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../motion/metric_way.hpp"
#include "distorter.hpp"
#include "maps/remap_limits.hpp"
#include "points.hpp"
#include "rectifier.hpp"

namespace cv { namespace rsackermann {

static bool isKnown(const std::vector<double>& depths, size_t i)
{
    return !depths.empty() && depths[i] > 0;
}

// What inverse depths are multiplied by to be in the unit of the motion.
static double wayOf(const RollingShutterCamera& camera, const AckermannMotion& motion,
                    const std::vector<double>& depths)
{
    return depths.empty() || motion.status != MOTION_OK ? 0 : wayPerUnitTime(camera, motion);
}

static void setPlace(const Point2d& point, Place& place)
{
    place.exists = isAddressable(point);
    if (place.exists)
        place.point = point;
}

void correctPoints(const RollingShutterCamera& camera, const WarpMapGenerator::Params&, const Matx33d& matrix,
                   const AckermannMotion& motion, const std::vector<Point2d>& raw, const std::vector<double>& depths,
                   std::vector<Place>& places)
{
    const ShutterGeometry shutter(camera, motion);
    const Distorter distorter(shutter);
    const double way = wayOf(camera, motion, depths);
    places.assign(raw.size(), Place());
    for (size_t i = 0; i < raw.size(); i++)
    {
        Vec3d ray;
        if (isKnown(depths, i) ? distorter.solve(raw[i], way / depths[i], ray) : distorter.solve(raw[i], ray))
            setPlace(pixelOf(matrix, ray), places[i]);
    }
}

void distortPoints(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params, const Matx33d& matrix,
                   const AckermannMotion& motion, const std::vector<Point2d>& pixels, const std::vector<double>& depths,
                   std::vector<Place>& places)
{
    // Points are few, and their users expect the inverse of correctPoints().
    const int manyIterations = 50;
    const double fineTolerance = 1e-9;

    const ShutterGeometry shutter(camera, motion);
    // A point has a place if a pixel has: where a row time is hardly found more iterations would make a difference.
    const Rectifier asInMaps(shutter, params.maxIterations, params.tolerance),
        rectifier(shutter, manyIterations, std::min(fineTolerance, params.tolerance));
    const double way = wayOf(camera, motion, depths);
    const Matx33d inverse = matrix.inv();
    places.assign(pixels.size(), Place());
    for (size_t i = 0; i < pixels.size(); i++)
    {
        const Vec3d ray = inverse * Vec3d(pixels[i].x, pixels[i].y, 1);
        const Vec3d b = shutter.up * ray;
        const bool onPlane = !isKnown(depths, i);
        Rectifier::Guess guess;
        Point2d raw;
        const double w = onPlane ? shutter.inverseDepth(b) : way / depths[i];
        if (asInMaps.solve(ray, b, w, onPlane, guess, raw) && rectifier.solve(ray, b, w, onPlane, guess, raw))
            setPlace(raw, places[i]);
    }
}

}} // namespace cv::rsackermann
