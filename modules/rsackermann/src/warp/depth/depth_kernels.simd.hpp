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

void invertDepths(const float* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse);
void invertDepths(const ushort* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse);
bool findRange(const Mat1f& values, float& low, float& high);
void findColumnRanges(const Mat1f& image, int first, int last, float* low, float* high, float* across, float* down);

#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

namespace {

typedef PackOf<float> Pack;

// A loop that compilers turn into vectors.
template <class T>
void invert(const T* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse)
{
    const float unknown = std::numeric_limits<float>::quiet_NaN();
    for (int x = 0; x < width; x++)
    {
        const float depth = float(depths[x]), value = unitsPerMetre / depth;
        const bool known = depth >= nearest && depth <= farthest;
        inverse[x] = known ? value : unknown;
    }
}

} // namespace

void invertDepths(const float* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse)
{
    invert(depths, width, unitsPerMetre, nearest, farthest, inverse);
}

void invertDepths(const ushort* depths, int width, float unitsPerMetre, float nearest, float farthest, float* inverse)
{
    invert(depths, width, unitsPerMetre, nearest, farthest, inverse);
}

bool findRange(const Mat1f& values, float& low, float& high)
{
    Pack least = FLT_MAX, most = -FLT_MAX, zero = 0;
    for (int y = 0; y < values.rows; y++)
        for (int x = 0; x < values.cols; x += Pack::COUNT)
        {
            const Pack value = loadFirst(values[y] + x, values.cols - x);
            least = smaller(value, least);
            most = larger(value, most);
            zero = multiplyAdd(value, 0, zero); // or NaN
        }
    low = -largest(0 - least);
    high = largest(most);
    return zero.sum() == 0;
}

void findColumnRanges(const Mat1f& image, int first, int last, float* low, float* high, float* across, float* down)
{
    const int beyond = std::min(last + 1, image.rows - 1);
    int x = 0;
#if CV_SIMD
    const int lanes = VTraits<v_float32>::vlanes();
    for (; x < image.cols - lanes; x += lanes)
    {
        v_float32 value = vx_load(image[first] + x), lowest = value, highest = value, mostAcross = vx_setzero_f32(),
                  mostDown = vx_setzero_f32();
        for (int y = first; y <= last; y++)
        {
            const v_float32 next = vx_load(image[std::min(y + 1, beyond)] + x);
            lowest = v_min(lowest, value);
            highest = v_max(highest, value);
            mostAcross = v_max(mostAcross, v_absdiff(vx_load(image[y] + x + 1), value));
            mostDown = v_max(mostDown, v_absdiff(next, value));
            value = next;
        }
        v_store(low + x, lowest);
        v_store(high + x, highest);
        v_store(across + x, mostAcross);
        v_store(down + x, mostDown);
    }
#endif
    for (; x < image.cols; x++)
    {
        const int right = std::min(x + 1, image.cols - 1);
        low[x] = high[x] = image(first, x);
        across[x] = down[x] = 0;
        for (int y = first; y <= last; y++)
        {
            const float value = image(y, x);
            low[x] = std::min(low[x], value);
            high[x] = std::max(high[x], value);
            across[x] = std::max(across[x], std::abs(image(y, right) - value));
            down[x] = std::max(down[x], std::abs(image(std::min(y + 1, beyond), x) - value));
        }
    }
}

#endif // CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
