// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_RECTIFIER_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_RECTIFIER_HPP

#include "map_patch.hpp"
#include "../rectifier.hpp"
#include "tile_filler.hpp"

namespace cv { namespace rsackermann {

//! Fills tiles of a rectify map. On a plane the scaled inverse depth is a linear function of the pixel.
class TileRectifier CV_FINAL : public TileFiller
{
public:
    //! @param matrix camera matrix of the global-shutter camera.
    TileRectifier(const ShutterGeometry& shutter, const Matx33d& matrix, int maxIterations, double tolerance);

protected:
    bool fillByPatches(const Rect& square, MapWriter::Tile& tile) const CV_OVERRIDE;
    void fillByPixels(const Rect& area, MapWriter::Tile& tile) const CV_OVERRIDE;

private:
    enum { PLANES = Scene::PLANES };

    bool isSmooth(const Rect& square) const;
    int visiblePlanes(const Rect& square, PlaneInverseDepth visible[PLANES]) const;
    bool fitPatch(const Rect& square, const PlaneInverseDepth& depth, MapPatch& patch) const;
    bool solve(const Rect& square, double column, double row, const PlaneInverseDepth& depth, Rectifier::Guess& guess,
               Point2d& place) const;

    const ShutterGeometry& shutter;
    Rectifier forPixels, forPatches;
    Matx33d inverse;                  // pixel of the global-shutter camera to ray
    Matx33d upright;                  // pixel of the global-shutter camera to bearing
    Point2d timeSlope;                // row time per pixel of the global-shutter camera, but for motion and distortion
    PlaneInverseDepth planes[PLANES]; // times the direction, relative to pixel (0, 0)
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_RECTIFIER_HPP
