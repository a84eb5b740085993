// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DEPTH_REACH_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DEPTH_REACH_HPP

#include "../maps/pixel_curve.hpp"
#include "depth_places.hpp"
#include "inverse_depth_image.hpp"

namespace cv { namespace rsackermann {

//! The pixels of the other image that can be met between some places.
class Reach
{
public:
    void add(const Point2f& place)
    {
        left = std::min(left, place.x);
        top = std::min(top, place.y);
        right = std::max(right, place.x);
        bottom = std::max(bottom, place.y);
    }

    Rect area() const
    {
        const int margin = 2; // curves bend a little, and a place lies between pixels
        return Rect(Point(cvFloor(left) - margin, cvFloor(top) - margin),
                    Point(cvCeil(right) + margin, cvCeil(bottom) + margin));
    }

    //! A square of pixels around the places, of which those outside of an image count as on its border.
    Rect square(float lastX, float lastY) const
    {
        const auto inside = [](float value, float last) { return std::min(std::max(value, 0.f), last); };
        const Point first(cvFloor(inside(left, lastX)), cvFloor(inside(top, lastY))),
            last(cvCeil(inside(right, lastX)), cvCeil(inside(bottom, lastY)));
        const int smallest = 3;
        return Rect(first, Size(1, 1) * std::max(std::max(last.x - first.x, last.y - first.y), smallest));
    }

private:
    float left = FLT_MAX, top = FLT_MAX, right = -FLT_MAX, bottom = -FLT_MAX;
};

/** Narrows the inverse depths of all surfaces that a block of pixels may show; false if one of its corners has no
place.
@param placeOf bool(int corner, float inverseDepth, Point2f& place), of four corners.
@param low, high read and written.
@param stretch receives by how many pixels neighbours in the other image may be displaced against each other. */
template <class PlaceOf>
bool narrowReach(const PlaceOf& placeOf, const InverseDepthImage& depths, float& low, float& high, float& stretch)
{
    const int rounds = 2; // the first one narrows down what the second one looks at
    for (int i = 0; i < rounds; i++)
    {
        Reach reach;
        float longest = 0;
        for (int k = 0; k < 4; k++)
        {
            Point2f near, far;
            if (!placeOf(k, high, near) || !placeOf(k, low, far))
                return false;
            reach.add(near);
            reach.add(far);
            longest = std::max(longest, std::max(std::abs(near.x - far.x), std::abs(near.y - far.y)));
        }
        const float pixelsPerDepth = high > low ? longest / (high - low) : 0;
        const DepthRange range = depths.range(reach.area());
        low = range.low;
        high = range.high;
        stretch = pixelsPerDepth * range.steepest;
    }
    return true;
}

//! The same in a part of a patch, counted from its first pixel.
inline void narrowReach(const DepthPatch& patch, const Rect& part, const InverseDepthImage& depths, float& low,
                        float& high, float& stretch)
{
    const auto curveAt = [&](int k) {
        return SquareCurve(patch, part.tl() + Point(k % 2 * part.width, k / 2 * part.height));
    };
    const SquareCurve curves[] = {curveAt(0), curveAt(1), curveAt(2), curveAt(3)};
    narrowReach(
        [&](int k, float inverseDepth, Point2f& place) {
            place = curves[k].at(inverseDepth);
            return true;
        },
        depths, low, high, stretch);
}

/** The same for pixels of a map of which nothing is known yet.
@param corner first one of the pixels.
@param size from there to the opposite corner. */
inline bool findReach(const DepthPlaces& places, const InverseDepthImage& depths, const Point2d& corner,
                      const Size& size, float& low, float& high, float& stretch)
{
    low = depths.range().low;
    high = depths.range().high;
    DepthPlaces::Guess guess;
    return narrowReach(
        [&](int k, float inverseDepth, Point2f& place) {
            Point2d exact;
            const bool found =
                places.find(corner + Point2d(k % 2 * size.width, k / 2 * size.height), inverseDepth, exact, guess);
            place = exact;
            return found;
        },
        depths, low, high, stretch);
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DEPTH_REACH_HPP
