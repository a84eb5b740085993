// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_RECTIFIER_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_RECTIFIER_HPP

#include "shutter.hpp"

namespace cv {
namespace rsackermann {

/** Finds the raw pixel that sees a point of the global-shutter image (doc/theory.md, "Warp").

The row time t of the raw pixel is the fixed point of t -> row time of the pixel that would see the point at t. It is a
contraction for every motion that a car can make; secant steps reach the fixed point in two or three evaluations.
*/
class Rectifier
{
public:
    //! Where the fixed point of a neighbouring pixel was.
    struct Guess
    {
        Guess() : valid(false), time(0), slope(0) {}
        bool valid;
        double time;  // fixed point
        double slope; // derivative of the iterated function
    };

    Rectifier(const Shutter& shutter_, int maxIterations_, double tolerance)
        : shutter(shutter_), maxIterations(maxIterations_), timeTolerance(tolerance * shutter_.timePerPixel())
    {
    }

    /** The raw pixel of a ray of the global-shutter camera; false where there is none.
    @param ray direction in the camera frame.
    @param b the same in the upright frame.
    @param w scaled inverse depth, to the scale of b.
    @param onPlane whether w is that of one of the planes, which the camera must not have passed.
    @param guess read and written.
    */
    bool solve(const Vec3d& ray, const Vec3d& b, double w, bool onPlane, Guess& guess, Point2d& raw) const
    {
        if (!shutter.moving)
            return shutter.project(ray, raw);
        if (guess.valid && iterate(b, w, onPlane, guess, raw))
            return true;
        guess.slope = 0;
        guess.time = shutter.project(ray, raw) ? shutter.rowTime(raw) : 0;
        guess.valid = iterate(b, w, onPlane, guess, raw);
        return guess.valid;
    }

private:
    bool iterate(const Vec3d& b, double w, bool onPlane, Guess& guess, Point2d& raw) const
    {
        // Steeper functions are no contractions; there the step is cut.
        const double maxSlope = 0.9;

        double time = guess.time, slope = guess.slope, lastTime = 0, lastValue = 0;
        for (int i = 0; i < maxIterations; i++)
        {
            const RowMotion m = shutter.motionAt(time);
            if (!shutter.project(shutter.down * shutter.toRolling(b, w, m), raw))
                return false;
            const double value = shutter.rowTime(raw);
            if (std::abs(value - time) <= timeTolerance)
            {
                guess.time = value;
                guess.slope = slope;
                return !onPlane || shutter.isInside(m);
            }
            if (i > 0)
                slope = std::min((value - lastValue) / (time - lastTime), maxSlope);
            lastTime = time;
            lastValue = value;
            time += (value - time) / (1 - slope);
        }
        return false;
    }

    const Shutter& shutter;
    int maxIterations;
    double timeTolerance;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_RECTIFIER_HPP
