// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_OTHER_DEPTH_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_OTHER_DEPTH_HPP

#include "../depth/inverse_depth_image.hpp"
#include "depth_patch.hpp"
#include "tile_filler.hpp"

namespace cv { namespace rsackermann {

/** Fills tiles of a map from the depth in the other camera.

The places that a pixel may show lie on a curve in the other image, one for each depth. From the nearest depth on it is
followed to the first place at which the depth is that of the curve: this surface hides all behind it. Where the curve
passes between two surfaces without meeting one, no pixel of the other image shows the pixel; then it is mapped to the
surface behind (doc/theory.md, "Warp").
*/
class TileOtherDepth CV_FINAL : public TileFiller
{
public:
    TileOtherDepth(const DepthPlaces& places_, const InverseDepthImage& depths_) : places(places_), depths(depths_) {}

protected:
    bool fillByPatches(const Rect& square, MapWriter::Tile& tile) const CV_OVERRIDE;
    void fillByPixels(const Rect& area, MapWriter::Tile& tile) const CV_OVERRIDE;

private:
    void fillBlock(const DepthPatch& patch, const Point& first, float low, float high, const Rect& block,
                   MapWriter::Tile& tile) const;

    const DepthPlaces& places;
    const InverseDepthImage& depths;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_OTHER_DEPTH_HPP
