// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "points.hpp"

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
    void add(double v)
    {
        low = std::min(low, v);
        high = std::max(high, v);
    }
    bool empty() const { return low > high; }

    double low = DBL_MAX, high = -DBL_MAX;
};

// Focal length and principal point that map an interval to pixels 0 .. pixels - 1.
Vec2d fit(double low, double high, int pixels)
{
    const double focal = (pixels - 1) / (high - low);
    return Vec2d(focal, -focal * low);
}

// A border of the raw image: one normalised coordinate of what it shows, along it.
class Border
{
public:
    Border(const RollingShutterCamera& camera_, const AckermannMotion& motion_, bool horizontal_, bool far)
        : camera(camera_), motion(motion_), horizontal(horizontal_),
          length(horizontal_ ? camera_.imageSize.width : camera_.imageSize.height),
          place(far ? (horizontal_ ? camera_.imageSize.height : camera_.imageSize.width) - 1 : 0)
    {
    }

    Interval range() const
    {
        Interval result;
        double lowest = 0, highest = 0; // where
        add(0, length - 1, length, result, lowest, highest);
        // An extreme may be between two pixels: where one plane hides another one it is a peak.
        for (double step = 1; step > 1e-3; step /= FINER)
        {
            const double low = lowest, high = highest;
            add(low - step, low + step, 2 * FINER + 1, result, lowest, highest);
            add(high - step, high + step, 2 * FINER + 1, result, lowest, highest);
        }
        return result;
    }

private:
    enum { FINER = 4 };

    // Adds the coordinates of so many points from the first to the last place.
    void add(double first, double last, int count, Interval& result, double& lowest, double& highest) const
    {
        std::vector<Point2d> raw(count);
        std::vector<double> along(count);
        for (int i = 0; i < count; i++)
        {
            along[i] = std::min(std::max(first + (last - first) * i / std::max(count - 1, 1), 0.), length - 1.);
            raw[i] = horizontal ? Point2d(along[i], place) : Point2d(place, along[i]);
        }
        std::vector<Place> places;
        correctPoints(camera, WarpMapGenerator::Params(), Matx33d::eye(), motion, raw, std::vector<double>(), places);
        for (int i = 0; i < count; i++)
        {
            const double value = horizontal ? places[i].point.y : places[i].point.x;
            if (!places[i].exists)
                continue;
            if (value < result.low)
                lowest = along[i];
            if (value > result.high)
                highest = along[i];
            result.add(value);
        }
    }

    const RollingShutterCamera& camera;
    const AckermannMotion& motion;
    const bool horizontal;
    const int length;
    const double place;
};

} // namespace

Matx33d optimalMatrix(const RollingShutterCamera& camera, const AckermannMotion& motion, double alpha,
                      const Size& newSize, const Matx33d& fallback)
{
    const Interval top = Border(camera, motion, true, false).range(),
                   bottom = Border(camera, motion, true, true).range(),
                   left = Border(camera, motion, false, false).range(),
                   right = Border(camera, motion, false, true).range();
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
