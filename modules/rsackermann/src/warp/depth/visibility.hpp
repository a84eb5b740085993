// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DEPTH_VISIBILITY_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DEPTH_VISIBILITY_HPP

#include "depth_places.hpp"
#include "inverse_depth_image.hpp"

namespace cv { namespace rsackermann {

//! Whether the other image shows a pixel of known depth at its place, or something in front of it.
class Visibility
{
public:
    /** @param back places of the pixels of the other image in the map's own image.
        @param depths of the map's own image.
        @param columns, rows the map that follows from them, CV_32F. */
    Visibility(const DepthPlaces& back_, const InverseDepthImage& depths_, const Mat1f& columns_, const Mat1f& rows_)
        : back(back_), depths(depths_), columns(columns_), rows(rows_)
    {
    }

    //! @param place of the pixel; what is outside of the other image counts as seen.
    bool isSeen(const Point& pixel, const Point2f& place) const;

private:
    bool showsInMap(const Point& pixel, const Point2f& place) const;

    const DepthPlaces& back;
    const InverseDepthImage& depths;
    Mat1f columns, rows;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DEPTH_VISIBILITY_HPP
