// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FEATURES_EDGE_CHAINS_HPP
#define OPENCV_RSACKERMANN_SRC_FEATURES_EDGE_CHAINS_HPP

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

/** Links the edges of rows to chains and cuts these into straight or, if a lens has bent them, evenly curved pieces. */
class EdgeChains
{
public:
    /** @param gray CV_8UC1.
    @param noise standard deviation of the noise, grey levels.
    @param leastRows of a piece. */
    EdgeChains(const Mat& gray, double noise, int leastRows);

    //! Adds the pieces.
    void find(std::vector<EdgePiece>& pieces);

private:
    struct Point
    {
        float column, step;
        int row, previous; // place of the chain's point before
    };
    struct Chain
    {
        float column, slope; // expected in the next row
        int count;           // points; 0: it has ended
        int first, last;     // places of points
        int missed;          // rows since the last one
        int found;           // edge of the present row
        bool rises;
    };
    enum { NONE = -1 };

    void findRow(int row);
    void choose();
    void follow(int row);
    int addPoint(const EdgePoint& edge, int row, int previous);
    void begin(int row);
    void end(const Chain& chain);
    void cut(int begin, int end, int depth);

    ParabolaFit fit(int begin, int end, bool isCurved) const;
    void add(int begin, int end, bool isCurved);

    const Mat& gray;
    int leastRows;
    double noise;
    std::vector<short> buffer;
    std::vector<EdgePoint> found; // in the present row, the first foundCount of them
    int foundCount;
    std::vector<int> owners;
    std::vector<Point> points, chain; // of all chains, of one that has ended
    int unused;                       // place of the last of the points of chains that have ended
    std::vector<Chain> chains, next;
    std::vector<ParabolaSums> sums; // over the points before one
    std::vector<EdgePiece>* result;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_EDGE_CHAINS_HPP
