// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_DEPTH_PATCH_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_DEPTH_PATCH_HPP

#include "map_patch.hpp"
#include "../depth/depth_places.hpp"

namespace cv { namespace rsackermann {

/** The variable of a patch that stands for the inverse depth u: u / (1 - bend u), scaled to -1 ... 1.

A place is a quotient of linear functions of u. If bend is the root of its denominator it is linear in the variable.
*/
struct DepthVariable
{
    enum { POWERS = 3 }; // of a polynomial in it that gives a place

    float bend, middle, scale;

    DepthVariable() : bend(0), middle(0), scale(1) {}
    //! For the inverse depths of a range at a pixel.
    DepthVariable(const Point2d& pixel, double lowest, double highest, const DepthPlaces& places);

    float at(float inverseDepth) const { return (inverseDepth / (1 - bend * inverseDepth) - middle) * scale; }

    //! The inverse of at().
    double inverseDepth(double value) const
    {
        const double v = middle + value / scale;
        return v / (1 + bend * v);
    }

    //! Those of the polynomial through the places of a pixel at -1, 0 and 1; false if one of them doesn't exist.
    bool coefficients(const Point2d& pixel, const DepthPlaces& places, DepthPlaces::Guess& guess,
                      Point2d (&c)[POWERS]) const;
};

/** A square part of a map at all depths of a range: a polynomial in column, row and a variable of the depth.

By the depth a place moves by a few pixels only, and nearly evenly in the variable: two powers of it are enough.
*/
struct DepthPatch
{
    enum { NODES = Bicubic::NODES, POWERS = DepthVariable::POWERS };

    Bicubic x[POWERS], y[POWERS]; //!< of the powers of the variable
    DepthVariable variable;

    /** Interpolates the exact places; false if the error is too large or a place doesn't exist.
    @param square of pixels of the map.
    @param lowest, highest inverse depths that can occur in the square.
    @param times by how much the error may be larger than that of a map. */
    bool fit(const Rect& square, double lowest, double highest, const DepthPlaces& places, double times = 1);

private:
    bool interpolate(const Point2d& first, double size, const DepthPlaces& places);
    bool isExact(const Point2d& first, double step, const DepthPlaces& places, double times) const;
    Point2d at(const Point2d& pixel, double depth) const;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_DEPTH_PATCH_HPP
