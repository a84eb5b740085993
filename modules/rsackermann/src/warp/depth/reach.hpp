// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DEPTH_REACH_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DEPTH_REACH_HPP

#include "depth_places.hpp"
#include "inverse_depth_image.hpp"

namespace cv { namespace rsackermann {

//! The pixels of the other image that can be met between some places.
class Reach
{
public:
    Reach() : left(FLT_MAX), top(FLT_MAX), right(-FLT_MAX), bottom(-FLT_MAX) {}

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

private:
    float left, top, right, bottom;
};

/** The inverse depths of all surfaces that pixels of a map may show; false if one of its corners has no place.
@param corner first one of the pixels.
@param size from there to the opposite corner. */
inline bool findReach(const DepthPlaces& places, const InverseDepthImage& depths, const Point2d& corner,
                      const Size& size, float& low, float& high)
{
    const int rounds = 2; // the first one narrows down what the second one looks at
    depths.range(Rect(Point(), depths.values().size()), low, high);
    for (int i = 0; i < rounds; i++)
    {
        Reach reach;
        for (int k = 0; k < 8; k++)
        {
            Point2d place;
            if (!places.find(corner + Point2d(k % 2 * size.width, k / 2 % 2 * size.height), k < 4 ? low : high, place))
                return false;
            reach.add(place);
        }
        depths.range(reach.area(), low, high);
    }
    return true;
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DEPTH_REACH_HPP
