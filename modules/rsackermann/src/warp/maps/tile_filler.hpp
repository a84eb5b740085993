// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_FILLER_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_FILLER_HPP

#include "map_writer.hpp"

namespace cv { namespace rsackermann {

/** Fills tiles of a map (doc/theory.md, "Warp").

On each plane of the scene a map is smooth. A square of it is interpolated between 4 x 4 places for each plane that can
be seen in it, and every pixel takes the nearest plane. Further places in between show the error; a square in which it
is too large, or in which one of the places doesn't exist, is divided into quarters, and small ones are solved pixel by
pixel. The values of a square depend on its place alone: not on the size of the map, other tiles or the number of
threads.
*/
class TileFiller
{
public:
    virtual ~TileFiller() {}

    void fill(MapWriter::Tile& tile) const;

protected:
    //! Fills what the tile has of a square; false if it can't be interpolated; it is undefined then.
    virtual bool fillByPatches(const Rect& square, MapWriter::Tile& tile) const = 0;
    virtual void fillByPixels(const Rect& area, MapWriter::Tile& tile) const = 0;

private:
    void fillSquare(const Rect& square, MapWriter::Tile& tile) const;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_FILLER_HPP
