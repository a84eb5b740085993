// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_RECTIFIER_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_RECTIFIER_HPP

#include "shutter_geometry.hpp"

namespace cv { namespace rsackermann {

/** Finds the raw pixel that sees a point of the global-shutter image (doc/theory.md, "Warp").

The row time t of the raw pixel is the fixed point of t -> row time of the pixel that would see the point at t. It is a
contraction for every motion that a car can make; secant steps reach the fixed point in two or three evaluations. The
last step isn't evaluated: the place moves along with the row time at the rate that is known by then.
*/
class Rectifier
{
public:
    //! Where the fixed point of a neighbouring pixel was.
    struct Guess
    {
        bool valid = false;
        double time = 0;  // fixed point
        double slope = 0; // derivative of the iterated function
        Point2d rate;     // that of the place
    };

    //! @param tolerance pixels; the place is found when a step changes it by less.
    Rectifier(const ShutterGeometry& shutter_, int maxIterations_, double tolerance_)
        : shutter(shutter_), maxIterations(maxIterations_), tolerance(tolerance_),
          timeTolerance(tolerance_ * shutter_.timePerPixel())
    {
    }

    /** The raw pixel of a ray of the global-shutter camera; false if there is none.
    @param ray direction in the camera frame.
    @param b the same in the upright frame.
    @param w scaled inverse depth, to the scale of b; or a function of the row's motion and time that gives it.
    @param onPlane whether w is that of one of the planes, which the camera must not have passed.
    @param guess read and written.
    */
    bool solve(const Vec3d& ray, const Vec3d& b, double w, bool onPlane, Guess& guess, Point2d& raw) const
    {
        return solve(
            ray, b, [w](const RowMotion&, double) { return w; }, onPlane, guess, raw);
    }

    template <class InverseDepth>
    bool solve(const Vec3d& ray, const Vec3d& b, const InverseDepth& w, bool onPlane, Guess& guess, Point2d& raw) const
    {
        if (!shutter.moving)
            return shutter.project(ray, raw);
        // Where the function is hardly a contraction a neighbour's guess may lead to a place to which the first guess
        // doesn't: whether a pixel has a place would depend on the pixels before it.
        if (guess.valid && iterate(b, w, onPlane, guess, raw) && std::abs(guess.slope) < MAX_SLOPE)
            return true;
        guess = Guess();
        guess.time = shutter.project(ray, raw) ? shutter.rowTime(raw) : 0;
        guess.valid = iterate(b, w, onPlane, guess, raw);
        return guess.valid;
    }

private:
    // Steeper functions are no contractions; there the step is cut.
    static constexpr double MAX_SLOPE = 0.9;

    template <class InverseDepth>
    bool iterate(const Vec3d& b, const InverseDepth& w, bool onPlane, Guess& guess, Point2d& raw) const
    {
        double time = guess.time, slope = guess.slope, lastTime = 0, lastValue = 0;
        Point2d rate = guess.rate, lastRaw;
        for (int i = 0; i < maxIterations; i++)
        {
            const RowMotion m = shutter.motionAt(time);
            if (!shutter.project(shutter.down * shutter.tilt(shutter.toRolling(b, w(m, time), m), time), raw))
                return false;
            const double value = shutter.rowTime(raw);
            if (i > 0)
            {
                slope = std::min((value - lastValue) / (time - lastTime), double(MAX_SLOPE));
                rate = (raw - lastRaw) * (1 / (time - lastTime));
            }
            const double step = (value - time) / (1 - slope);
            const Point2d change = rate * step;
            if (isLast(value - time, change, guess.valid || i > 0))
            {
                raw += change;
                guess.time = time + step;
                guess.slope = slope;
                guess.rate = rate;
                return !onPlane || shutter.isInside(m);
            }
            lastTime = time;
            lastValue = value;
            lastRaw = raw;
            time += step;
        }
        return false;
    }

    // The rate is that of a neighbour or a mean over the last step: it serves for small steps only.
    bool isLast(double ahead, const Point2d& change, bool rateKnown) const
    {
        const double distance = std::abs(ahead);
        return distance <= timeTolerance || (rateKnown && distance <= 10 * timeTolerance &&
                                             std::max(std::abs(change.x), std::abs(change.y)) <= tolerance);
    }

    const ShutterGeometry& shutter;
    int maxIterations;
    double tolerance, timeTolerance;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_RECTIFIER_HPP
