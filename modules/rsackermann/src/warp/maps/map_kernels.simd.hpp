// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../opencv_versions.hpp"
#include "opencv2/imgproc.hpp"
#include "depth_patch.hpp"

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

void evaluatePatches(const MapPatch* patches, const PlaneInverseDepth* depths, int count, const Size& size, float* x,
                     float* y, size_t step);
void evaluatePatches(const MapPatch* patches, const Bicubic* depths, int count, const Size& size, float* x, float* y,
                     size_t step);
void evaluateDepthPatch(const DepthPatch& patch, const float* depths, size_t depthStep, const Size& size, float* x,
                        float* y, size_t step);
void searchDepthPatch(const DepthPatch& patch, const Mat1f& depths, float start, const Point& first, const Size& size,
                      float* x, float* y, size_t step);
void packFixedPoint(const float* x, const float* y, int width, short* whole, ushort* fraction);
void packInterleaved(const float* x, const float* y, int width, float* xy);
void packMask(const float* x, const float* y, int width, float low, float highX, float highY, uchar* mask);

#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

namespace {

// A polynomial along one row. Next to the terms that are constant along the row the rest is small: single precision
// takes no more from it than from the coordinate.
struct RowCubic
{
    float c[Bicubic::NODES];

    RowCubic() {}
    RowCubic(const Bicubic& bicubic, double row)
    {
#if CV_SIMD128_64F
        const double(&p)[Bicubic::NODES][Bicubic::NODES] = bicubic.c;
        const v_float64x2 t = v_setall_f64(row);
        v_float64x2 low = v_load(p[3]), high = v_load(p[3] + 2);
        for (int m = 2; m >= 0; m--)
        {
            low = v_fma(low, t, v_load(p[m]));
            high = v_fma(high, t, v_load(p[m] + 2));
        }
        v_store(c, v_cvt_f32(low, high));
#else
        bicubic.alongRow(row, c);
#endif
    }

    float at(float column) const
    {
        return c[0] + column * (c[1] + column * (c[2] + column * c[3]));
    }
};

#if CV_SIMD
struct WideRowCubic
{
    v_float32 c0, c1, c2, c3;

    explicit WideRowCubic(const RowCubic& p)
        : c0(vx_setall_f32(p.c[0])), c1(vx_setall_f32(p.c[1])), c2(vx_setall_f32(p.c[2])), c3(vx_setall_f32(p.c[3]))
    {
    }

    v_float32 at(const v_float32& column) const { return v_fma(v_fma(v_fma(c3, column, c2), column, c1), column, c0); }
};

inline v_float32 columnsFrom(int first)
{
    CV_DECL_ALIGNED(CV_SIMD_WIDTH) static const float lane[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return v_add(vx_load_aligned(lane), vx_setall_f32(float(first)));
}
#endif

#if CV_SIMD
// All of a vector, or its first values.
inline void storeFirst(const v_float32& values, int count, float* to)
{
    const int lanes = VTraits<v_float32>::vlanes();
    float all[VTraits<v_float32>::max_nlanes];
    if (count >= lanes)
        return v_store(to, values);
    v_store(all, values);
    std::copy(all, all + count, to);
}
#endif

// Columns from first to last - 1; the ones behind them may be overwritten.
void evaluateRun(const MapPatch& patch, int row, int first, int last, int width, float* x, float* y)
{
    const RowCubic cubicX(patch.x, row), cubicY(patch.y, row);
    int i = first;
#if CV_SIMD
    const int lanes = VTraits<v_float32>::vlanes();
    const WideRowCubic wideX(cubicX), wideY(cubicY);
    const v_float32 next = vx_setall_f32(float(lanes));
    v_float32 column = columnsFrom(first);
    for (; i < last && i <= width - lanes; i += lanes, column = v_add(column, next))
    {
        v_store(x + i, wideX.at(column));
        v_store(y + i, wideY.at(column));
    }
#else
    CV_UNUSED(width);
#endif
    for (; i < last; i++)
    {
        x[i] = cubicX.at(float(i));
        y[i] = cubicY.at(float(i));
    }
}

// A patch and its depth along one row.
struct RowPatch
{
    RowCubic x, y, depth;

    RowPatch() {}
    RowPatch(const MapPatch& patch, const Bicubic& depth_, double row)
        : x(patch.x, row), y(patch.y, row), depth(depth_, row)
    {
    }
};

// A row of which every pixel takes the patch with the largest depth.
void evaluateNearest(const RowPatch* patches, int count, int width, float* x, float* y)
{
    int i = 0;
#if CV_SIMD
    const int lanes = VTraits<v_float32>::vlanes();
    for (; i <= width - lanes; i += lanes)
    {
        const v_float32 column = columnsFrom(i);
        v_float32 nearest = WideRowCubic(patches[0].depth).at(column);
        v_float32 placeX = WideRowCubic(patches[0].x).at(column), placeY = WideRowCubic(patches[0].y).at(column);
        for (int k = 1; k < count; k++)
        {
            const v_float32 depth = WideRowCubic(patches[k].depth).at(column), nearer = v_gt(depth, nearest);
            nearest = v_select(nearer, depth, nearest);
            placeX = v_select(nearer, WideRowCubic(patches[k].x).at(column), placeX);
            placeY = v_select(nearer, WideRowCubic(patches[k].y).at(column), placeY);
        }
        v_store(x + i, placeX);
        v_store(y + i, placeY);
    }
#endif
    for (; i < width; i++)
    {
        int best = 0;
        for (int k = 1; k < count; k++)
            if (patches[k].depth.at(float(i)) > patches[best].depth.at(float(i)))
                best = k;
        x[i] = patches[best].x.at(float(i));
        y[i] = patches[best].y.at(float(i));
    }
}

// The plane that is nearest at a column and, of those, the one that comes nearer fastest.
int nearestPlane(const PlaneInverseDepth* depths, int count, int column, int row)
{
    int best = 0;
    for (int k = 1; k < count; k++)
    {
        const double ahead = depths[k].at(column, row) - depths[best].at(column, row);
        if (ahead > 0 || (ahead == 0 && depths[k].perColumn > depths[best].perColumn))
            best = k;
    }
    return best;
}

// The column at which another plane becomes nearer than the present one.
int endOfPlane(const PlaneInverseDepth* depths, int count, int plane, int column, int row, int width)
{
    int end = width;
    for (int k = 0; k < count; k++)
    {
        const double approach = depths[k].perColumn - depths[plane].perColumn;
        if (!(approach > 0))
            continue;
        const double left = (depths[plane].at(column, row) - depths[k].at(column, row)) / approach;
        if (left < end - column)
            end = column + std::max(cvCeil(left), 1);
    }
    return end;
}

// The polynomials of a patch along one row, one for each power of the depth.
struct RowDepthPatch
{
    enum { NODES = DepthPatch::NODES };

    RowCubic x[NODES], y[NODES];

    RowDepthPatch(const DepthPatch& patch, double row)
    {
        for (int k = 0; k < NODES; k++)
        {
            x[k] = RowCubic(patch.x[k], row);
            y[k] = RowCubic(patch.y[k], row);
        }
    }
};

// The place of one pixel as a function of the depth.
struct DepthCubic
{
    enum { NODES = DepthPatch::NODES };

    float x[NODES], y[NODES];

    DepthCubic(const RowDepthPatch& row, float column)
    {
        for (int k = 0; k < NODES; k++)
        {
            x[k] = row.x[k].at(column);
            y[k] = row.y[k].at(column);
        }
    }

    static float at(const float* c, float depth) { return c[0] + depth * (c[1] + depth * (c[2] + depth * c[3])); }
};

#if CV_SIMD
struct WideDepthVariable
{
    v_float32 bend, low, scale;

    explicit WideDepthVariable(const DepthVariable& v)
        : bend(vx_setall_f32(v.bend)), low(vx_setall_f32(v.low)), scale(vx_setall_f32(v.scale))
    {
    }

    // Rate receives the derivative.
    v_float32 at(const v_float32& inverseDepth, v_float32& rate) const
    {
        const v_float32 one = vx_setall_f32(1.f), quotient = v_div(one, v_sub(one, v_mul(bend, inverseDepth)));
        rate = v_mul(v_mul(quotient, quotient), scale);
        return v_mul(v_sub(v_mul(inverseDepth, quotient), low), scale);
    }
};

struct WideDepthCubic
{
    v_float32 x0, x1, x2, x3, y0, y1, y2, y3;

    WideDepthCubic(const RowDepthPatch& row, const v_float32& column)
        : x0(WideRowCubic(row.x[0]).at(column)), x1(WideRowCubic(row.x[1]).at(column)),
          x2(WideRowCubic(row.x[2]).at(column)), x3(WideRowCubic(row.x[3]).at(column)),
          y0(WideRowCubic(row.y[0]).at(column)), y1(WideRowCubic(row.y[1]).at(column)),
          y2(WideRowCubic(row.y[2]).at(column)), y3(WideRowCubic(row.y[3]).at(column))
    {
    }

    v_float32 x(const v_float32& depth) const { return v_fma(v_fma(v_fma(x3, depth, x2), depth, x1), depth, x0); }
    v_float32 y(const v_float32& depth) const { return v_fma(v_fma(v_fma(y3, depth, y2), depth, y1), depth, y0); }
};
#endif

} // namespace

void evaluatePatches(const MapPatch* patches, const PlaneInverseDepth* depths, int count, const Size& size, float* x,
                     float* y, size_t step)
{
    for (int row = 0; row < size.height; row++, x += step, y += step)
        for (int column = 0; column < size.width;)
        {
            const int plane = nearestPlane(depths, count, column, row);
            const int end = endOfPlane(depths, count, plane, column, row, size.width);
            evaluateRun(patches[plane], row, column, end, size.width, x, y);
            column = end;
        }
}

void evaluatePatches(const MapPatch* patches, const Bicubic* depths, int count, const Size& size, float* x, float* y,
                     size_t step)
{
    AutoBuffer<RowPatch, 4> rows(count);
    for (int row = 0; row < size.height; row++, x += step, y += step)
    {
        if (count == 1)
        {
            evaluateRun(patches[0], row, 0, size.width, size.width, x, y);
            continue;
        }
        for (int i = 0; i < count; i++)
            rows[i] = RowPatch(patches[i], depths[i], row);
        evaluateNearest(rows.data(), count, size.width, x, y);
    }
}

void evaluateDepthPatch(const DepthPatch& patch, const float* depths, size_t depthStep, const Size& size, float* x,
                        float* y, size_t step)
{
    for (int row = 0; row < size.height; row++, depths += depthStep, x += step, y += step)
    {
        const RowDepthPatch places(patch, row);
        int i = 0;
#if CV_SIMD
        const int lanes = VTraits<v_float32>::vlanes();
        const WideDepthVariable variable(patch.variable);
        for (; i <= size.width - lanes; i += lanes)
        {
            v_float32 unused;
            const v_float32 depth = variable.at(vx_load(depths + i), unused);
            const WideDepthCubic curve(places, columnsFrom(i));
            v_store(x + i, curve.x(depth));
            v_store(y + i, curve.y(depth));
        }
#endif
        for (; i < size.width; i++)
        {
            const float depth = patch.variable.at(depths[i]);
            const DepthCubic curve(places, float(i));
            x[i] = DepthCubic::at(curve.x, depth);
            y[i] = DepthCubic::at(curve.y, depth);
        }
    }
}

namespace {

// The depths of the other image between its pixels, with the rates at which they grow there.
struct DepthSampler
{
    const float* depths;
    int step;
    float lastX, lastY;

    explicit DepthSampler(const Mat1f& image)
        : depths(image[0]), step(int(image.step1())), lastX(float(image.cols - 1)), lastY(float(image.rows - 1))
    {
    }

    float sample(float x, float y, float& perX, float& perY) const
    {
        const float insideX = std::min(std::max(x, 0.f), lastX), insideY = std::min(std::max(y, 0.f), lastY);
        const int column = std::min(int(insideX), int(lastX) - 1), row = std::min(int(insideY), int(lastY) - 1);
        const float fx = insideX - column, fy = insideY - row;
        const float* p = depths + (size_t)row * step + column;
        const float a = p[0], b = p[1], c = p[step], d = p[step + 1];
        const float left = a + fy * (c - a), right = b + fy * (d - b);
        perX = right - left;
        perY = c - a + fx * ((d - c) - (b - a));
        return left + fx * perX;
    }

    // The depth at a place, or at the nearest one of the image.
    const float* at(float x, float y) const
    {
        const int column = int(std::min(std::max(x, 0.f), lastX)), row = int(std::min(std::max(y, 0.f), lastY));
        return depths + (size_t)row * step + column;
    }

#if CV_SIMD
    v_float32 sample(const v_float32& x, const v_float32& y, v_float32& perX, v_float32& perY) const
    {
        const v_float32 zero = vx_setzero_f32(), one = vx_setall_f32(1.f), limitX = vx_setall_f32(lastX),
                        limitY = vx_setall_f32(lastY);
        const v_float32 insideX = v_min(v_max(x, zero), limitX), insideY = v_min(v_max(y, zero), limitY);
        const v_int32 column = v_trunc(v_min(insideX, v_sub(limitX, one))),
                      row = v_trunc(v_min(insideY, v_sub(limitY, one)));
        const v_float32 fx = v_sub(insideX, v_cvt_f32(column)), fy = v_sub(insideY, v_cvt_f32(row));
        const v_int32 index = v_add(v_mul(row, vx_setall_s32(step)), column);
        const v_float32 a = v_lut(depths, index), b = v_lut(depths + 1, index), c = v_lut(depths + step, index),
                        d = v_lut(depths + step + 1, index);
        const v_float32 down = v_sub(c, a), left = v_fma(fy, down, a), right = v_fma(fy, v_sub(d, b), b);
        perX = v_sub(right, left);
        perY = v_fma(fx, v_sub(v_sub(d, c), v_sub(b, a)), down);
        return v_fma(fx, perX, left);
    }
#endif
};

} // namespace

// Newton's steps to the depth that the other image has at the place which it gives. The first one is exact on a plane:
// from what the rows above let expect a second one is rarely needed.
void searchDepthPatch(const DepthPatch& patch, const Mat1f& image, float start, const Point& first, const Size& size,
                      float* x, float* y, size_t step)
{
    const int steps = 2;
    const DepthSampler sampler(image);
    const float startDepth = patch.variable.at(start);
#if CV_SIMD
#ifdef __GNUC__
    const int rowsAhead = 4; // the next rows of a tile are elsewhere in memory
#endif
    const float enough = 1e-3f; // pixels that a step moves the place: what is left is less than the half of it
    const int lanes = VTraits<v_float32>::vlanes(), columns = alignSize(size.width, lanes);
    const WideDepthVariable variable(patch.variable);
    const v_float32 one = vx_setall_f32(1.f), limit = vx_setall_f32(enough);
    AutoBuffer<float> depths(columns),
        growths(columns); // of the row above, and by how much it differs from the next one
    std::fill(depths.data(), depths.data() + columns, startDepth);
    std::fill(growths.data(), growths.data() + columns, 0.f);
    for (int row = 0; row < size.height; row++, x += step, y += step)
    {
        const RowDepthPatch places(patch, first.y + row);
        for (int i = 0; i < size.width; i += lanes)
        {
            const WideDepthCubic curve(places, columnsFrom(first.x + i));
            const v_float32 above = vx_load(depths.data() + i), pixels = v_add(v_abs(curve.x1), v_abs(curve.y1));
            v_float32 depth = v_add(above, vx_load(growths.data() + i));
            for (int k = 0; k < steps; k++)
            {
                v_float32 perX, perY, rate;
                const v_float32 found = sampler.sample(curve.x(depth), curve.y(depth), perX, perY);
                const v_float32 next = variable.at(found, rate),
                                slope = v_mul(v_fma(perX, curve.x1, v_mul(perY, curve.y1)), rate),
                                change = v_div(v_sub(next, depth), v_sub(one, slope));
                depth = v_add(depth, change);
                if (!v_check_any(v_gt(v_mul(v_abs(change), pixels), limit)))
                    break;
            }
            v_store(depths.data() + i, depth);
            if (row > 0)
                v_store(growths.data() + i, v_sub(depth, above));
            storeFirst(curve.x(depth), size.width - i, x + i);
            storeFirst(curve.y(depth), size.width - i, y + i);
#ifdef __GNUC__
            __builtin_prefetch(sampler.at(x[i], y[i] + rowsAhead));
#endif
        }
    }
#else
    for (int row = 0; row < size.height; row++, x += step, y += step)
    {
        const RowDepthPatch places(patch, first.y + row);
        for (int i = 0; i < size.width; i++)
        {
            const DepthCubic curve(places, float(first.x + i));
            float depth = startDepth, perX, perY;
            for (int k = 0; k < steps; k++)
            {
                const float found =
                    sampler.sample(DepthCubic::at(curve.x, depth), DepthCubic::at(curve.y, depth), perX, perY);
                const float quotient = 1 / (1 - patch.variable.bend * found),
                            rate = quotient * quotient * patch.variable.scale,
                            slope = (perX * curve.x[1] + perY * curve.y[1]) * rate;
                depth += (patch.variable.at(found) - depth) / (1 - slope);
            }
            x[i] = DepthCubic::at(curve.x, depth);
            y[i] = DepthCubic::at(curve.y, depth);
        }
    }
#endif
}

void packFixedPoint(const float* x, const float* y, int width, short* whole, ushort* fraction)
{
    int i = 0;
#if CV_SIMD
    const int lanes = VTraits<v_float32>::vlanes();
    const v_float32 scale = vx_setall_f32(INTER_TAB_SIZE);
    const v_int32 low = vx_setall_s32(INTER_TAB_SIZE - 1), rowStep = vx_setall_s32(INTER_TAB_SIZE);
    for (; i <= width - 2 * lanes; i += 2 * lanes)
    {
        const v_int32 x0 = v_round(v_mul(vx_load(x + i), scale)), x1 = v_round(v_mul(vx_load(x + i + lanes), scale));
        const v_int32 y0 = v_round(v_mul(vx_load(y + i), scale)), y1 = v_round(v_mul(vx_load(y + i + lanes), scale));
        v_store_interleave(whole + 2 * i, v_pack(v_shr<INTER_BITS>(x0), v_shr<INTER_BITS>(x1)),
                           v_pack(v_shr<INTER_BITS>(y0), v_shr<INTER_BITS>(y1)));
        v_store(fraction + i, v_pack_u(v_add(v_mul(v_and(y0, low), rowStep), v_and(x0, low)),
                                       v_add(v_mul(v_and(y1, low), rowStep), v_and(x1, low))));
    }
#endif
    for (; i < width; i++)
    {
        const int ix = saturate_cast<int>(x[i] * INTER_TAB_SIZE), iy = saturate_cast<int>(y[i] * INTER_TAB_SIZE);
        whole[2 * i] = saturate_cast<short>(ix >> INTER_BITS);
        whole[2 * i + 1] = saturate_cast<short>(iy >> INTER_BITS);
        fraction[i] = ushort((iy & (INTER_TAB_SIZE - 1)) * INTER_TAB_SIZE + (ix & (INTER_TAB_SIZE - 1)));
    }
}

void packInterleaved(const float* x, const float* y, int width, float* xy)
{
    int i = 0;
#if CV_SIMD
    const int lanes = VTraits<v_float32>::vlanes();
    for (; i <= width - lanes; i += lanes)
        v_store_interleave(xy + 2 * i, vx_load(x + i), vx_load(y + i));
#endif
    for (; i < width; i++)
    {
        xy[2 * i] = x[i];
        xy[2 * i + 1] = y[i];
    }
}

#if CV_SIMD
static inline v_uint32 isBetween(const v_float32& value, const v_float32& low, const v_float32& high)
{
    return v_reinterpret_as_u32(v_and(v_ge(value, low), v_le(value, high)));
}
#endif

void packMask(const float* x, const float* y, int width, float low, float highX, float highY, uchar* mask)
{
    int i = 0;
#if CV_SIMD
    const int lanes = VTraits<v_float32>::vlanes();
    const v_float32 wideLow = vx_setall_f32(low), wideHighX = vx_setall_f32(highX), wideHighY = vx_setall_f32(highY);
    for (; i <= width - 4 * lanes; i += 4 * lanes)
    {
        v_uint32 inside[4];
        for (int k = 0; k < 4; k++)
            inside[k] = v_and(isBetween(vx_load(x + i + k * lanes), wideLow, wideHighX),
                              isBetween(vx_load(y + i + k * lanes), wideLow, wideHighY));
        v_store(mask + i, v_pack_b(inside[0], inside[1], inside[2], inside[3]));
    }
#endif
    for (; i < width; i++)
        mask[i] = x[i] >= low && x[i] <= highX && y[i] >= low && y[i] <= highY ? 255 : 0;
}

#endif // CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
