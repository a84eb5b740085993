// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../../parallel_loop.hpp"
#include "../../prefetch.hpp"
#include "depth_kernels.hpp"
#include "fill_unknown.hpp"
#include "inverse_depth_image.hpp"

namespace cv { namespace rsackermann {

namespace {

// Values of a relative depth, whose scale and shift give inverse depths, those behind infinity being there; what is
// unknown becomes NaN.
template <class T>
void scaleDepths(const T* values, int width, float scale, float shift, float nearest, float* inverse)
{
    const float unknown = std::numeric_limits<float>::quiet_NaN();
    for (int x = 0; x < width; x++)
    {
        const float value = scale * float(values[x]) + shift;
        const bool known = value * nearest <= 1 && value >= -FLT_MAX; // neither is NaN
        inverse[x] = known ? std::max(value, 0.f) : unknown;
    }
}

// A part of a row of any kind of depth map.
template <class T>
void readRow(const DepthMap& depth, const Point& first, int width, double nearest, float* inverse)
{
    const T* values = depth.values.ptr<T>(first.y) + first.x;
    if (depth.kind == DEPTH_RELATIVE)
        scaleDepths(values, width, float(depth.scale), float(depth.shift), float(nearest), inverse);
    else
        invertDepths(values, width, float(1 / depth.scale), std::max(float(nearest / depth.scale), FLT_MIN), FLT_MAX,
                     inverse);
}

// Of BLOCK values.
float most(const float* v)
{
    return std::max(std::max(std::max(v[0], v[1]), std::max(v[2], v[3])),
                    std::max(std::max(v[4], v[5]), std::max(v[6], v[7])));
}

float least(const float* v)
{
    return std::min(std::min(std::min(v[0], v[1]), std::min(v[2], v[3])),
                    std::min(std::min(v[4], v[5]), std::min(v[6], v[7])));
}

} // namespace

void GivenDepths::read(const Point& first, int width, float* inverse) const
{
    if (depth.values.depth() == CV_16U)
        readRow<ushort>(depth, first, width, nearest, inverse);
    else
        readRow<float>(depth, first, width, nearest, inverse);
}

Mat1f GivenDepths::part(const Rect& area, float& low, float& high) const
{
    const int rowsAhead = 8, line = 64; // bytes that come together
    const int size = int(depth.values.elemSize()), last = depth.values.rows - 1;
    Mat1f values(area.size());
    for (int y = 0; y < area.height && isComplete; y++)
    {
        const uchar* ahead = depth.values.ptr(std::min(area.y + y + rowsAhead, last)) + area.x * size;
        for (int i = 0; i < area.width * size; i += line)
            prefetch(ahead + i);
        read(area.tl() + Point(0, y), area.width, values[y]);
    }
    if (!isComplete || !findRange(values, low, high))
    {
        isComplete = false;
        return Mat1f();
    }
    return values;
}

InverseDepthImage::InverseDepthImage(const DepthMap& depth, const ShutterGeometry& shutter, const Matx33d& matrix,
                                     double way, double nearest)
    : image(depth.values.size()), lastX(float(image.cols - 1)), lastY(float(image.rows - 1)), lowest(0), highest(0)
{
    const GivenDepths given(depth, nearest);
    std::vector<uchar> isComplete(image.rows);
    forEachInParallel(image.rows, [&](int y) {
        float low, high;
        given.read(Point(0, y), image.cols, image[y]);
        isComplete[y] = findRange(image.row(y), low, high);
    });
    if (std::find(isComplete.begin(), isComplete.end(), 0) != isComplete.end())
        fillUnknown(shutter, depth.camera == DEPTH_RAW, matrix, 1 / way, image);
    findRanges();
}

void InverseDepthImage::findRanges()
{
    lows.create((image.rows + BLOCK - 1) / BLOCK, (image.cols + BLOCK - 1) / BLOCK);
    highs.create(lows.size());
    steps.create(lows.size());
    parallel_for_(Range(0, lows.rows), [&](const Range& rows) {
        // Columns behind the image have what changes nothing.
        const size_t columns = size_t(lows.cols) * BLOCK;
        std::vector<float> low(columns, FLT_MAX), high(columns, -FLT_MAX), across(columns), down(columns);
        for (int i = rows.start; i < rows.end; i++)
        {
            const int first = i * BLOCK, last = std::min(first + BLOCK, image.rows) - 1;
            findColumnRanges(image, first, last, low.data(), high.data(), across.data(), down.data());
            for (int j = 0; j < lows.cols; j++)
            {
                const size_t left = size_t(j) * BLOCK;
                lows(i, j) = least(&low[left]);
                highs(i, j) = most(&high[left]);
                steps(i, j) = most(&across[left]) + most(&down[left]);
            }
        }
    });
    lowest = *std::min_element(lows.begin(), lows.end());
    highest = *std::max_element(highs.begin(), highs.end());
}

Mat1f InverseDepthImage::part(const Rect& area, float& low, float& high) const
{
    range(area, low, high);
    return image(area);
}

Rect InverseDepthImage::blocksOf(const Rect& area) const
{
    const Point last(image.cols - 1, image.rows - 1);
    const int left = std::min(std::max(area.x, 0), last.x) / BLOCK, top = std::min(std::max(area.y, 0), last.y) / BLOCK,
              right = std::min(std::max(area.br().x, 0), last.x) / BLOCK,
              bottom = std::min(std::max(area.br().y, 0), last.y) / BLOCK;
    return Rect(Point(left, top), Point(right + 1, bottom + 1));
}

void InverseDepthImage::range(const Rect& area, float& low, float& high) const
{
    const Rect blocks = blocksOf(area);
    low = FLT_MAX;
    high = -FLT_MAX;
    for (int i = blocks.y; i < blocks.br().y; i++)
        for (int j = blocks.x; j < blocks.br().x; j++)
        {
            low = std::min(low, lows(i, j));
            high = std::max(high, highs(i, j));
        }
}

float InverseDepthImage::steepest(const Rect& area) const
{
    const Rect blocks = blocksOf(area);
    float most = 0;
    for (int i = blocks.y; i < blocks.br().y; i++)
        for (int j = blocks.x; j < blocks.br().x; j++)
            most = std::max(most, steps(i, j));
    return most;
}

}} // namespace cv::rsackermann
