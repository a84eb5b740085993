// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FEATURES_EDGE_KERNELS_HPP
#define OPENCV_RSACKERMANN_SRC_FEATURES_EDGE_KERNELS_HPP

#include "opencv2/core.hpp"
#include <cfloat>

namespace cv { namespace rsackermann {

//! x = middle + slope t + curvature t^2 by least squares.
struct ParabolaFit
{
    double middle, slope, curvature;
    double squares; // mean of the squares of what is left; DBL_MAX: there is no such line
};

//! Weighed sums of places x at times t, of which those of any part of a sequence are a difference.
struct ParabolaSums
{
    double n = 0, t = 0, tt = 0, ttt = 0, tttt = 0, x = 0, xt = 0, xtt = 0, xx = 0;

    void add(double time, double place, double weight)
    {
        const double a = weight * time, b = a * time, c = b * time, d = weight * place;
        n += weight;
        t += a;
        tt += b;
        ttt += c;
        tttt += c * time;
        x += d;
        xt += d * time;
        xtt += d * time * time;
        xx += d * place;
    }

    //! These sums without others, about another time.
    ParabolaSums since(const ParabolaSums& other, double origin) const
    {
        const double c = origin, t1 = t - other.t, t2 = tt - other.tt, t3 = ttt - other.ttt, x1 = xt - other.xt;
        ParabolaSums s;
        s.n = n - other.n;
        s.x = x - other.x;
        s.xx = xx - other.xx;
        s.t = t1 - c * s.n;
        s.tt = t2 - 2 * c * t1 + c * c * s.n;
        s.ttt = t3 - 3 * c * t2 + 3 * c * c * t1 - c * c * c * s.n;
        s.tttt = tttt - other.tttt - 4 * c * t3 + 6 * c * c * t2 - 4 * c * c * c * t1 + c * c * c * c * s.n;
        s.xt = x1 - c * s.x;
        s.xtt = xtt - other.xtt - 2 * c * x1 + c * c * s.x;
        return s;
    }

    //! A line unless isCurved.
    ParabolaFit fit(bool isCurved) const
    {
        ParabolaFit f = {0, 0, 0, DBL_MAX};
        const double det = n * tt - t * t;
        if (!(det > 1e-5 * n * n))
            return f;
        f.middle = (x * tt - xt * t) / det;
        f.slope = (xt * n - x * t) / det;
        f.squares = (xx - f.middle * x - f.slope * xt) / n;
        // The square of the time without the line in it.
        const double p0 = (tt * tt - ttt * t) / det, p1 = (ttt * n - tt * t) / det, own = tttt - p0 * tt - p1 * ttt,
                     cross = xtt - p0 * x - p1 * xt;
        if (!isCurved || !(own > 1e-9 * tttt))
            return f;
        f.curvature = cross / own;
        f.middle -= f.curvature * p0;
        f.slope -= f.curvature * p1;
        f.squares -= f.curvature * cross / n;
        return f;
    }
};

// What takes time in the search for edges, in vectors of the widest kind that the processor has.

//! An extreme of the gradient along a row.
struct EdgePoint
{
    float column; // to a fraction of a pixel
    float step;   // grey levels by which the intensity rises there
};

/** Finds the extremes of the gradient along a row, from left to right.

The gradient of a place between two pixels is the difference of the two pixels on each side, in three rows weighed 1, 2
and 1: even the sides of bars of two pixels are where they should be, and noise is reduced.
@param rows the row between its neighbours.
@param least grey levels.
@param buffer of two numbers for each column.
@param points receives the edges; has room for one in each column.
@return their number. */
int findExtremes(const uchar* const (&rows)[3], int width, double least, short* buffer, EdgePoint* points);

enum { WINDOW_REACH = 3, WINDOW_PIXELS = 2 * WINDOW_REACH + 1, WINDOW_STRIDE = 8 };

//! What rows show in windows about the places where an edge is expected, one array for each number; padded by rows
//! without an edge.
struct EdgeWindows
{
    enum { PADDING = 16 };

    int count = 0;             // a multiple of the padding
    std::vector<uchar> pixels; // WINDOW_PIXELS of each row, in WINDOW_STRIDE bytes
    std::vector<float> first;  // from the expected edge to the place between the first two pixels
    std::vector<float> step;   // receives the sum of the weighed gradient; 0: there is no edge
    std::vector<float> centre; // receives its centre of gravity, from the expected edge

    void resize(int rows);
    //! Lets a row have no edge.
    void clear(int row);
};

//! Sums of the gradient over all windows, with powers of the distance from the expected edge.
struct EdgeMoments
{
    double m0, m1, m2;
};

//! @param sign of the edge: 1 if it rises from left to right, otherwise -1.
EdgeMoments sumWindows(EdgeWindows& windows, float sign);

/** The sums from which the edge's line in the windows is fitted.

Rows of much contrast count up to twice as much as usual ones; rows that differ from a line count less (after Geman and
McClure).
@param gain of the centres of gravity.
@param usualSquare square of a usual step.
@param start, spacing times of the rows.
@param line from which rows shouldn't differ; 0: there is none yet. */
ParabolaSums sumCentres(const EdgeWindows& windows, double gain, double usualSquare, double start, double spacing,
                        const ParabolaFit* line);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_EDGE_KERNELS_HPP
