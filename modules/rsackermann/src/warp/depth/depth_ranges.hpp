// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DEPTH_DEPTH_RANGES_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DEPTH_DEPTH_RANGES_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

//! Some values of an image.
struct DepthRange
{
    float low = FLT_MAX, high = -FLT_MAX;
    float steepest = 0; //!< the largest differences to a neighbour, across plus down

    void add(const DepthRange& other)
    {
        low = std::min(low, other.low);
        high = std::max(high, other.high);
        steepest = std::max(steepest, other.steepest);
    }
};

//! Ranges of the values in any rectangle of an image, from those of blocks of several sizes.
class DepthRanges
{
public:
    //! @param image whose values are all known.
    void find(const Mat1f& image);

    //! That of a rectangle of pixels, of which the next ones within the image count if it is outside; never too narrow.
    DepthRange of(const Rect& area) const;

    //! That of the whole image.
    const DepthRange& ofAll() const { return all; }

private:
    // Blocks of a size, row by row.
    struct Level
    {
        Size size;
        std::vector<DepthRange> blocks;

        explicit Level(const Size& size_) : size(size_), blocks(size.area()) {}
    };

    enum { BLOCK = 8 }; // pixels, on the first level; of every other one twice as many as on the one before

    void addLevel();

    Point last; // pixel
    std::vector<Level> levels;
    DepthRange all;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DEPTH_DEPTH_RANGES_HPP
