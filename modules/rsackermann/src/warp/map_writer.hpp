// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAP_WRITER_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAP_WRITER_HPP

#include "opencv2/core.hpp"

namespace cv {
namespace rsackermann {

//! The type that stands for m1type in the contract of cv::initUndistortRectifyMap; throws for other than its three types.
int normalizedMapType(int m1type);

/** Writes maps for cv::remap row by row in the three formats of cv::initUndistortRectifyMap, and their mask.

Rows may be written by several threads.
*/
class MapWriter
{
public:
    /**
    @param size size of the maps.
    @param target size of the image that the maps point into.
    @param m1type as normalizedMapType() returns it.
    @param map1 allocated where it hasn't the size and type.
    @param map2 the same, or released where the format has none.
    @param mask allocated if it is wanted.
    */
    MapWriter(const Size& size, const Size& target, int m1type, OutputArray map1, OutputArray map2, OutputArray mask);

    //! Only the mask.
    MapWriter(const Size& target, Mat& mask);

    //! Coordinates of one row, to be filled between the constructor and write().
    class Row
    {
    public:
        Row(MapWriter& writer, int row);
        void set(int column, const Point2d& place);
        void setNone(int column);
        //! Writes the coordinates into the maps and the mask.
        void write();

    private:
        MapWriter& writer;
        int row;
        AutoBuffer<float> buffer;
        float* x;
        float* y;
    };

    Size size() const { return mapSize; }

private:
    Size mapSize, target;
    int type; // of map1; -1: no maps
    Mat map1, map2, mask;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAP_WRITER_HPP
