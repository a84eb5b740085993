// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../../checks.hpp"
#include "map_kernels.hpp"
#include "map_writer.hpp"
#include "opencv2/rsackermann/depth_map.hpp"
#include "remap_limits.hpp"

namespace cv { namespace rsackermann {

int normalizedMapType(int m1type)
{
    if (m1type <= 0)
        return CV_16SC2;
    REJECT_IF(m1type != CV_32FC1 && m1type != CV_32FC2 && m1type != CV_16SC2,
              "m1type is %d; CV_32FC1 (%d), CV_32FC2 (%d) or CV_16SC2 (%d) is expected", m1type, CV_32FC1, CV_32FC2,
              CV_16SC2);
    return m1type;
}

MapWriter::MapWriter(const Size& size, const Size& target_, int m1type, OutputArray map1_, OutputArray map2_,
                     OutputArray mask_)
    : mapSize(size), target(target_), type(m1type)
{
    map1_.create(size, type);
    map1 = map1_.getMat();
    if (type == CV_32FC2)
        map2_.release();
    else
    {
        map2_.create(size, type == CV_16SC2 ? CV_16UC1 : CV_32FC1);
        map2 = map2_.getMat();
    }
    if (mask_.needed())
    {
        mask_.create(size, CV_8UC1);
        mask = mask_.getMat();
    }
}

MapWriter::MapWriter(const Size& target_, Mat& mask_) : mapSize(mask_.size()), target(target_), type(-1), mask(mask_)
{
    CV_DbgAssert(mask.type() == CV_8UC1);
}

MapWriter::Tile::Tile(MapWriter& writer_, int index, std::vector<float>& buffer)
    : writer(writer_), part(Rect(index % writer.tilesAcross() * TILE, index / writer.tilesAcross() * TILE, TILE, TILE))
{
    const bool whole = part.br().x <= writer.mapSize.width;
    part &= Rect(Point(), writer.mapSize);
    mask(part).setTo(MASK_SEEN);
    // If nothing would be written beyond its end the map itself takes the coordinates.
    inPlace = writer.type == CV_32FC1 && whole && writer.map1.step == writer.map2.step;
    if (inPlace)
    {
        firstX = writer.map1.ptr<float>(part.y) + part.x;
        firstY = writer.map2.ptr<float>(part.y) + part.x;
        step = writer.map1.step1();
        return;
    }
    buffer.resize(2 * TILE * TILE);
    firstX = buffer.data();
    firstY = firstX + TILE * TILE;
    step = TILE;
}

void MapWriter::Tile::set(const Point& pixel, bool exists, const Point2d& place)
{
    const bool isPlace = exists && isAddressable(place);
    *x(pixel) = isPlace ? float(place.x) : FAR_OUTSIDE;
    *y(pixel) = isPlace ? float(place.y) : FAR_OUTSIDE;
}

void MapWriter::Tile::hide(const Point& pixel) const
{
    if (writer.hasMask())
        writer.mask.at<uchar>(pixel) = MASK_HIDDEN;
}

void MapWriter::Tile::write()
{
    const bool masked = writer.hasMask();
    if (inPlace && !masked)
        return;
    const Mat tile[] = {Mat(part.size(), CV_32F, x(part.tl()), step * sizeof(float)),
                        Mat(part.size(), CV_32F, y(part.tl()), step * sizeof(float))};
    if (writer.type == CV_32FC2)
        merge(tile, 2, writer.map1(part));
    else if (writer.type == CV_32FC1 && !inPlace)
    {
        tile[0].copyTo(writer.map1(part));
        tile[1].copyTo(writer.map2(part));
    }
    for (int i = 0; i < part.height; i++)
    {
        const Point first(part.x, part.y + i);
        // OpenCV's convertMaps and inRange have narrower vectors: all took half as long again.
        if (writer.type == CV_16SC2)
            packFixedPoint(x(first), y(first), part.width, writer.map1.ptr<short>(first.y) + 2 * first.x,
                           writer.map2.ptr<ushort>(first.y) + first.x);
        if (masked)
            packMask(x(first), y(first), part.width, -ROUNDED_PIXEL, float(writer.target.width - 1) + ROUNDED_PIXEL,
                     float(writer.target.height - 1) + ROUNDED_PIXEL, writer.mask.ptr(first.y) + first.x);
    }
}

}} // namespace cv::rsackermann
