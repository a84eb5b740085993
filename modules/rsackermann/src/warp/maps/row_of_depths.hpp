// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// For *.simd.hpp files, as simd_pack.hpp: the search for depths that differ little.

#include "pack_depths.hpp"

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

namespace {

// Neighbouring pixels of a row on their way to their depths, in passes over all of them: what is looked up for some is
// under way while others are computed.
class RowOfDepths
{
public:
    enum { MOST = 64 };

    RowOfDepths(const PackDepths& other_, const PackVariable& variable_) : other(other_), variable(variable_) {}

    // @param above depths of the row above. @param growths by how much they differ from the next ones, probably.
    void start(const float* above, const float* growths, int count_)
    {
        count = count_;
        for (int i = 0; i < count; i += Pack::COUNT)
            (Pack::load(above + i) + Pack::load(growths + i)).store(depths + i);
    }

    // One of Newton's steps to the depth that the other image has at the place which it gives, exact on a plane.
    // Returns the pixels by which it moves the places.
    float step(const RowDepthPatch& places, int firstColumn)
    {
        findPlaces(places, firstColumn);
        lookUp();
        return moveOn();
    }

    // @param above, growths receive those for the next row. @param width of what is left of the row.
    void finish(float* above, float* growths, int width, float* toX, float* toY, bool isFirst) const
    {
        for (int i = 0; i < count; i += Pack::COUNT)
        {
            const Pack depth = Pack::load(depths + i);
            if (!isFirst)
                (depth - Pack::load(above + i)).store(growths + i);
            depth.store(above + i);
            storeFirst(Pack::load(x + i), width - i, toX + i);
            storeFirst(Pack::load(y + i), width - i, toY + i);
        }
    }

private:
    void findPlaces(const RowDepthPatch& places, int firstColumn)
    {
        for (int i = 0; i < count; i += Pack::COUNT)
        {
            PackCurve::Place rates;
            const PackCurve::Place place =
                PackCurve(places, variable, columnsFrom(firstColumn + i)).of(Pack::load(depths + i), rates);
            const PackDepths::Cell cell = other.cellAt(place.x, place.y);
            place.x.store(x + i);
            place.y.store(y + i);
            rates.x.store(rateX + i);
            rates.y.store(rateY + i);
            cell.x.store(cellX + i);
            cell.y.store(cellY + i);
            PackDepths::store(cell.index, indices + i);
        }
    }

    // The widest vectors look values up more slowly than two half as wide.
    void lookUp()
    {
#if CV_SIMD256
        const int lanes = 8;
        for (int i = 0; i < count; i += lanes)
        {
            const v_int32x8 index = v256_load(indices + i);
            for (int k = 0; k < 4; k += 2)
            {
                v_float32x8 left, right;
                v_lut_deinterleave(other.depths + k / 2 * other.step, index, left, right);
                v_store(corners[k] + i, left);
                v_store(corners[k + 1] + i, right);
            }
        }
#else
        for (int i = 0; i < count; i += Pack::COUNT)
        {
            Pack found[4];
            other.cornersOf(PackDepths::load(indices + i), found);
            for (int k = 0; k < 4; k++)
                found[k].store(corners[k] + i);
        }
#endif
    }

    float moveOn()
    {
        Pack furthest = 0;
        for (int i = 0; i < count; i += Pack::COUNT)
        {
            const Pack p0 = Pack::load(corners[0] + i), p1 = Pack::load(corners[1] + i),
                       down = Pack::load(corners[2] + i) - p0, downRight = Pack::load(corners[3] + i) - p1,
                       inCellX = Pack::load(cellX + i), inCellY = Pack::load(cellY + i),
                       left = multiplyAdd(inCellY, down, p0), perX = multiplyAdd(inCellY, downRight, p1) - left,
                       perY = multiplyAdd(inCellX, downRight - down, down), found = multiplyAdd(inCellX, perX, left);
            const Pack depth = Pack::load(depths + i), ratesX = Pack::load(rateX + i), ratesY = Pack::load(rateY + i),
                       change = variable.step(depth, found, multiplyAdd(perX, ratesX, perY * ratesY)),
                       moveX = change * ratesX, moveY = change * ratesY;
            (depth + change).store(depths + i);
            (Pack::load(x + i) + moveX).store(x + i);
            (Pack::load(y + i) + moveY).store(y + i);
            furthest = larger(furthest, larger(magnitude(moveX), magnitude(moveY)));
        }
        return largest(furthest);
    }

    const PackDepths& other;
    const PackVariable& variable;
    int count = 0; // a multiple of Pack::COUNT
    CV_DECL_ALIGNED(64) float depths[MOST];
    float x[MOST], y[MOST], rateX[MOST], rateY[MOST]; // places, and by how much they move with the depths
    int indices[MOST];                                // of the upper left one of the four pixels around a place
    float cellX[MOST], cellY[MOST];                   // the place between them
    float corners[4][MOST];
};

} // namespace

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
