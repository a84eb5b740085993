// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_DEPTH_TILES_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_DEPTH_TILES_HPP

#include "../depth/visibility.hpp"
#include "maps.hpp"

namespace cv { namespace rsackermann {

//! Fills a map of which each pixel's own depth is known. @param visibility null: of no interest.
void fillByOwnDepth(const DepthPlaces& places, const InverseDepths& depths, const Visibility* visibility,
                    MapWriter& writer);
//! Fills a map from the depth in the other camera.
void fillByOtherDepth(const DepthPlaces& places, const InverseDepthImage& depths, MapWriter& writer);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_DEPTH_TILES_HPP
