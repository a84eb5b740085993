// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FEATURES_EDGE_KERNELS_HPP
#define OPENCV_RSACKERMANN_SRC_FEATURES_EDGE_KERNELS_HPP

#include "opencv2/core.hpp"
#include "parabola_fit.hpp"

// What takes time in the search for edges, in vectors of the widest kind that the processor has.

namespace cv { namespace rsackermann {

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
