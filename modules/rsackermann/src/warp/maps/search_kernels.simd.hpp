// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../opencv_versions.hpp"
#include "../../prefetch.hpp"
#include "../depth/surface_search.hpp"
#include "depth_patch.hpp"
#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY
#include "map_packs.hpp"
#endif

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

void searchDepthPatch(const DepthPatch& patch, const Mat1f& depths, float start, const Point& first, const Size& size,
                      float* x, float* y, size_t step);
void searchSurfaces(const DepthPatch& patch, const Mat1f& depths, float low, float high, const Point& first,
                    const Size& size, float* x, float* y, size_t step, Mat1b mask);
void findHidden(const DepthPatch& patch, const Point& first, const Mat1f& depths, float high, float distance,
                const Rect& block, const float* x, const float* y, size_t step, const Point2f& last, Mat1b mask);
#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

namespace {

// The inverse depths of the other image between its pixels.
struct PackDepths
{
    const float* depths;
    int step;
    float lastX, lastY;

    explicit PackDepths(const Mat1f& image)
        : depths(image[0]), step(int(image.step1())), lastX(float(image.cols - 1)), lastY(float(image.rows - 1))
    {
    }

    // The four pixels around a place, row by row, and where it is between them.
    struct Cell
    {
        Pack corners[4], x, y;
    };

    static float clamp(float value, float last) { return std::min(std::max(value, 0.f), last); }

#if CV_SIMD_64F
    Cell cellAt(const Pack& x, const Pack& y) const
    {
        const v_float32 zero = vx_setzero_f32(), limitX = vx_setall_f32(lastX), limitY = vx_setall_f32(lastY),
                        one = vx_setall_f32(1), insideX = v_min(v_max(x.v, zero), limitX),
                        insideY = v_min(v_max(y.v, zero), limitY);
        const v_int32 column = v_trunc(v_min(insideX, v_sub(limitX, one))),
                      row = v_trunc(v_min(insideY, v_sub(limitY, one))),
                      index = v_add(v_mul(row, vx_setall_s32(step)), column);
        Cell cell;
        for (int k = 0; k < 4; k += 2)
            v_lut_deinterleave(depths + k / 2 * step, index, cell.corners[k].v, cell.corners[k + 1].v);
        cell.x = v_sub(insideX, v_cvt_f32(column));
        cell.y = v_sub(insideY, v_cvt_f32(row));
        return cell;
    }
#else
    Cell cellAt(const Pack& x, const Pack& y) const
    {
        const float insideX = clamp(x.v, lastX), insideY = clamp(y.v, lastY);
        const int column = std::min(int(insideX), int(lastX) - 1), row = std::min(int(insideY), int(lastY) - 1);
        Cell cell;
        for (int k = 0; k < 4; k++)
            cell.corners[k] = depths[size_t(row + k / 2) * step + column + k % 2];
        cell.x = insideX - column;
        cell.y = insideY - row;
        return cell;
    }
#endif

    // With the rates at which the depths grow there.
    Pack sample(const PackCurve::Place& place, Pack& perX, Pack& perY) const
    {
        const Cell cell = cellAt(place.x, place.y);
        const Pack *p = cell.corners, down = p[2] - p[0], left = multiplyAdd(cell.y, down, p[0]),
                   right = multiplyAdd(cell.y, p[3] - p[1], p[1]);
        perX = right - left;
        perY = multiplyAdd(cell.x, p[3] - p[2] - (p[1] - p[0]), down);
        return multiplyAdd(cell.x, perX, left);
    }

    // As InverseDepthImage.
    Pack at(const Pack& x, const Pack& y, const Pack& gap) const
    {
        const Cell cell = cellAt(x, y);
        const Pack* p = cell.corners;
        const Pack least = smaller(smaller(p[0], p[1]), smaller(p[2], p[3])),
                   most = larger(larger(p[0], p[1]), larger(p[2], p[3]));
        const Pack half = 0.5f, top = multiplyAdd(cell.x, p[1] - p[0], p[0]),
                   bottom = multiplyAdd(cell.x, p[3] - p[2], p[2]), nearestTop = choose(cell.x < half, p[0], p[1]),
                   nearestBottom = choose(cell.x < half, p[2], p[3]);
        return choose(most - least > gap, choose(cell.y < half, nearestTop, nearestBottom),
                      multiplyAdd(cell.y, bottom - top, top));
    }

    void prefetch(float x, float y) const
    {
        rsackermann::prefetch(depths + size_t(clamp(y, lastY)) * step + size_t(clamp(x, lastX)));
    }
};

// Pixels for which a condition holds are hidden.
template <class Mask>
void storeMask(const Mask& isHidden, int count, uchar* to)
{
    float flags[Pack::COUNT];
    choose(isHidden, Pack(MASK_HIDDEN), Pack(MASK_SEEN)).store(flags);
    std::copy(flags, flags + count, to);
}

} // namespace

// Newton's steps to the depth that the other image has at the place which it gives. The first one is exact on a plane:
// from what the rows above let expect a second one is rarely needed.
void searchDepthPatch(const DepthPatch& patch, const Mat1f& image, float start, const Point& first, const Size& size,
                      float* x, float* y, size_t step)
{
    const int steps = 2, rowsAhead = 4; // the next rows of a tile are elsewhere in memory
    const float enough = 1e-3f;         // pixels that a step moves the place: what is left is less than the half of it
    const PackDepths other(image);
    const PackVariable variable(patch.variable);
    const int columns = int(alignSize(size.width, Pack::COUNT));
    AutoBuffer<float> depths(columns),
        growths(columns); // of the row above, and by how much it differs from the next one
    std::fill(depths.data(), depths.data() + columns, patch.variable.at(start));
    std::fill(growths.data(), growths.data() + columns, 0.f);
    for (int row = 0; row < size.height; row++, x += step, y += step)
    {
        const RowDepthPatch places(patch, first.y + row);
        for (int i = 0; i < size.width; i += Pack::COUNT)
        {
            const PackCurve curve(places, variable, columnsFrom(first.x + i));
            const Pack above = Pack::load(depths.data() + i),
                       pixels = magnitude(curve.x.c[1]) + magnitude(curve.y.c[1]);
            Pack depth = above + Pack::load(growths.data() + i);
            for (int k = 0; k < steps; k++)
            {
                Pack perX, perY;
                const Pack found = other.sample(curve.of(depth), perX, perY),
                           rate = multiplyAdd(perX, curve.x.c[1], perY * curve.y.c[1]),
                           change = variable.step(depth, found, rate);
                depth = depth + change;
                if (!isAnyTrue(magnitude(change) * pixels > enough))
                    break;
            }
            depth.store(depths.data() + i);
            if (row > 0)
                (depth - above).store(growths.data() + i);
            const PackCurve::Place place = curve.of(depth);
            storeFirst(place.x, size.width - i, x + i);
            storeFirst(place.y, size.width - i, y + i);
            other.prefetch(x[i], y[i] + rowsAhead);
        }
    }
}

void searchSurfaces(const DepthPatch& patch, const Mat1f& image, float low, float high, const Point& first,
                    const Size& size, float* x, float* y, size_t step, Mat1b mask)
{
    const PackDepths other(image);
    const PackVariable variable(patch.variable);
    for (int row = 0; row < size.height; row++, x += step, y += step)
    {
        const RowDepthPatch places(patch, first.y + row);
        for (int i = 0; i < size.width; i += Pack::COUNT)
        {
            const PackCurve curve(places, variable, columnsFrom(first.x + i));
            Pack depth;
            const Pack uncovered = SurfaceSearch<PackCurve, PackDepths>(other, curve, low, high).find(depth);
            const PackCurve::Place place = curve.at(depth);
            const int count = std::min(size.width - i, int(Pack::COUNT));
            storeFirst(place.x, count, x + i);
            storeFirst(place.y, count, y + i);
            if (!mask.empty())
                storeMask(uncovered > LARGEST_STRETCH, count, mask[row] + i);
        }
    }
}

void findHidden(const DepthPatch& patch, const Point& first, const Mat1f& depths, float high, float distance,
                const Rect& block, const float* x, const float* y, size_t step, const Point2f& last, Mat1b mask)
{
    const PackDepths own(depths);
    const PackVariable variable(patch.variable);
    const FloatDepthPatch places(patch);
    for (int row = 0; row < block.height; row++, x += step, y += step)
        for (int i = 0; i < block.width; i += Pack::COUNT)
        {
            const int count = std::min(block.width - i, int(Pack::COUNT));
            const Pack placeX = loadFirst(x + i, count), placeY = loadFirst(y + i, count),
                       value = loadFirst(depths[block.y + row] + block.x + i, count),
                       outsideX = magnitude(placeX - 0.5f * last.x), outsideY = magnitude(placeY - 0.5f * last.y);
            // In front of the nearest pixels nothing is; those outside count as seen.
            const Pack low = choose(outsideX > 0.5f * last.x, high, choose(outsideY > 0.5f * last.y, high, value));
            const PackCurve curve(places, variable, placeX - float(first.x), placeY - float(first.y));
            Pack depth;
            SurfaceSearch<PackCurve, PackDepths>(own, curve, low, high).find(depth);
            const PackCurve::Place shown = curve.at(depth);
            const Pack awayX = magnitude(shown.x - (columnsFrom(block.x + i))),
                       awayY = magnitude(shown.y - float(block.y + row)), away = larger(awayX, awayY);
            storeMask(choose(low < high, away, 0.f) > distance, count, mask[row] + i);
        }
}

#endif // CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
