// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_OWN_DEPTH_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_OWN_DEPTH_HPP

#include "../depth/depth_places.hpp"
#include "../depth/inverse_depth_image.hpp"
#include "../depth/visibility.hpp"
#include "tile_filler.hpp"

namespace cv { namespace rsackermann {

//! Fills tiles of a map of which each pixel's own depth is known.
class TileOwnDepth CV_FINAL : public TileFiller
{
public:
    //! @param visibility null: of no interest.
    TileOwnDepth(const DepthPlaces& places_, const InverseDepths& depths_, const Visibility* visibility_)
        : places(places_), depths(depths_), visibility(visibility_)
    {
    }

protected:
    bool fillByPatches(const Rect& square, MapWriter::Tile& tile) const CV_OVERRIDE;
    void fillByPixels(const Rect& area, MapWriter::Tile& tile) const CV_OVERRIDE;

private:
    const DepthPlaces& places;
    const InverseDepths& depths;
    const Visibility* visibility;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_OWN_DEPTH_HPP
