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

/** Pixels at the ends of a piece that needn't tell its edge if many images are used together: intensities there may be
those of another edge that begins at the end and goes on to one side, as the upper edge of a window does. Such edges
mostly rise and fall together, and with them short pieces lean by some hundredths of a degree, all of a wall to the same
side; without the ends what is left of short ones errs more. They don't come nearer than they go to the side. */
const double END_FOR_MANY = WINDOW_REACH + 1.5;

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
    //! The same for a segment (x1, y1, x2, y2) whose edge rises or falls.
    void move(double end, Vec4f& segment);

private:
    enum { FEW_ROWS = 24 }; // bring a piece near its edge

    // One step towards the edge. Returns false if there is none.
    bool approach(double end, int maxRows, EdgePiece& piece);
    // Returns false if there are too few rows.
    bool readWindows(double end, int maxRows, const EdgePiece& piece);

    EdgeImage image;
    EdgeWindows windows;
    int firstRow = 0, spacing = 1, count = 0; // of the windows
};

/** Moves segments (x1, y1, x2, y2) onto the edges that they are images of, to a fraction of a pixel, by
EdgeFit::move(). A segment along which there is no edge stays as it is. @param gray CV_8UC1. */
void moveToEdges(const Mat& gray, double end, std::vector<Vec4f>& segments);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_EDGES_HPP
