// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../opencv_versions.hpp"
#include "../../prefetch.hpp"
#include "opencv2/imgproc.hpp"
#include "depth_patch.hpp"
#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY
#include "row_of_depths.hpp"
#endif

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
void packMask(const float* x, const float* y, int width, float low, float highX, float highY, uchar* mask);

#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

namespace {

// Columns from first to last - 1; the ones behind them may be overwritten.
void evaluateRun(const MapPatch& patch, int row, int first, int last, int width, float* x, float* y)
{
    const PackCubic cubicX(RowCubic(patch.x, row).c), cubicY(RowCubic(patch.y, row).c);
    int i = first;
    for (; i < last && i <= width - Pack::COUNT; i += Pack::COUNT)
    {
        const Pack column = columnsFrom(i);
        cubicX.at(column).store(x + i);
        cubicY.at(column).store(y + i);
    }
    if (i < last)
    {
        storeFirst(cubicX.at(columnsFrom(i)), last - i, x + i);
        storeFirst(cubicY.at(columnsFrom(i)), last - i, y + i);
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
    for (int i = 0; i < width; i += Pack::COUNT)
    {
        const Pack column = columnsFrom(i);
        Pack nearest = -FLT_MAX, placeX = 0, placeY = 0;
        for (int k = 0; k < count; k++)
        {
            const Pack depth = patches[k].depth.at(column);
            const auto nearer = depth > nearest;
            nearest = choose(nearer, depth, nearest);
            placeX = choose(nearer, patches[k].x.at(column), placeX);
            placeY = choose(nearer, patches[k].y.at(column), placeY);
        }
        storeFirst(placeX, width - i, x + i);
        storeFirst(placeY, width - i, y + i);
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

} // namespace

void evaluatePatches(const MapPatch* patches, const PlaneInverseDepth* depths, int count, const Size& size, float* x,
                     float* y, size_t step)
{
    for (int row = 0; row < size.height; row++, x += step, y += step)
    {
        prefetchMap(x, y, size, row, step);
        for (int column = 0; column < size.width;)
        {
            const int plane = nearestPlane(depths, count, column, row);
            const int end = endOfPlane(depths, count, plane, column, row, size.width);
            evaluateRun(patches[plane], row, column, end, size.width, x, y);
            column = end;
        }
    }
}

void evaluatePatches(const MapPatch* patches, const Bicubic* depths, int count, const Size& size, float* x, float* y,
                     size_t step)
{
    AutoBuffer<RowPatch, 4> rows(count);
    for (int row = 0; row < size.height; row++, x += step, y += step)
    {
        prefetchMap(x, y, size, row, step);
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
    const PackVariable variable(patch.variable);
    for (int row = 0; row < size.height; row++, depths += depthStep, x += step, y += step)
    {
        prefetchMap(x, y, size, row, step);
        const RowDepthPatch places(patch, row);
        for (int i = 0; i < size.width; i += Pack::COUNT)
        {
            const PackCurve::Place place =
                PackCurve(places, variable, columnsFrom(i)).at(loadFirst(depths + i, size.width - i));
            storeFirst(place.x, size.width - i, x + i);
            storeFirst(place.y, size.width - i, y + i);
        }
    }
}

// From what the rows above let expect a second step is rarely needed.
void searchDepthPatch(const DepthPatch& patch, const Mat1f& image, float start, const Point& first, const Size& size,
                      float* x, float* y, size_t step)
{
    const int steps = 4;
    const float enough = 1e-3f; // pixels that a step moves a place: what is left is less than the half of it
    const PackDepths other(image);
    const PackVariable variable(patch.variable);
    const int columns = int(alignSize(size.width, Pack::COUNT));
    AutoBuffer<float> depths(columns), growths(columns);
    std::fill(depths.data(), depths.data() + columns, patch.variable.at(start));
    std::fill(growths.data(), growths.data() + columns, 0.f);
    RowOfDepths pixels(other, variable);
    for (int row = 0; row < size.height; row++, x += step, y += step)
    {
        const RowDepthPatch places(patch, first.y + row);
        prefetchMap(x, y, size, row, step);
        for (int i = 0; i < columns; i += RowOfDepths::MOST)
        {
            pixels.start(depths.data() + i, growths.data() + i, std::min(columns - i, int(RowOfDepths::MOST)));
            bool isOnWay = true;
            for (int k = 0; k < steps && isOnWay; k++)
                isOnWay = pixels.step(places, first.x + i) > enough;
            pixels.finish(depths.data() + i, growths.data() + i, size.width - i, x + i, y + i, row == 0);
        }
    }
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
        v_store(mask + i, v_and(vx_load(mask + i), v_pack_b(inside[0], inside[1], inside[2], inside[3])));
    }
#endif
    for (; i < width; i++)
        mask[i] = x[i] >= low && x[i] <= highX && y[i] >= low && y[i] <= highY ? mask[i] : 0;
}

#endif // CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
