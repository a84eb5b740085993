// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_EXPORT_WARP_MESH_HPP
#define RSACKERMANN_SAMPLES_EXPORT_WARP_MESH_HPP

#include "frames.hpp"

namespace rsackermann_samples {

/** A grid of nodes over the corrected image with the place of each in the raw image, for warpers that interpolate
between nodes. The outer nodes are the centres of the outer pixels. */
struct WarpMesh
{
    int columns, rows;
    std::vector<cv::Point2d> nodes;  //!< in the corrected image, row by row
    std::vector<cv::Point2d> places; //!< in the raw image
    std::vector<uchar> found;        //!< whether a node has a place
    //! Distance in pixels between the bilinear interpolation and the exact place, of the pixels that both have inside
    //! of the raw image.
    double maxError, rmsError;
};

//! @param columns, rows number of nodes, at least 2.
WarpMesh makeWarpMesh(const cv::rsackermann::RollingShutterCamera& camera,
                      const cv::rsackermann::AckermannMotion& motion, int columns, int rows);

//! The meshes of all frames as JSON; see doc/exports.md.
std::string warpMeshText(const cv::rsackermann::RollingShutterCamera& camera, const std::vector<MotionFrame>& frames,
                         int columns, int rows);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_EXPORT_WARP_MESH_HPP
