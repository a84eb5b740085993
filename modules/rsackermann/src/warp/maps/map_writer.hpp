// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAP_WRITER_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAP_WRITER_HPP

#include "map_patch.hpp"
#include <functional>

namespace cv { namespace rsackermann {

//! The type that stands for m1type in the contract of cv::initUndistortRectifyMap; throws for other than its three
//! types.
int normalizedMapType(int m1type);

/** Writes maps for cv::remap tile by tile in the three formats of cv::initUndistortRectifyMap, and their mask.

Tiles may be written by several threads.
*/
class MapWriter
{
public:
    /**
    @param size size of the maps.
    @param target size of the image that the maps point into.
    @param m1type as normalizedMapType() returns it.
    @param map1 allocated unless it has the size and type.
    @param map2 the same, or released if the format has none.
    @param mask allocated if it is wanted.
    */
    MapWriter(const Size& size, const Size& target, int m1type, OutputArray map1, OutputArray map2, OutputArray mask);

    //! Only the mask.
    MapWriter(const Size& target, Mat& mask);

    //! Number of pixels along both sides of a tile.
    static const int TILE = 128;

    /** Coordinates of one tile, to be filled between the constructor and write().

    All TILE of a row may be filled, also where the map ends before.
    */
    class Tile
    {
    public:
        /**
        @param index of the tile, 0 ... tiles() - 1.
        @param buffer for the coordinates, unless the maps themselves can take them; of one tile at a time. It isn't
        part of the tile, for which a thread's stack may be too small.
        */
        Tile(MapWriter& writer, int index, std::vector<float>& buffer);
        //! The part of the map that the tile has.
        const Rect& area() const { return part; }
        //! Coordinates of a pixel, with step floats from row to row.
        float* x(const Point& pixel) const { return firstX + offset(pixel); }
        float* y(const Point& pixel) const { return firstY + offset(pixel); }
        //! Those of a block.
        Coordinates at(const Rect& block) const { return {x(block.tl()), y(block.tl()), step, block.size()}; }
        //! Those of the tile's rows of a square, which may end later.
        Coordinates rowsOf(const Rect& square) const
        {
            return at(Rect(square.tl(), Size(square.width, (square & part).height)));
        }
        //! @param exists whether there is a place.
        void set(const Point& pixel, bool exists, const Point2d& place = Point2d());
        //! The mask of some pixels of the tile, in which they are seen unless a filler marks them; or empty.
        Mat1b mask(const Rect& block) const { return writer.mask.empty() ? Mat1b() : Mat1b(writer.mask(block)); }
        void hide(const Point& pixel) const;
        //! Writes the coordinates into the maps and the mask.
        void write();

        size_t step;

    private:
        size_t offset(const Point& pixel) const { return (pixel.y - part.y) * step + (pixel.x - part.x); }

        MapWriter& writer;
        Rect part;
        float* firstX;
        float* firstY;
        bool inPlace; // in the maps
    };

    /** Called, if there is one, by the thread that has written a tile.
    @param area of the map.
    @param start getTickCount() when the tile was begun. */
    std::function<void(const Rect& area, int64 start)> whenWritten;

    bool hasMask() const { return !mask.empty(); }
    int tiles() const { return tilesAcross() * ((mapSize.height + TILE - 1) / TILE); }

private:
    int tilesAcross() const { return (mapSize.width + TILE - 1) / TILE; }

    Size mapSize, target;
    int type; // of map1; -1: no maps
    Mat map1, map2, mask;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAP_WRITER_HPP
