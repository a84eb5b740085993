// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "edge_kernels.hpp"
#ifdef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY
#include "../opencv_versions.hpp"
#else
#include "../simd_pack.hpp"
#endif

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

int findExtremes(const uchar* const (&rows)[3], int width, double least, short* buffer, EdgePoint* points);
EdgeMoments sumWindows(EdgeWindows& windows, float sign);
ParabolaSums sumCentres(const EdgeWindows& windows, double gain, double usualSquare, double start, double spacing,
                        const ParabolaFit* line);

#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

namespace {

enum { STEP_GAIN = 8 }; // of the gradient: weights of the rows, two pixels

typedef PackOf<float> Pack;

// The pixels of the windows of several rows.
#if CV_SIMD_64F
template <int i>
Pack pixelOf(const v_uint32 (&halves)[2])
{
    const v_uint32 shifted = v_shr<i % 4 * 8>(halves[i / 4]);
    return v_cvt_f32(v_reinterpret_as_s32(v_and(shifted, vx_setall_u32(0xFF))));
}

void loadPixels(const uchar* p, Pack (&pixels)[WINDOW_PIXELS])
{
    v_uint32 halves[2];
    v_load_deinterleave(reinterpret_cast<const unsigned*>(p), halves[0], halves[1]);
    pixels[0] = pixelOf<0>(halves);
    pixels[1] = pixelOf<1>(halves);
    pixels[2] = pixelOf<2>(halves);
    pixels[3] = pixelOf<3>(halves);
    pixels[4] = pixelOf<4>(halves);
    pixels[5] = pixelOf<5>(halves);
    pixels[6] = pixelOf<6>(halves);
}
#else
void loadPixels(const uchar* p, Pack (&pixels)[WINDOW_PIXELS])
{
    std::copy(p, p + WINDOW_PIXELS, pixels);
}
#endif

// The sum of three rows, the middle one twice, and its differences of two places to the left of a place between two
// pixels and two to its right.
void differentiate(const uchar* const (&rows)[3], int width, short* sums, short* gradient)
{
    int x = 0;
#if CV_SIMD
    const int lanes = VTraits<v_int16>::max_nlanes;
    for (; x < width && width >= lanes; x += lanes)
    {
        x = std::min(x, width - lanes); // the last ones, some of them once more
        const v_uint16 middle = vx_load_expand(rows[1] + x);
        const v_uint16 sum =
            v_add(v_add(vx_load_expand(rows[0] + x), vx_load_expand(rows[2] + x)), v_add(middle, middle));
        v_store(sums + x, v_reinterpret_as_s16(sum));
    }
#endif
    for (; x < width; x++)
        sums[x] = short(rows[0][x] + 2 * rows[1][x] + rows[2][x]);

    x = 1;
#if CV_SIMD
    for (; x < width - 2 && width - 3 >= lanes; x += lanes)
    {
        x = std::min(x, width - 2 - lanes);
        v_store(gradient + x, v_sub(v_add(vx_load(sums + x + 1), vx_load(sums + x + 2)),
                                    v_add(vx_load(sums + x - 1), vx_load(sums + x))));
    }
#endif
    for (; x + 2 < width; x++)
        gradient[x] = short(sums[x + 1] + sums[x + 2] - sums[x - 1] - sums[x]);
}

inline bool isExtreme(const short* g, int least)
{
    return (g[0] >= least && g[0] > g[-1] && g[0] >= g[1]) || (g[0] <= -least && g[0] < g[-1] && g[0] <= g[1]);
}

// With a parabola through the extreme and its neighbours.
inline EdgePoint edgeAt(const short* g, int column)
{
    const EdgePoint p = {column + 0.5f + 0.5f * (g[1] - g[-1]) / (2 * g[0] - g[-1] - g[1]), g[0] / float(STEP_GAIN)};
    return p;
}

} // namespace

int findExtremes(const uchar* const (&rows)[3], int width, double leastStep, short* buffer, EdgePoint* points)
{
    const int least = std::min(std::max(cvCeil(int(STEP_GAIN) * leastStep), 1), int(SHRT_MAX)), end = width - 3;
    short* gradient = buffer + width;
    differentiate(rows, width, buffer, gradient);
    int x = 2, count = 0;
#if CV_SIMD
    const int lanes = VTraits<v_int16>::max_nlanes;
    const v_int16 high = vx_setall_s16(short(least - 1)), low = vx_setall_s16(short(1 - least));
    for (; x < end && end >= 2 + lanes; x += lanes)
    {
        const int again = std::max(x + lanes - end, 0); // of the last ones
        x -= again;
        const v_int16 g = vx_load(gradient + x), left = vx_load(gradient + x - 1), right = vx_load(gradient + x + 1);
        const v_int16 peaks = v_and(v_and(v_gt(g, high), v_gt(g, left)), v_ge(g, right)),
                      valleys = v_and(v_and(v_lt(g, low), v_lt(g, left)), v_le(g, right));
        for (unsigned found = unsigned(v_signmask(v_or(peaks, valleys))) & (~0u << again); found; found &= found - 1)
        {
            const int i = x + int(trailingZeros32(found));
            points[count++] = edgeAt(gradient + i, i);
        }
    }
#endif
    for (; x < end; x++)
        if (isExtreme(gradient + x, least))
            points[count++] = edgeAt(gradient + x, x);
    return count;
}

EdgeMoments sumWindows(EdgeWindows& windows, float sign)
{
    const Pack zero(0.), one(1), scale(1. / (WINDOW_REACH * WINDOW_REACH)), signs(sign);
    Pack sums[3] = {zero, zero, zero};
    for (int i = 0; i < windows.count; i += Pack::COUNT)
    {
        Pack pixels[WINDOW_PIXELS], u = Pack::load(&windows.first[i]), m0 = zero, m1 = zero, m2 = zero;
        loadPixels(&windows.pixels[size_t(i) * WINDOW_STRIDE], pixels);
        for (int k = 0; k + 1 < WINDOW_PIXELS; k++)
        {
            const Pack inside = one - u * u * scale;
            const Pack g = inside * inside * (pixels[k + 1] - pixels[k]) * signs, gu = g * u;
            m0 = m0 + g;
            m1 = m1 + gu;
            m2 = m2 + gu * u;
            u = u + one;
        }
        const auto isEdge = m0 > zero;
        choose(isEdge, m0, zero).store(&windows.step[i]);
        choose(isEdge, m1 / m0, zero).store(&windows.centre[i]);
        sums[0] = sums[0] + choose(isEdge, m0, zero);
        sums[1] = sums[1] + choose(isEdge, m1, zero);
        sums[2] = sums[2] + choose(isEdge, m2, zero);
    }
    const EdgeMoments moments = {sums[0].sum(), sums[1].sum(), sums[2].sum()};
    return moments;
}

ParabolaSums sumCentres(const EdgeWindows& windows, double gain, double usualSquare, double start, double spacing,
                        const ParabolaFit* line)
{
    const Pack zero(0.), one(1), gains(gain), usual(usualSquare), middle(line ? line->middle : 0),
        slope(line ? line->slope : 0), curvature(line ? line->curvature : 0), robust(line ? 1 : 0);
    float times[Pack::COUNT];
    for (int k = 0; k < Pack::COUNT; k++)
        times[k] = float(start + k * spacing);
    Pack t = Pack::load(times), n = zero, st = zero, stt = zero, sttt = zero, stttt = zero, sx = zero, sxt = zero,
         sxtt = zero, sxx = zero;
    const Pack advance(Pack::COUNT * spacing);
    for (int i = 0; i < windows.count; i += Pack::COUNT, t = t + advance)
    {
        const Pack x = gains * Pack::load(&windows.centre[i]), step = Pack::load(&windows.step[i]),
                   r = robust * (x - middle - t * (slope + t * curvature)), q = one + r * r, square = step * step,
                   w = square / ((square + usual) * (q * q)), wt = w * t, wtt = wt * t, wx = w * x, wttt = wtt * t,
                   wxt = wx * t;
        n = n + w;
        st = st + wt;
        stt = stt + wtt;
        sttt = sttt + wttt;
        stttt = stttt + wttt * t;
        sx = sx + wx;
        sxt = sxt + wxt;
        sxtt = sxtt + wxt * t;
        sxx = sxx + wx * x;
    }
    ParabolaSums s;
    s.n = n.sum();
    s.t = st.sum();
    s.tt = stt.sum();
    s.ttt = sttt.sum();
    s.tttt = stttt.sum();
    s.x = sx.sum();
    s.xt = sxt.sum();
    s.xtt = sxtt.sum();
    s.xx = sxx.sum();
    return s;
}

#endif // CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
