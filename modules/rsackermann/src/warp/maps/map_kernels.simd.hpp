// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../opencv_versions.hpp"
#include "opencv2/imgproc.hpp"
#include "depth_patch.hpp"
#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY
#include "row_of_depths.hpp"
#endif

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

void evaluatePatches(const MapPatch* patches, const Bicubic* depths, int count, const Coordinates& to);
void evaluateDepthPatch(const DepthPatch& patch, const Mat1f& depths, const Coordinates& to);
void searchDepthPatch(const DepthPatch& patch, const Mat1f& depths, float start, const Point& first,
                      const Coordinates& to);
void packFixedPoint(const float* x, const float* y, int width, short* whole, ushort* fraction);
void packMask(const float* x, const float* y, int width, float low, float highX, float highY, uchar* mask);

#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

namespace {

// A row of one patch.
void evaluateRow(const MapPatch& patch, int row, int width, float* x, float* y)
{
    const PackCubic cubicX(RowCubic(patch.x, row).c), cubicY(RowCubic(patch.y, row).c);
    for (int i = 0; i < width; i += Pack::COUNT)
    {
        const Pack column = columnsFrom(i);
        storeFirst(cubicX.at(column), width - i, x + i);
        storeFirst(cubicY.at(column), width - i, y + i);
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

} // namespace

void evaluatePatches(const MapPatch* patches, const Bicubic* depths, int count, const Coordinates& to)
{
    AutoBuffer<RowPatch, 4> rows(count);
    for (int row = 0; row < to.size.height; row++)
    {
        float *x = to.x + row * to.step, *y = to.y + row * to.step;
        if (count == 1)
        {
            evaluateRow(patches[0], row, to.size.width, x, y);
            continue;
        }
        for (int i = 0; i < count; i++)
            rows[i] = RowPatch(patches[i], depths[i], row);
        evaluateNearest(rows.data(), count, to.size.width, x, y);
    }
}

void evaluateDepthPatch(const DepthPatch& patch, const Mat1f& depths, const Coordinates& to)
{
    const PackVariable variable(patch.variable);
    for (int row = 0; row < to.size.height; row++)
    {
        const RowDepthPatch places(patch, row);
        for (int i = 0; i < to.size.width; i += Pack::COUNT)
        {
            const int count = to.size.width - i;
            const size_t at = row * to.step + i;
            const PackCurve::Place place =
                PackCurve(places, variable, columnsFrom(i)).at(loadFirst(depths[row] + i, count));
            storeFirst(place.x, count, to.x + at);
            storeFirst(place.y, count, to.y + at);
        }
    }
}

// From what the rows above let expect a second step is rarely needed.
void searchDepthPatch(const DepthPatch& patch, const Mat1f& image, float start, const Point& first,
                      const Coordinates& to)
{
    const int steps = 4;
    const float enough = 1e-3f; // pixels that a step moves a place: what is left is less than the half of it
    const PackDepths other(image);
    const PackVariable variable(patch.variable);
    const int columns = int(alignSize(to.size.width, Pack::COUNT));
    AutoBuffer<float> depths(columns), growths(columns);
    std::fill(depths.data(), depths.data() + columns, patch.variable.at(start));
    std::fill(growths.data(), growths.data() + columns, 0.f);
    RowOfDepths pixels(other, variable);
    for (int row = 0; row < to.size.height; row++)
    {
        const RowDepthPatch places(patch, first.y + row);
        for (int i = 0; i < columns; i += RowOfDepths::MOST)
        {
            pixels.start(depths.data() + i, growths.data() + i, std::min(columns - i, int(RowOfDepths::MOST)));
            bool isOnWay = true;
            for (int k = 0; k < steps && isOnWay; k++)
                isOnWay = pixels.step(places, first.x + i) > enough;
            const size_t at = row * to.step + i;
            pixels.finish(depths.data() + i, growths.data() + i, to.size.width - i, to.x + at, to.y + at, row == 0);
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
