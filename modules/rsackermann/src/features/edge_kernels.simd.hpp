// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../opencv_versions.hpp"
#include "edge_kernels.hpp"

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

int findExtremes(const uchar* const (&rows)[3], int width, double least, short* buffer, EdgePoint* points);
EdgeMoments sumWindows(EdgeWindows& windows, float sign);
ParabolaSums sumCentres(const EdgeWindows& windows, double gain, double usualSquare, double start, double spacing,
                        const ParabolaFit* line);

#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

namespace {

enum { STEP_GAIN = 8 }; // of the gradient: weights of the rows, two pixels

#if CV_SIMD

enum { LANES = VTraits<v_float32>::max_nlanes };

typedef v_float32 Floats;

inline Floats allOf(double x)
{
    return vx_setall_f32(float(x));
}
inline Floats loadFloats(const float* p)
{
    return vx_load(p);
}
inline float sumOf(const Floats& x)
{
    return v_reduce_sum(x);
}

// A pixel of the windows of several rows.
template <int i>
inline Floats pixelOf(const v_uint32 (&halves)[2])
{
    const v_uint32 shifted = v_shr<i % 4 * 8>(halves[i / 4]);
    return v_cvt_f32(v_reinterpret_as_s32(v_and(shifted, vx_setall_u32(0xFF))));
}

inline void loadPixels(const uchar* p, Floats (&pixels)[WINDOW_PIXELS])
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

inline Floats ifPositive(const Floats& x, const Floats& value)
{
    return v_select(v_gt(x, allOf(0)), value, allOf(0));
}

#else

// One number, if the processor has no vectors of them.
enum { LANES = 1 };

typedef float Floats;

inline float allOf(double x)
{
    return float(x);
}
inline float loadFloats(const float* p)
{
    return *p;
}
inline void v_store(float* p, float x)
{
    *p = x;
}
inline float sumOf(float x)
{
    return x;
}
inline float v_add(float a, float b)
{
    return a + b;
}
inline float v_sub(float a, float b)
{
    return a - b;
}
inline float v_mul(float a, float b)
{
    return a * b;
}
inline float v_div(float a, float b)
{
    return a / b;
}

inline void loadPixels(const uchar* p, float (&pixels)[WINDOW_PIXELS])
{
    for (int k = 0; k < WINDOW_PIXELS; k++)
        pixels[k] = p[k];
}

inline float ifPositive(float x, float value)
{
    return x > 0 ? value : 0;
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
    const Floats one = allOf(1), scale = allOf(1. / (WINDOW_REACH * WINDOW_REACH)), signs = allOf(sign);
    Floats sums[3] = {allOf(0), allOf(0), allOf(0)};
    for (int i = 0; i < windows.count; i += LANES)
    {
        Floats pixels[WINDOW_PIXELS], u = loadFloats(&windows.first[i]), m0 = allOf(0), m1 = m0, m2 = m0;
        loadPixels(&windows.pixels[size_t(i) * WINDOW_STRIDE], pixels);
        for (int k = 0; k + 1 < WINDOW_PIXELS; k++)
        {
            const Floats inside = v_sub(one, v_mul(v_mul(u, u), scale));
            const Floats g = v_mul(v_mul(v_mul(inside, inside), v_sub(pixels[k + 1], pixels[k])), signs),
                         gu = v_mul(g, u);
            m0 = v_add(m0, g);
            m1 = v_add(m1, gu);
            m2 = v_add(m2, v_mul(gu, u));
            u = v_add(u, one);
        }
        v_store(&windows.step[i], ifPositive(m0, m0));
        v_store(&windows.centre[i], ifPositive(m0, v_div(m1, m0)));
        sums[0] = v_add(sums[0], ifPositive(m0, m0));
        sums[1] = v_add(sums[1], ifPositive(m0, m1));
        sums[2] = v_add(sums[2], ifPositive(m0, m2));
    }
    const EdgeMoments moments = {sumOf(sums[0]), sumOf(sums[1]), sumOf(sums[2])};
    return moments;
}

ParabolaSums sumCentres(const EdgeWindows& windows, double gain, double usualSquare, double start, double spacing,
                        const ParabolaFit* line)
{
    const Floats zero = allOf(0), one = allOf(1), gains = allOf(gain), usual = allOf(usualSquare),
                 middle = allOf(line ? line->middle : 0), slope = allOf(line ? line->slope : 0),
                 curvature = allOf(line ? line->curvature : 0), robust = allOf(line ? 1 : 0);
    float times[LANES] = {0};
    for (int k = 0; k < LANES; k++)
        times[k] = float(start + k * spacing);
    Floats t = loadFloats(times), n = zero, st = zero, stt = zero, sttt = zero, stttt = zero, sx = zero, sxt = zero,
           sxtt = zero, sxx = zero;
    const Floats advance = allOf(LANES * spacing);
    for (int i = 0; i < windows.count; i += LANES, t = v_add(t, advance))
    {
        const Floats x = v_mul(gains, loadFloats(&windows.centre[i])), step = loadFloats(&windows.step[i]),
                     r = v_mul(robust, v_sub(v_sub(x, middle), v_mul(t, v_add(slope, v_mul(t, curvature))))),
                     q = v_add(one, v_mul(r, r)), square = v_mul(step, step),
                     w = v_div(square, v_mul(v_add(square, usual), v_mul(q, q))), wt = v_mul(w, t), wtt = v_mul(wt, t),
                     wx = v_mul(w, x), wttt = v_mul(wtt, t), wxt = v_mul(wx, t);
        n = v_add(n, w);
        st = v_add(st, wt);
        stt = v_add(stt, wtt);
        sttt = v_add(sttt, wttt);
        stttt = v_add(stttt, v_mul(wttt, t));
        sx = v_add(sx, wx);
        sxt = v_add(sxt, wxt);
        sxtt = v_add(sxtt, v_mul(wxt, t));
        sxx = v_add(sxx, v_mul(wx, x));
    }
    ParabolaSums s;
    s.n = sumOf(n);
    s.t = sumOf(st);
    s.tt = sumOf(stt);
    s.ttt = sumOf(sttt);
    s.tttt = sumOf(stttt);
    s.x = sumOf(sx);
    s.xt = sumOf(sxt);
    s.xtt = sumOf(sxtt);
    s.xx = sumOf(sxx);
    return s;
}

#endif // CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
