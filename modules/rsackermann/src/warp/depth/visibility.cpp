// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../maps/pixel_curve.hpp"
#include "reach.hpp"
#include "surface_search.hpp"
#include "visibility.hpp"

namespace cv { namespace rsackermann {

static bool isNear(const Point2f& a, const Point2f& b)
{
    const float half = 0.5f; // pixels: surfaces that aren't further apart hide nothing of one another
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) <= half;
}

bool Visibility::isSeen(const Point& pixel, const Point2f& place) const
{
    if (!(place.x >= 0 && place.y >= 0 && place.x <= columns.cols - 1 && place.y <= columns.rows - 1) ||
        showsInMap(pixel, place))
        return true;
    float low, high, depth;
    Point2d shown;
    if (!findReach(back, depths, place, Size(), low, high))
        return true;
    SurfaceSearch<CubicCurve>(depths, CubicCurve(back, place, low, high), low, high).find(depth);
    return back.find(place, depth, shown) && isNear(shown, pixel);
}

// Between pixels that show the same surface the map is linear.
bool Visibility::showsInMap(const Point& pixel, const Point2f& place) const
{
    if (columns.cols < 2 || columns.rows < 2)
        return false;
    const int x = std::min(int(place.x), columns.cols - 2), y = std::min(int(place.y), columns.rows - 2);
    const float fx = place.x - x, fy = place.y - y;
    Point2f shown[2];
    for (int k = 0; k < 2; k++)
        shown[k] = (1 - fx) * Point2f(columns(y + k, x), rows(y + k, x)) +
                   fx * Point2f(columns(y + k, x + 1), rows(y + k, x + 1));
    return isNear((1 - fy) * shown[0] + fy * shown[1], pixel);
}

}} // namespace cv::rsackermann
