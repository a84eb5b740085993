// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_TILE_RECTIFIER_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_TILE_RECTIFIER_HPP

#include "map_writer.hpp"
#include "patch.hpp"
#include "rectifier.hpp"

namespace cv {
namespace rsackermann {

/** Fills tiles of a rectify map (doc/theory.md, "Warp").

On each plane of the scene the map is smooth. A square of it is interpolated between 4 x 4 places for each plane that can be
seen in it, and every pixel takes the nearest plane. Further places in between tell the error; a square in which it is
too large, or in which one of the places doesn't exist, is divided into quarters, and small ones are solved pixel by pixel.
What a square becomes depends on its place alone: not on the size of the map, other tiles or the number of threads.
*/
class TileRectifier
{
public:
    //! @param matrix camera matrix of the global-shutter camera.
    TileRectifier(const Shutter& shutter, const Matx33d& matrix, int maxIterations, double tolerance);

    void fill(MapWriter::Tile& tile) const;

private:
    enum { PLANES = 4 };

    void fillSquare(const Rect& square, MapWriter::Tile& tile) const;
    bool fillByPatches(const Rect& square, MapWriter::Tile& tile) const;
    void fillByPixels(const Rect& area, MapWriter::Tile& tile) const;
    int visiblePlanes(const Rect& square, PlaneDepth visible[PLANES]) const;
    bool fitPatch(const Rect& square, const PlaneDepth& depth, Patch& patch) const;
    bool solve(const Rect& square, double column, double row, const PlaneDepth& depth, Rectifier::Guess& guess, Point2d& place) const;

    const Shutter& shutter;
    Rectifier forPixels, forPatches;
    Matx33d inverse;          // pixel of the global-shutter camera to ray
    Matx33d upright;          // pixel of the global-shutter camera to bearing
    Point2d timeSlope;        // row time per pixel of the global-shutter camera, but for motion and distortion
    PlaneDepth planes[PLANES]; // times the direction, relative to pixel (0, 0)
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_TILE_RECTIFIER_HPP
