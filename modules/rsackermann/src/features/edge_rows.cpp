// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "opencv2/core/hal/intrin.hpp"
#include "edge_rows.hpp"

namespace cv { namespace rsackermann {

enum { STEP_GAIN = 8 }; // of the gradient: weights of the rows, two pixels

// Sums of three rows, and the differences of two of them to the left of a place between two pixels and two to its
// right.
void EdgeRows::differentiate(int row)
{
    const int width = columns.size();
    const uchar* above = gray.ptr(std::max(row - 1, 0)) + columns.start;
    const uchar* here = gray.ptr(row) + columns.start;
    const uchar* below = gray.ptr(std::min(row + 1, gray.rows - 1)) + columns.start;
    sums.resize(width);
    gradient.resize(width);
    int x = 0;
#if CV_SIMD
    const int lanes = VTraits<v_int16>::vlanes();
    for (; x + lanes <= width; x += lanes)
    {
        const v_uint16 middle = vx_load_expand(here + x);
        const v_uint16 sum = v_add(v_add(vx_load_expand(above + x), vx_load_expand(below + x)), v_add(middle, middle));
        v_store(&sums[x], v_reinterpret_as_s16(sum));
    }
#endif
    for (; x < width; x++)
        sums[x] = short(above[x] + 2 * here[x] + below[x]);

    x = 1;
#if CV_SIMD
    for (; x + 2 + lanes <= width; x += lanes)
        v_store(&gradient[x], v_sub(v_add(vx_load(&sums[x + 1]), vx_load(&sums[x + 2])),
                                    v_add(vx_load(&sums[x - 1]), vx_load(&sums[x]))));
#endif
    for (; x + 2 < width; x++)
        gradient[x] = short(sums[x + 1] + sums[x + 2] - sums[x - 1] - sums[x]);
}

static inline void addIfExtreme(const short* g, int least, int column, std::vector<EdgePoint>& points)
{
    const bool isPeak = g[0] >= least && g[0] > g[-1] && g[0] >= g[1],
               isValley = g[0] <= -least && g[0] < g[-1] && g[0] <= g[1];
    if (!isPeak && !isValley)
        return;
    const EdgePoint p = {column + 0.5f + 0.5f * (g[1] - g[-1]) / (2 * g[0] - g[-1] - g[1]), g[0] / float(STEP_GAIN)};
    points.push_back(p);
}

void EdgeRows::find(int row, double leastStep, std::vector<EdgePoint>& points)
{
    points.clear();
    const int width = columns.size(), least = std::min(std::max(cvCeil(int(STEP_GAIN) * leastStep), 1), int(SHRT_MAX));
    if (width < 6)
        return;
    differentiate(row);
    int x = 2;
#if CV_SIMD
    const int lanes = VTraits<v_int16>::vlanes();
    const v_int16 high = vx_setall_s16(short(least - 1)), low = vx_setall_s16(short(1 - least));
    for (; x + 3 + lanes <= width; x += lanes)
    {
        const v_int16 g = vx_load(&gradient[x]);
        if (!v_check_any(v_or(v_gt(g, high), v_lt(g, low))))
            continue;
        const v_int16 left = vx_load(&gradient[x - 1]), right = vx_load(&gradient[x + 1]);
        const v_int16 peaks = v_and(v_and(v_gt(g, high), v_gt(g, left)), v_ge(g, right)),
                      valleys = v_and(v_and(v_lt(g, low), v_lt(g, left)), v_le(g, right));
        if (v_check_any(v_or(peaks, valleys)))
            for (int i = x; i < x + lanes; i++)
                addIfExtreme(&gradient[i], least, columns.start + i, points);
    }
#endif
    for (; x + 3 < width; x++)
        addIfExtreme(&gradient[x], least, columns.start + x, points);
}

double imageNoise(const Mat& gray)
{
    const int enoughPixels = 100000, levels = 8 * UCHAR_MAX + 1;
    const double gain = 6, medianOfSigma = 0.6745, rounding = 0.29; // of second differences; of a normal distribution
    std::vector<int> counts(levels);
    const int step = std::max(int(gray.total() / enoughPixels), 1);
    int total = 0;
    for (int y = 1; y + 1 < gray.rows; y += step)
    {
        const uchar* a = gray.ptr(y - 1);
        const uchar* b = gray.ptr(y);
        const uchar* c = gray.ptr(y + 1);
        int left = a[0] - 2 * b[0] + c[0], middle = a[1] - 2 * b[1] + c[1];
        for (int x = 2; x < gray.cols; x++, total++)
        {
            const int right = a[x] - 2 * b[x] + c[x];
            counts[std::abs(left - 2 * middle + right)]++;
            left = middle;
            middle = right;
        }
    }
    int median = 0;
    for (int n = counts[0]; n * 2 < total; n += counts[median])
        median++;
    return std::max(median / (gain * medianOfSigma), rounding);
}

}} // namespace cv::rsackermann
