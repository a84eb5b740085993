// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_PIXEL_CURVE_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_PIXEL_CURVE_HPP

#include "depth_patch.hpp"
#include "remap_limits.hpp"

namespace cv { namespace rsackermann {

// The curve of places that one pixel may show, for SurfaceSearch.

//! A polynomial of degree 2 in the variable of a depth.
class SquareCurve
{
public:
    typedef float Number;

    //! @param pixel from the first one of the patch.
    SquareCurve(const DepthPatch& patch, const Point2d& pixel) : variable(patch.variable)
    {
        for (int k = 0; k < DepthPatch::POWERS; k++)
            c[k] = Point2d(patch.x[k].at(pixel.x, pixel.y), patch.y[k].at(pixel.x, pixel.y));
    }

    //! Through the exact places of a pixel at three depths of a range; far outside if one of them doesn't exist.
    SquareCurve(const DepthPlaces& places, const Point2d& pixel, double lowest, double highest)
        : variable(pixel, lowest, highest, places)
    {
        Point2d exact[DepthPatch::POWERS];
        DepthPlaces::Guess guess;
        if (variable.coefficients(pixel, places, guess, exact))
            std::copy(exact, exact + DepthPatch::POWERS, c);
        else
            c[0] = Point2f(FAR_OUTSIDE, FAR_OUTSIDE);
    }

    Point2f at(float inverseDepth) const
    {
        const float depth = variable.at(inverseDepth);
        return c[0] + depth * (c[1] + depth * c[2]);
    }

private:
    Point2f c[DepthPatch::POWERS];
    DepthVariable variable;
};

//! The exact places; those that don't exist are far outside.
class ExactCurve
{
public:
    typedef float Number;

    ExactCurve(const DepthPlaces& places_, const Point2d& pixel_) : places(places_), pixel(pixel_) {}

    Point2f at(float inverseDepth) const
    {
        Point2d place;
        return places.find(pixel, inverseDepth, place) ? Point2f(place) : Point2f(FAR_OUTSIDE, FAR_OUTSIDE);
    }

private:
    const DepthPlaces& places;
    Point2d pixel;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_PIXEL_CURVE_HPP
