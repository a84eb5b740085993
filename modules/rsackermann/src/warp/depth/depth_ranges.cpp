// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "depth_kernels.hpp"
#include "depth_ranges.hpp"

namespace cv { namespace rsackermann {

// Of count values.
static float least(const float* values, int count)
{
    return *std::min_element(values, values + count);
}

static float most(const float* values, int count)
{
    return *std::max_element(values, values + count);
}

void DepthRanges::find(const Mat1f& image)
{
    last = Point(image.cols - 1, image.rows - 1);
    levels.clear();
    levels.push_back(Level(Size(last.x / BLOCK + 1, last.y / BLOCK + 1)));
    Level& blocks = levels[0];
    parallel_for_(Range(0, blocks.size.height), [&](const Range& rows) {
        std::vector<float> low(image.cols), high(image.cols), across(image.cols), down(image.cols);
        for (int i = rows.start; i < rows.end; i++)
        {
            findColumnRanges(image, i * BLOCK, std::min(i * BLOCK + BLOCK - 1, last.y), low.data(), high.data(),
                             across.data(), down.data());
            for (int j = 0; j < blocks.size.width; j++)
            {
                const int left = j * BLOCK, count = std::min(int(BLOCK), image.cols - left);
                DepthRange& block = blocks.blocks[size_t(i) * blocks.size.width + j];
                block.low = least(&low[left], count);
                block.high = most(&high[left], count);
                block.steepest = most(&across[left], count) + most(&down[left], count);
            }
        }
    });
    while (levels.back().size.area() > 1)
        addLevel();
    all = levels.back().blocks[0];
}

void DepthRanges::addLevel()
{
    const Level& fine = levels.back();
    Level coarse(Size((fine.size.width + 1) / 2, (fine.size.height + 1) / 2));
    for (int i = 0; i < fine.size.height; i++)
        for (int j = 0; j < fine.size.width; j++)
            coarse.blocks[size_t(i / 2) * coarse.size.width + j / 2].add(fine.blocks[size_t(i) * fine.size.width + j]);
    levels.push_back(std::move(coarse));
}

DepthRange DepthRanges::of(const Rect& area) const
{
    const int most = 4; // blocks along an axis, or one more: fewer would reach far beyond the rectangle
    const auto inside = [](int value, int limit) { return std::min(std::max(value, 0), limit); };
    Point first(inside(area.x, last.x) / BLOCK, inside(area.y, last.y) / BLOCK),
        end(inside(area.br().x, last.x) / BLOCK, inside(area.br().y, last.y) / BLOCK);
    size_t k = 0;
    for (; std::max(end.x - first.x, end.y - first.y) > most; k++)
    {
        first = Point(first.x / 2, first.y / 2);
        end = Point(end.x / 2, end.y / 2);
    }
    DepthRange range;
    for (int i = first.y; i <= end.y; i++)
        for (int j = first.x; j <= end.x; j++)
            range.add(levels[k].blocks[size_t(i) * levels[k].size.width + j]);
    return range;
}

}} // namespace cv::rsackermann
