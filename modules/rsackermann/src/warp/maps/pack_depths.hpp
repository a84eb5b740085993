// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// For *.simd.hpp files, as simd_pack.hpp: values of an image at a pack of places.

#include "map_packs.hpp"

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

namespace {

// The inverse depths of the other image between its pixels.
struct PackDepths
{
    const float* depths;
    int step; // values from row to row
    float lastX, lastY;

    explicit PackDepths(const Mat1f& image)
        : depths(image[0]), step(int(image.step1())), lastX(float(image.cols - 1)), lastY(float(image.rows - 1))
    {
    }

#if CV_SIMD_64F
    typedef v_int32 Index;
#else
    typedef int Index;
#endif

    // The upper left one of the four pixels around a place, and where it is between them.
    struct Cell
    {
        Index index;
        Pack x, y;
    };

    static float clamp(float value, float last)
    {
        return std::min(std::max(value, 0.f), last);
    }

#if CV_SIMD_64F
    Cell cellAt(const Pack& x, const Pack& y) const
    {
        const v_float32 zero = vx_setzero_f32(), limitX = vx_setall_f32(lastX), limitY = vx_setall_f32(lastY),
                        one = vx_setall_f32(1), insideX = v_min(v_max(x.v, zero), limitX),
                        insideY = v_min(v_max(y.v, zero), limitY);
        const v_int32 column = v_trunc(v_min(insideX, v_sub(limitX, one))),
                      row = v_trunc(v_min(insideY, v_sub(limitY, one)));
        return Cell{v_add(v_mul(row, vx_setall_s32(step)), column), v_sub(insideX, v_cvt_f32(column)),
                    v_sub(insideY, v_cvt_f32(row))};
    }

    static void store(const Index& indices, int* to)
    {
        v_store(to, indices);
    }
    static Index load(const int* indices)
    {
        return vx_load(indices);
    }

    // Row by row.
    void cornersOf(const Index& index, Pack (&corners)[4]) const
    {
        for (int k = 0; k < 4; k += 2)
            v_lut_deinterleave(depths + k / 2 * step, index, corners[k].v, corners[k + 1].v);
    }
#else
    static void store(Index index, int* to)
    {
        *to = index;
    }
    static Index load(const int* index)
    {
        return *index;
    }

    Cell cellAt(const Pack& x, const Pack& y) const
    {
        const float insideX = clamp(x.v, lastX), insideY = clamp(y.v, lastY);
        const int column = std::min(int(insideX), int(lastX) - 1), row = std::min(int(insideY), int(lastY) - 1);
        return Cell{row * step + column, insideX - column, insideY - row};
    }

    void cornersOf(const Index& index, Pack (&corners)[4]) const
    {
        for (int k = 0; k < 4; k++)
            corners[k] = depths[index + k / 2 * step + k % 2];
    }
#endif

    // As InverseDepthImage.
    Pack at(const Pack& x, const Pack& y, const Pack& gap) const
    {
        const Cell cell = cellAt(x, y);
        Pack p[4];
        cornersOf(cell.index, p);
        const Pack least = smaller(smaller(p[0], p[1]), smaller(p[2], p[3])),
                   most = larger(larger(p[0], p[1]), larger(p[2], p[3]));
        const Pack half = 0.5f, top = multiplyAdd(cell.x, p[1] - p[0], p[0]),
                   bottom = multiplyAdd(cell.x, p[3] - p[2], p[2]), nearestTop = choose(cell.x < half, p[0], p[1]),
                   nearestBottom = choose(cell.x < half, p[2], p[3]);
        return choose(most - least > gap, choose(cell.y < half, nearestTop, nearestBottom),
                      multiplyAdd(cell.y, bottom - top, top));
    }
};

} // namespace

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
