// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAP_PATCH_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAP_PATCH_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

/** A polynomial of degree 3 in column and row, counted from the first pixel of a square, which interpolates 4 x 4
values (doc/theory.md, "Warp").
*/
struct Bicubic
{
    enum { NODES = 4 }; // along each side

    double c[NODES][NODES]; // [m][n]: coefficient of column^n row^m

    Bicubic() : c() {}

    //! A linear function.
    Bicubic(double at0, double perColumn, double perRow) : c()
    {
        c[0][0] = at0;
        c[0][1] = perColumn;
        c[1][0] = perRow;
    }

    //! @param values those at the pixels (n step, m step).
    Bicubic(const double values[NODES][NODES], double step)
    {
        for (int m = 0; m < NODES; m++)
        {
            std::copy(values[m], values[m] + NODES, c[m]);
            interpolate(step, c[m][0], c[m][1], c[m][2], c[m][3]);
        }
        for (int n = 0; n < NODES; n++)
            interpolate(step, c[0][n], c[1][n], c[2][n], c[3][n]);
    }

    //! The coefficients of the powers of the column in a row.
    void alongRow(double row, float (&polynomial)[NODES]) const
    {
        for (int n = 0; n < NODES; n++)
        {
            double v = c[NODES - 1][n];
            for (int m = NODES - 2; m >= 0; m--)
                v = v * row + c[m][n];
            polynomial[n] = float(v);
        }
    }

    double at(double column, double row) const
    {
        double v = 0;
        for (int m = NODES - 1; m >= 0; m--)
            v = v * row + c[m][0] + column * (c[m][1] + column * (c[m][2] + column * c[m][3]));
        return v;
    }

    //! Values at 0, step, 2 step and 3 step become the coefficients of the cubic through them.
    static void interpolate(double step, double& c0, double& c1, double& c2, double& c3)
    {
        const double difference = c1 - c0, second = c2 - 2 * c1 + c0, third = c3 - 3 * (c2 - c1) - c0;
        c1 = (difference - second / 2 + third / 3) / step;
        c2 = (second - third) / (2 * step * step);
        c3 = third / (6 * step * step * step);
    }
};

//! A square part of a map.
struct MapPatch
{
    enum { NODES = Bicubic::NODES, CHECKS = 4, CHECKS_WITH_KNOTS = CHECKS + (NODES - 1) * (NODES - 1) };

    Bicubic x, y;

    MapPatch() {}

    //! @param nodes places of the pixels (n step, m step).
    MapPatch(const Point2d nodes[NODES][NODES], double step)
    {
        double valuesX[NODES][NODES], valuesY[NODES][NODES];
        for (int i = 0; i < NODES * NODES; i++)
        {
            valuesX[i / NODES][i % NODES] = nodes[i / NODES][i % NODES].x;
            valuesY[i / NODES][i % NODES] = nodes[i / NODES][i % NODES].y;
        }
        x = Bicubic(valuesX, step);
        y = Bicubic(valuesY, step);
    }

    Point2d at(double column, double row) const { return Point2d(x.at(column, row), y.at(column, row)); }

    /** The pixels at which the error is measured.

It is of fourth order along both axes. At these pixels it is nearly as large as anywhere on their side of the square,
with signs of its two parts that are the same at some and opposite at others. The knots of an inverse-depth offset can
be anywhere: the centres between the nodes are checked, too.
*/
    static Point2d check(int i, double step)
    {
        static const double places[CHECKS][2] = {{0.38, 0.38}, {2.62, 2.62}, {0.38, 1.5}, {1.5, 2.62}};
        if (i < CHECKS)
            return Point2d(places[i][0] * step, places[i][1] * step);
        const int centre = i - CHECKS, along = NODES - 1;
        return Point2d((centre % along + 0.5) * step, (centre / along + 0.5) * step);
    }

    //! Whether a place that a patch gives is near enough to the exact one; false for NaN, too. @param hasKnots whether
    //! rows turn by a curve, between whose knots errors may be larger than at the checks. @param times by how much the
    //! error may be larger.
    static bool isNear(const Point2d& a, const Point2d& b, bool hasKnots = false, double times = 1)
    {
        // Pixels. With the rounding of the places to single precision this stays far below the 1/32 pixel of cv::remap.
        const double maxError = hasKnots ? 1e-4 : 2.5e-4;
        return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) <= times * maxError;
    }
};

//! Where the coordinates of a block of pixels of a map are, with step floats from row to row.
struct Coordinates
{
    float *x, *y;
    size_t step;
    Size size;
};

/** Which planes of a square may be nearest somewhere in it.
@param depths of each plane, numbers of which none is above that of another plane only if the plane is nowhere nearer.
@param visible receives their indices.
@return how many these are. */
template <int PLANES, int COUNT>
int findVisible(const Vec<double, COUNT> (&depths)[PLANES], int (&visible)[PLANES])
{
    int count = 0;
    for (int i = 0; i < PLANES; i++)
    {
        bool hidden = false;
        for (int j = 0; j < PLANES && !hidden; j++)
        {
            const Vec<double, COUNT> ahead = depths[j] - depths[i];
            const auto range = std::minmax_element(ahead.val, ahead.val + COUNT);
            hidden = j != i && *range.first >= 0 && (*range.second > 0 || j < i);
        }
        if (!hidden)
            visible[count++] = i;
    }
    return count;
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAP_PATCH_HPP
