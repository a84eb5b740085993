// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../opencv_versions.hpp"
#include "opencv2/core.hpp"
#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY
#include "../../simd_pack.hpp"
#endif

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

bool invertDepths(const float* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse);
bool invertDepths(const ushort* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse);
void findRange(const Mat1f& values, float& low, float& high);
void findColumnRanges(const Mat1f& image, int first, int last, float* low, float* high, float* across, float* down);

#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

namespace {

typedef PackOf<float> Pack;

// A loop that compilers turn into vectors.
template <class T>
bool invert(const T* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse)
{
    const float unknown = std::numeric_limits<float>::quiet_NaN();
    int missing = 0;
    for (int x = 0; x < width; x++)
    {
        const float depth = float(depths[x]), value = unitsPerMetre / depth;
        const bool known = depth >= nearest && depth <= farthest;
        inverse[x] = known ? value : unknown;
        missing |= !known;
    }
    return missing == 0;
}

} // namespace

bool invertDepths(const float* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse)
{
    return invert(depths, width, unitsPerMetre, nearest, farthest, inverse);
}

bool invertDepths(const ushort* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse)
{
    return invert(depths, width, unitsPerMetre, nearest, farthest, inverse);
}

void findRange(const Mat1f& values, float& low, float& high)
{
    Pack least = FLT_MAX, most = -FLT_MAX;
    for (int y = 0; y < values.rows; y++)
        for (int x = 0; x < values.cols; x += Pack::COUNT)
        {
            const Pack value = loadFirst(values[y] + x, values.cols - x);
            least = smaller(value, least);
            most = larger(value, most);
        }
    low = -largest(0 - least);
    high = largest(most);
}

void findColumnRanges(const Mat1f& image, int first, int last, float* low, float* high, float* across, float* down)
{
    const int beyond = std::min(last + 1, image.rows - 1);
    for (int x = 0; x < image.cols; x += Pack::COUNT)
    {
        const int count = image.cols - x;
        Pack value = loadFirst(image[first] + x, count), lowest = value, highest = value, mostAcross = 0, mostDown = 0;
        for (int y = first; y <= last; y++)
        {
            const Pack right = loadFirst(image[y] + x + 1, count - 1),
                       next = loadFirst(image[std::min(y + 1, beyond)] + x, count);
            lowest = smaller(lowest, value);
            highest = larger(highest, value);
            mostAcross = larger(mostAcross, magnitude(right - value));
            mostDown = larger(mostDown, magnitude(next - value));
            value = next;
        }
        storeFirst(lowest, count, low + x);
        storeFirst(highest, count, high + x);
        storeFirst(mostAcross, count, across + x);
        storeFirst(mostDown, count, down + x);
    }
}

#endif // CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
