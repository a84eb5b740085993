// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "points.hpp"
#include "valid_area.hpp"

namespace cv { namespace rsackermann {

// The largest rectangle under a histogram whose columns are as high as the runs of valid pixels that end in this row.
static void growRectangle(const std::vector<int>& heights, int row, std::vector<int>& stack, Rect& best)
{
    const int width = int(heights.size());
    stack.clear(); // columns of rising height
    for (int x = 0; x <= width; x++)
    {
        const int height = x < width ? heights[x] : 0;
        while (!stack.empty() && heights[stack.back()] >= height)
        {
            const int top = heights[stack.back()];
            stack.pop_back();
            const int left = stack.empty() ? 0 : stack.back() + 1;
            if ((x - left) * (int64)top > best.width * (int64)best.height)
                best = Rect(left, row - top + 1, x - left, top);
        }
        if (x < width)
            stack.push_back(x);
    }
}

Rect largestRectangle(const Mat& mask)
{
    Rect best;
    std::vector<int> heights(mask.cols, 0), stack;
    for (int y = 0; y < mask.rows; y++)
    {
        const uchar* valid = mask.ptr(y);
        for (int x = 0; x < mask.cols; x++)
            heights[x] = valid[x] ? heights[x] + 1 : 0;
        growRectangle(heights, y, stack, best);
    }
    return best;
}

namespace {

struct Interval
{
    Interval() : low(DBL_MAX), high(-DBL_MAX) {}
    void add(double v)
    {
        low = std::min(low, v);
        high = std::max(high, v);
    }
    bool empty() const { return low > high; }

    double low, high;
};

// Focal length and principal point that map an interval to pixels 0 .. pixels - 1.
Vec2d fit(double low, double high, int pixels)
{
    const double focal = (pixels - 1) / (high - low);
    return Vec2d(focal, -focal * low);
}

} // namespace

// Range of one normalised coordinate along a border of the raw image.
static Interval borderRange(const RollingShutterCamera& camera, const AckermannMotion& motion, bool horizontal,
                            bool far)
{
    const int length = horizontal ? camera.imageSize.width : camera.imageSize.height;
    const int place = far ? (horizontal ? camera.imageSize.height : camera.imageSize.width) - 1 : 0;
    std::vector<Point2d> raw(length);
    for (int i = 0; i < length; i++)
        raw[i] = horizontal ? Point2d(i, place) : Point2d(place, i);
    std::vector<Place> places;
    correctPoints(camera, Matx33d::eye(), motion, raw, std::vector<double>(), places);
    Interval range;
    for (size_t i = 0; i < places.size(); i++)
        if (places[i].exists)
            range.add(horizontal ? places[i].point.y : places[i].point.x);
    return range;
}

Matx33d optimalMatrix(const RollingShutterCamera& camera, const AckermannMotion& motion, double alpha,
                      const Size& newSize, const Matx33d& fallback)
{
    const Interval top = borderRange(camera, motion, true, false), bottom = borderRange(camera, motion, true, true);
    const Interval left = borderRange(camera, motion, false, false), right = borderRange(camera, motion, false, true);
    if (top.empty() || bottom.empty() || left.empty() || right.empty() || !(left.high < right.low) ||
        !(top.high < bottom.low))
        return fallback;
    const Vec2d x =
        (1 - alpha) * fit(left.high, right.low, newSize.width) + alpha * fit(left.low, right.high, newSize.width);
    const Vec2d y =
        (1 - alpha) * fit(top.high, bottom.low, newSize.height) + alpha * fit(top.low, bottom.high, newSize.height);
    return Matx33d(x[0], 0, x[1], 0, y[0], y[1], 0, 0, 1);
}

}} // namespace cv::rsackermann
