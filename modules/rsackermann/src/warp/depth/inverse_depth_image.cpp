// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "fill_unknown.hpp"
#include "inverse_depth_image.hpp"

namespace cv { namespace rsackermann {

namespace {

// Values of the depth map to inverse depths; what is unknown becomes NaN. Both limits are in units of the values.
template <class T>
bool invertRow(const T* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse)
{
    const float unknown = std::numeric_limits<float>::quiet_NaN();
    int count = 0;
    for (int x = 0; x < width; x++)
    {
        const float depth = float(depths[x]);
        const bool known = depth >= nearest && depth <= farthest;
        inverse[x] = known ? unitsPerMetre / depth : unknown;
        count += known;
    }
    return count == width;
}

// The same of a relative depth, whose scale and shift give inverse depths, those behind infinity being there.
template <class T>
bool scaleRow(const T* values, int width, float scale, float shift, float nearest, float* inverse)
{
    const float unknown = std::numeric_limits<float>::quiet_NaN();
    int count = 0;
    for (int x = 0; x < width; x++)
    {
        const float value = scale * float(values[x]) + shift;
        const bool known = value * nearest <= 1 && value >= -FLT_MAX; // neither is NaN
        inverse[x] = known ? std::max(value, 0.f) : unknown;
        count += known;
    }
    return count == width;
}

// One row of any kind of depth map; false if some of it is unknown.
template <class T>
bool readRow(const DepthMap& depth, int y, double nearest, float* inverse)
{
    const T* values = depth.values.ptr<T>(y);
    const int width = depth.values.cols;
    if (depth.kind == DEPTH_RELATIVE)
        return scaleRow(values, width, float(depth.scale), float(depth.shift), float(nearest), inverse);
    return invertRow(values, width, float(1 / depth.scale), std::max(float(nearest / depth.scale), FLT_MIN), FLT_MAX,
                     inverse);
}

} // namespace

InverseDepthImage::InverseDepthImage(const DepthMap& depth, const ShutterGeometry& shutter, const Matx33d& matrix,
                                     double way, double nearest)
    : image(depth.values.size()), lastX(float(image.cols - 1)), lastY(float(image.rows - 1)), lowest(0), highest(0)
{
    std::vector<uchar> isComplete(image.rows);
    parallel_for_(Range(0, image.rows), [&](const Range& rows) {
        for (int y = rows.start; y < rows.end; y++)
            isComplete[y] = depth.values.depth() == CV_16U ? readRow<ushort>(depth, y, nearest, image[y])
                                                           : readRow<float>(depth, y, nearest, image[y]);
    });
    if (std::find(isComplete.begin(), isComplete.end(), 0) != isComplete.end())
        fillUnknown(SceneDepth(shutter, image.size(), depth.camera == DEPTH_RAW, matrix), 1 / way, image);
    findRanges();
}

void InverseDepthImage::findRanges()
{
    lows.create((image.rows + BLOCK - 1) / BLOCK, (image.cols + BLOCK - 1) / BLOCK);
    highs.create(lows.size());
    steps.create(lows.size());
    parallel_for_(Range(0, lows.rows), [&](const Range& rows) {
        std::vector<float> low(image.cols), high(image.cols), across(image.cols), down(image.cols);
        for (int i = rows.start; i < rows.end; i++)
        {
            const int first = i * BLOCK, last = std::min(first + BLOCK, image.rows) - 1;
            std::copy(image[first], image[first] + image.cols, low.begin());
            high = low;
            std::fill(across.begin(), across.end(), 0.f);
            std::fill(down.begin(), down.end(), 0.f);
            for (int y = first; y <= last; y++)
            {
                const float *values = image[y], *next = image[std::min(y + 1, image.rows - 1)];
                for (int x = 0; x < image.cols; x++)
                {
                    low[x] = std::min(low[x], values[x]);
                    high[x] = std::max(high[x], values[x]);
                    down[x] = std::max(down[x], std::abs(next[x] - values[x]));
                }
                for (int x = 0; x + 1 < image.cols; x++)
                    across[x] = std::max(across[x], std::abs(values[x + 1] - values[x]));
            }
            for (int j = 0; j < lows.cols; j++)
            {
                const int left = j * BLOCK, right = std::min(left + BLOCK, image.cols);
                lows(i, j) = *std::min_element(low.begin() + left, low.begin() + right);
                highs(i, j) = *std::max_element(high.begin() + left, high.begin() + right);
                steps(i, j) = *std::max_element(across.begin() + left, across.begin() + right) +
                              *std::max_element(down.begin() + left, down.begin() + right);
            }
        }
    });
    lowest = *std::min_element(lows.begin(), lows.end());
    highest = *std::max_element(highs.begin(), highs.end());
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
