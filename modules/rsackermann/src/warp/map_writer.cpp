// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "opencv2/imgproc.hpp"
#include "map_writer.hpp"
#include "pixels.hpp"

namespace cv {
namespace rsackermann {

int normalizedMapType(int m1type)
{
    if (m1type <= 0)
        return CV_16SC2;
    if (m1type != CV_32FC1 && m1type != CV_32FC2 && m1type != CV_16SC2)
        CV_Error(Error::StsBadArg, format("m1type is %d; CV_32FC1 (%d), CV_32FC2 (%d) or CV_16SC2 (%d) is expected", m1type, CV_32FC1,
                                          CV_32FC2, CV_16SC2));
    return m1type;
}

MapWriter::MapWriter(const Size& size, const Size& target_, int m1type, OutputArray map1_, OutputArray map2_, OutputArray mask_)
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

MapWriter::Row::Row(MapWriter& writer_, int row_) : writer(writer_), row(row_)
{
    if (writer.type == CV_32FC1)
    {
        x = writer.map1.ptr<float>(row);
        y = writer.map2.ptr<float>(row);
        return;
    }
    buffer.allocate(2 * writer.mapSize.width);
    x = buffer.data();
    y = x + writer.mapSize.width;
}

void MapWriter::Row::set(int column, const Point2d& place)
{
    if (!isAddressable(place))
        return setNone(column);
    x[column] = float(place.x);
    y[column] = float(place.y);
}

void MapWriter::Row::setNone(int column)
{
    x[column] = y[column] = FAR_OUTSIDE;
}

// Fixed point with INTER_BITS fractional bits; the same for every column, whatever the width.
static void packFixedPoint(const float* x, const float* y, int width, short* whole, ushort* fraction)
{
    for (int i = 0; i < width; i++)
    {
        const int ix = saturate_cast<int>(x[i] * INTER_TAB_SIZE), iy = saturate_cast<int>(y[i] * INTER_TAB_SIZE);
        whole[2 * i] = saturate_cast<short>(ix >> INTER_BITS);
        whole[2 * i + 1] = saturate_cast<short>(iy >> INTER_BITS);
        fraction[i] = ushort((iy & (INTER_TAB_SIZE - 1)) * INTER_TAB_SIZE + (ix & (INTER_TAB_SIZE - 1)));
    }
}

static void packInterleaved(const float* x, const float* y, int width, float* xy)
{
    for (int i = 0; i < width; i++)
    {
        xy[2 * i] = x[i];
        xy[2 * i + 1] = y[i];
    }
}

void MapWriter::Row::write()
{
    const int width = writer.mapSize.width;
    if (writer.type == CV_16SC2)
        packFixedPoint(x, y, width, writer.map1.ptr<short>(row), writer.map2.ptr<ushort>(row));
    else if (writer.type == CV_32FC2)
        packInterleaved(x, y, width, writer.map1.ptr<float>(row));
    if (writer.mask.empty())
        return;
    uchar* seen = writer.mask.ptr(row);
    for (int i = 0; i < width; i++)
        seen[i] = isInImage(x[i], y[i], writer.target) ? 255 : 0;
}

}} // namespace cv::rsackermann
