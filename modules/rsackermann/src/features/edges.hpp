// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FEATURES_EDGES_HPP
#define OPENCV_RSACKERMANN_SRC_FEATURES_EDGES_HPP

#include "edge_kernels.hpp"

namespace cv { namespace rsackermann {

//! An edge that crosses rows: column = middle + slope t + curvature t^2, with t from the middle of its rows.
struct EdgePiece
{
    double first, last; // rows
    double middle, slope, curvature;
    bool rises; // from left to right

    double middleRow() const { return (first + last) / 2; }
    double column(double row) const
    {
        const double t = row - middleRow();
        return middle + t * (slope + t * curvature);
    }
};

/** Finds straight or, if a lens has bent them, evenly curved edges.
@param gray CV_8UC1.
@param noise standard deviation of the noise, grey levels.
@param leastRows of a piece. */
std::vector<EdgePiece> findEdges(const Mat& gray, double noise, int leastRows);

//! An image whose rows and columns may change places without being copied.
struct EdgeImage
{
    const uchar* data;
    size_t rowStep, columnStep;
    int rows, columns;

    EdgeImage(const Mat& gray, bool isTransposed)
        : data(gray.data), rowStep(isTransposed ? 1 : gray.step), columnStep(isTransposed ? size_t(gray.step) : 1),
          rows(isTransposed ? gray.cols : gray.rows), columns(isTransposed ? gray.rows : gray.cols)
    {
    }
};

//! Moves pieces onto their edges in an image, with buffers that serve the next piece, too.
class EdgeFit
{
public:
    explicit EdgeFit(const EdgeImage& image_) : image(image_) {}

    /** Moves a piece onto its edge: row by row the centre of gravity of the gradient beside it, then a line, or a
    parabola if the piece is curved, by weighted least squares.
    @param end rows at both ends that needn't tell the edge, as other edges begin there.
    @param piece within a pixel or two of the edge; stays as it is if there is none. */
    void move(double end, EdgePiece& piece);

private:
    // One step towards the edge. Returns false if there is none.
    bool approach(double end, int maxRows, EdgePiece& piece);
    void readWindows(int row, int spacing, int count, const EdgePiece& piece);

    EdgeImage image;
    EdgeWindows windows;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_EDGES_HPP
