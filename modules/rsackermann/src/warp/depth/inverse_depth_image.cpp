// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../../parallel_loop.hpp"
#include "depth_kernels.hpp"
#include "inverse_depth_image.hpp"

namespace cv { namespace rsackermann {

namespace {

// Values of a relative depth, whose scale and shift give inverse depths, those behind infinity being there; what is
// unknown becomes NaN.
template <class T>
bool scaleDepths(const T* values, int width, float scale, float shift, float nearest, float* inverse)
{
    const float unknown = std::numeric_limits<float>::quiet_NaN();
    int missing = 0;
    for (int x = 0; x < width; x++)
    {
        const float value = scale * float(values[x]) + shift;
        const bool known = value * nearest <= 1 && value >= -FLT_MAX; // neither is NaN
        inverse[x] = known ? std::max(value, 0.f) : unknown;
        missing |= !known;
    }
    return missing == 0;
}

// A part of a row of any kind of depth map.
template <class T>
bool readRow(const DepthMap& depth, const Point& first, int width, double nearest, float* inverse)
{
    const T* values = depth.values.ptr<T>(first.y) + first.x;
    if (depth.kind == DEPTH_RELATIVE)
        return scaleDepths(values, width, float(depth.scale), float(depth.shift), float(nearest), inverse);
    return invertDepths(values, width, float(1 / depth.scale), std::max(float(nearest / depth.scale), FLT_MIN), FLT_MAX,
                        inverse);
}

// Has the processor bring a part of a row from memory, where rows of a part of an image are far from each other.
void prefetchRow(const uchar* first, int bytes)
{
#ifdef __GNUC__
    const int line = 64; // bytes that come together
    for (int i = 0; i < bytes; i += line)
        __builtin_prefetch(first + i);
#else
    (void)first, (void)bytes;
#endif
}

} // namespace

bool GivenDepths::read(const Point& first, int width, float* inverse) const
{
    if (depth.values.depth() == CV_16U)
        return readRow<ushort>(depth, first, width, nearest, inverse);
    return readRow<float>(depth, first, width, nearest, inverse);
}

Mat1f GivenDepths::part(const Rect& area, float& low, float& high) const
{
    const int rowsAhead = 8;
    const int size = int(depth.values.elemSize()), last = depth.values.rows - 1;
    Mat1f values(area.size());
    for (int y = 0; y < area.height && isComplete; y++)
    {
        prefetchRow(depth.values.ptr(std::min(area.y + y + rowsAhead, last)) + area.x * size, area.width * size);
        if (!read(area.tl() + Point(0, y), area.width, values[y]))
            isComplete = false;
    }
    if (!isComplete)
        return Mat1f();
    findRange(values, low, high);
    return values;
}

InverseDepthImage::InverseDepthImage(const DepthMap& depth, const ShutterGeometry& shutter, const Matx33d& matrix,
                                     double way, double nearest)
    : image(depth.values.size()), lastX(float(image.cols - 1)), lastY(float(image.rows - 1))
{
    const GivenDepths given(depth, nearest);
    std::vector<uchar> isComplete(image.rows);
    forEachInParallel(image.rows, [&](int y) { isComplete[y] = given.read(Point(0, y), image.cols, image[y]); });
    if (std::find(isComplete.begin(), isComplete.end(), 0) != isComplete.end())
        fillUnknown(shutter, depth.camera == DEPTH_RAW, matrix, 1 / way, image);
    ranges.find(image);
}

Mat1f InverseDepthImage::part(const Rect& area, float& low, float& high) const
{
    const DepthRange range = ranges.of(area);
    low = range.low;
    high = range.high;
    return image(area);
}

}} // namespace cv::rsackermann
