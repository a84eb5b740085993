// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// For *.simd.hpp files, as simd_pack.hpp: patches at a pack of pixels.

#include "../../simd_pack.hpp"
#include "depth_patch.hpp"

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

namespace {

typedef PackOf<float> Pack;

// A polynomial along one row. Next to the terms that are constant along the row the rest is small: single precision
// takes no more from it than from the coordinate.
struct RowCubic
{
    float c[Bicubic::NODES];

    RowCubic() {}
    RowCubic(const Bicubic& bicubic, double row) { bicubic.alongRow(row, c); }
};

struct PackCubic
{
    Pack c[Bicubic::NODES];

    PackCubic() {}
    explicit PackCubic(const RowCubic& p)
    {
        for (int n = 0; n < Bicubic::NODES; n++)
            c[n] = p.c[n];
    }

    Pack at(const Pack& x) const { return multiplyAdd(multiplyAdd(multiplyAdd(c[3], x, c[2]), x, c[1]), x, c[0]); }
};

inline Pack columnsFrom(int first)
{
    static const float column[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return Pack::load(column) + float(first);
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

// A patch for pixels anywhere in it, to single precision.
struct FloatDepthPatch
{
    enum { NODES = DepthPatch::NODES };

    RowCubic x[NODES][NODES], y[NODES][NODES]; // [power of the depth][power of the row]

    explicit FloatDepthPatch(const DepthPatch& patch)
    {
        for (int k = 0; k < NODES; k++)
            for (int m = 0; m < NODES; m++)
            {
                std::copy(patch.x[k].c[m], patch.x[k].c[m] + NODES, x[k][m].c);
                std::copy(patch.y[k].c[m], patch.y[k].c[m] + NODES, y[k][m].c);
            }
    }
};

struct PackVariable
{
    Pack bend, low, scale;

    explicit PackVariable(const DepthVariable& v) : bend(v.bend), low(v.low), scale(v.scale) {}

    Pack at(const Pack& inverseDepth) const { return (inverseDepth / (1.f - bend * inverseDepth) - low) * scale; }

    // Newton's step from a value towards that of an inverse depth which grows at a rate with it, with one division.
    Pack step(const Pack& value, const Pack& inverseDepth, const Pack& rate) const
    {
        const Pack divisor = 1.f - bend * inverseDepth, square = divisor * divisor;
        return (scale * (inverseDepth * divisor - low * square) - value * square) / (square - scale * rate);
    }
};

// The places of a pack of pixels.
struct PackCurve
{
    enum { NODES = DepthPatch::NODES };
    typedef Pack Number;

    struct Place
    {
        Pack x, y;
    };

    PackCubic x, y;
    const PackVariable& variable;

    PackCurve(const RowDepthPatch& row, const PackVariable& variable_, const Pack& column) : variable(variable_)
    {
        for (int k = 0; k < NODES; k++)
        {
            x.c[k] = PackCubic(row.x[k]).at(column);
            y.c[k] = PackCubic(row.y[k]).at(column);
        }
    }

    PackCurve(const FloatDepthPatch& patch, const PackVariable& variable_, const Pack& column, const Pack& row)
        : variable(variable_)
    {
        for (int k = 0; k < NODES; k++)
        {
            PackCubic alongX, alongY;
            for (int m = 0; m < NODES; m++)
            {
                alongX.c[m] = PackCubic(patch.x[k][m]).at(column);
                alongY.c[m] = PackCubic(patch.y[k][m]).at(column);
            }
            x.c[k] = alongX.at(row);
            y.c[k] = alongY.at(row);
        }
    }

    Place of(const Pack& value) const { return Place{x.at(value), y.at(value)}; }

    Place at(const Pack& inverseDepth) const { return of(variable.at(inverseDepth)); }
};

} // namespace

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
