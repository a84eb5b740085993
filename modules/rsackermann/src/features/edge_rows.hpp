// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FEATURES_EDGE_ROWS_HPP
#define OPENCV_RSACKERMANN_SRC_FEATURES_EDGE_ROWS_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

//! An extreme of the gradient along a row.
struct EdgePoint
{
    float column; // to a fraction of a pixel
    float step;   // grey levels by which the intensity rises there
};

/** Finds the edges that cross the rows of an image.

The gradient of a place between two pixels is the difference of the two pixels on each side, in three rows weighed 1, 2
and 1: even the sides of bars of two pixels are where they should be, and noise is reduced.
*/
class EdgeRows
{
public:
    //! @param gray CV_8UC1. @param columns of it that are searched.
    EdgeRows(const Mat& gray_, const Range& columns_) : gray(gray_), columns(columns_) {}

    //! Standard deviation of the step that white noise of one grey level shows: the norm of the weights.
    static double noiseOfStep() { return 0.612; }

    //! The edges of a row by at least leastStep grey levels, from left to right.
    void find(int row, double leastStep, std::vector<EdgePoint>& points);

private:
    void differentiate(int row);

    const Mat& gray;
    Range columns;
    std::vector<short> sums, gradient;
};

//! Standard deviation of the noise of an image, from its second differences in both directions, grey levels: at least
//! that of rounding.
double imageNoise(const Mat& gray);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_EDGE_ROWS_HPP
