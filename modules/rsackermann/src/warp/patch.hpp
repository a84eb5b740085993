// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_PATCH_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_PATCH_HPP

#include "opencv2/core.hpp"

namespace cv {
namespace rsackermann {

/** A square part of a map as polynomials of degree 3 in column and row, counted from its first pixel, which interpolate
4 x 4 places (doc/theory.md, "Warp").
*/
struct Patch
{
    enum { NODES = 4 }; // along each side

    double x[NODES][NODES], y[NODES][NODES]; // [m][n]: coefficient of column^n row^m

    Patch() : x(), y() {}

    //! @param nodes places of the pixels (n step, m step).
    Patch(const Point2d nodes[NODES][NODES], double step)
    {
        for (int axis = 0; axis < 2; axis++)
        {
            double (&c)[NODES][NODES] = axis ? y : x;
            for (int m = 0; m < NODES; m++)
                for (int n = 0; n < NODES; n++)
                    c[m][n] = axis ? nodes[m][n].y : nodes[m][n].x;
            for (int m = 0; m < NODES; m++)
                interpolate(step, c[m][0], c[m][1], c[m][2], c[m][3]);
            for (int n = 0; n < NODES; n++)
                interpolate(step, c[0][n], c[1][n], c[2][n], c[3][n]);
        }
    }

    Point2d at(double column, double row) const { return Point2d(value(x, column, row), value(y, column, row)); }

private:
    // Values at 0, step, 2 step and 3 step become the coefficients of the cubic through them.
    static void interpolate(double step, double& c0, double& c1, double& c2, double& c3)
    {
        const double difference = c1 - c0, second = c2 - 2 * c1 + c0, third = c3 - 3 * (c2 - c1) - c0;
        c1 = (difference - second / 2 + third / 3) / step;
        c2 = (second - third) / (2 * step * step);
        c3 = third / (6 * step * step * step);
    }

    static double value(const double (&c)[NODES][NODES], double column, double row)
    {
        double v = 0;
        for (int m = NODES - 1; m >= 0; m--)
            v = v * row + c[m][0] + column * (c[m][1] + column * (c[m][2] + column * c[m][3]));
        return v;
    }
};

//! Scaled inverse depth of a plane of the scene, which is linear over the pixels of the global-shutter image.
struct PlaneDepth
{
    double at0, perColumn, perRow;
    double at(double column, double row) const { return at0 + column * perColumn + row * perRow; }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_PATCH_HPP
