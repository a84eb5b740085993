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

template <int DEGREE>
struct PackPolynomial
{
    Pack c[DEGREE + 1];

    PackPolynomial() {}
    explicit PackPolynomial(const float* coefficients) { std::copy(coefficients, coefficients + DEGREE + 1, c); }

    Pack at(const Pack& x) const
    {
        Pack v = c[DEGREE];
        for (int n = DEGREE - 1; n >= 0; n--)
            v = multiplyAdd(v, x, c[n]);
        return v;
    }
};

typedef PackPolynomial<Bicubic::NODES - 1> PackCubic;

// A polynomial along one row. Next to the terms that are constant along the row the rest is small: single precision
// takes no more from it than from the coordinate.
struct RowCubic
{
    float c[Bicubic::NODES];

    RowCubic() {}
    RowCubic(const Bicubic& bicubic, double row) { bicubic.alongRow(row, c); }

    Pack at(const Pack& column) const { return PackCubic(c).at(column); }
};

inline Pack columnsFrom(int first)
{
    static const float column[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return Pack::load(column) + float(first);
}

// A polynomial in column and row, to single precision.
struct FloatBicubic
{
    RowCubic c[Bicubic::NODES];

    FloatBicubic() {}
    explicit FloatBicubic(const Bicubic& bicubic)
    {
        for (int m = 0; m < Bicubic::NODES; m++)
            std::copy(bicubic.c[m], bicubic.c[m] + Bicubic::NODES, c[m].c);
    }

    Pack at(const Pack& column, const Pack& row) const
    {
        PackCubic along;
        for (int m = 0; m < Bicubic::NODES; m++)
            along.c[m] = c[m].at(column);
        return along.at(row);
    }
};

// The coefficients of the powers of the depth: polynomials along one row, or for pixels anywhere in the patch.
template <class Polynomial>
struct DepthPowers
{
    Polynomial x[DepthPatch::POWERS], y[DepthPatch::POWERS];

    template <class... Row>
    explicit DepthPowers(const DepthPatch& patch, Row... row)
    {
        for (int k = 0; k < DepthPatch::POWERS; k++)
        {
            x[k] = Polynomial(patch.x[k], row...);
            y[k] = Polynomial(patch.y[k], row...);
        }
    }
};

typedef DepthPowers<RowCubic> RowDepthPatch;
typedef DepthPowers<FloatBicubic> FloatDepthPatch;

struct PackVariable
{
    Pack bend, middle, scale;

    explicit PackVariable(const DepthVariable& v) : bend(v.bend), middle(v.middle), scale(v.scale) {}

    Pack at(const Pack& inverseDepth) const { return (inverseDepth / (1.f - bend * inverseDepth) - middle) * scale; }

    // Newton's step from a value towards that of an inverse depth which grows at a rate with it, with one division.
    Pack step(const Pack& value, const Pack& inverseDepth, const Pack& rate) const
    {
        const Pack divisor = 1.f - bend * inverseDepth, square = divisor * divisor;
        return (scale * (inverseDepth * divisor - middle * square) - value * square) / (square - scale * rate);
    }
};

// The places of a pack of pixels.
struct PackCurve
{
    typedef Pack Number;

    struct Place
    {
        Pack x, y;
    };

    PackPolynomial<DepthPatch::POWERS - 1> x, y;
    const PackVariable& variable;

    //! @param at columns and, if the polynomials aren't those of one row, rows.
    template <class Powers, class... At>
    PackCurve(const Powers& powers, const PackVariable& variable_, const At&... at) : variable(variable_)
    {
        for (int k = 0; k < DepthPatch::POWERS; k++)
        {
            x.c[k] = powers.x[k].at(at...);
            y.c[k] = powers.y[k].at(at...);
        }
    }

    Place of(const Pack& value) const { return Place{x.at(value), y.at(value)}; }

    // With the rates at which it moves with the value.
    Place of(const Pack& value, Place& rates) const
    {
        const Pack alongX = multiplyAdd(value, x.c[2], x.c[1]), alongY = multiplyAdd(value, y.c[2], y.c[1]);
        rates = Place{multiplyAdd(value, x.c[2], alongX), multiplyAdd(value, y.c[2], alongY)};
        return Place{multiplyAdd(value, alongX, x.c[0]), multiplyAdd(value, alongY, y.c[0])};
    }

    Place at(const Pack& inverseDepth) const { return of(variable.at(inverseDepth)); }
};

} // namespace

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
