// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_DISTORTER_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_DISTORTER_HPP

#include "../distorter.hpp"
#include "map_patch.hpp"
#include "tile_filler.hpp"

namespace cv { namespace rsackermann {

//! Fills tiles of a distort map. Where several planes can be seen their scaled inverse depths are interpolated as well.
class TileDistorter CV_FINAL : public TileFiller
{
public:
    //! @param matrix camera matrix of the global-shutter camera.
    TileDistorter(const ShutterGeometry& shutter, const Matx33d& matrix);

protected:
    bool fillByPatches(const Rect& square, MapWriter::Tile& tile) const CV_OVERRIDE;
    void fillByPixels(const Rect& area, MapWriter::Tile& tile) const CV_OVERRIDE;

private:
    enum { PLANES = Scene::PLANES, NODES = MapPatch::NODES };

    // A pixel with the scaled inverse depths of all planes, times the direction: the largest is the nearest.
    struct Node
    {
        Distorter::View view;
        double depths[PLANES];
    };

    // The nodes of a square, and the pixels at which errors are measured.
    struct Nodes
    {
        double step;
        Node grid[NODES][NODES], checks[MapPatch::CHECKS_WITH_KNOTS];
    };

    bool evaluate(const Point2d& pixel, Node& node) const;
    bool evaluate(const Rect& square, Nodes& nodes) const;
    int visiblePlanes(const Nodes& nodes, int (&visible)[PLANES]) const;
    bool fitPatch(const Nodes& nodes, int plane, MapPatch& patch) const;
    bool fitDepth(const Nodes& nodes, int plane, Bicubic& depth) const;
    bool place(const Node& node, double depth, Point2d& place) const;

    const ShutterGeometry& shutter;
    Distorter distorter;
    Matx33d matrix;
    int checks; // of MapPatch
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_TILE_DISTORTER_HPP
