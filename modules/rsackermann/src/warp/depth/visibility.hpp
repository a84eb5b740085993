// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DEPTH_VISIBILITY_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DEPTH_VISIBILITY_HPP

#include "../maps/depth_patch.hpp"
#include "../maps/map_writer.hpp"
#include "inverse_depth_image.hpp"

namespace cv { namespace rsackermann {

//! Whether the other image shows pixels of known depth at their places, or something in front of them.
class Visibility
{
public:
    /** @param back places of the pixels of the other image in the map's own image.
        @param depths of the map's own image.
        @param size of the other image: what is outside of it counts as seen. */
    Visibility(const DepthPlaces& back_, const InverseDepthImage& depths_, const Size& size)
        : back(back_), depths(depths_), lastX(float(size.width - 1)), lastY(float(size.height - 1))
    {
    }

    /** Marks the hidden ones among the pixels of a block in the tile.
    @param own the block's part of the map, for all depths in it.
    @param first pixel of this patch.
    @param tile has the places of the pixels. */
    void find(const DepthPatch& own, const Point& first, const Rect& block, const MapWriter::Tile& tile) const;
    //! The same without a patch, and slowly.
    void findByPixels(const Rect& block, const MapWriter::Tile& tile) const;

private:
    // Of the map and of the opposite one, with their first pixels.
    struct Patches
    {
        const DepthPatch& own;
        Point ownFirst;
        const DepthPatch& back;
        Point backFirst;
    };

    Rect placesOf(const DepthPatch& own, const Point& first, const Rect& block) const;
    void findByPatches(const Patches& patches, float low, float high, const Rect& block,
                       const MapWriter::Tile& tile) const;

    const DepthPlaces& back;
    const InverseDepthImage& depths;
    float lastX, lastY;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DEPTH_VISIBILITY_HPP
