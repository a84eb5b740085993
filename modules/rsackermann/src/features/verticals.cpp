// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "detectors.hpp"
#include "edge_chains.hpp"
#include "edge_fit.hpp"
#include "image_noise.hpp"

namespace cv { namespace rsackermann {

enum { STRIP_WIDTH = 240, OVERLAP = 24 }; // pixels

namespace {

//! A part of an image in which edges are searched that cross its rows.
struct Strip
{
    bool isTransposed;
    int width;       // of the image
    Range own, seen; // columns
};

class FindEdges : public ParallelLoopBody
{
public:
    FindEdges(const Mat& searched_, const Mat& gray_, const std::vector<Strip>& strips_, double noise_, double scale_,
              double minLength_, bool isForMany_, std::vector<std::vector<Vec4f>>& found_)
        : searched(searched_), gray(gray_), strips(strips_), noise(noise_), scale(scale_), minLength(minLength_),
          isForMany(isForMany_), found(found_)
    {
    }

    void operator()(const Range& range) const CV_OVERRIDE
    {
        for (int i = range.start; i < range.end; i++)
            find(strips[i], found[i]);
    }

private:
    void find(const Strip& strip, std::vector<Vec4f>& segments) const
    {
        // Rows at the ends of a piece that needn't tell the edge; for many images as in refineSegments().
        const double end = 1.5, endForMany = 4.5;
        segments.clear();
        Mat image;
        if (strip.isTransposed)
            transpose(searched.rowRange(strip.seen), image);
        else
            image = searched.colRange(strip.seen);
        EdgeFit fit(EdgeImage(gray, strip.isTransposed));
        std::vector<EdgePiece> pieces;
        // Diagonals cross fewer rows than they are long.
        EdgeChains(image, noise, cvFloor(0.7 * minLength / scale)).find(pieces);
        for (size_t i = 0; i < pieces.size(); i++)
        {
            EdgePiece& p = pieces[i];
            p.middle += strip.seen.start;
            // In the overlap an edge is found twice and taken from the strip that has its middle.
            if ((strip.own.start > 0 && p.middle < strip.own.start) ||
                (strip.own.end < strip.width && p.middle >= strip.own.end))
                continue;
            if ((p.last - p.first + 1) * std::sqrt(1 + p.slope * p.slope) * scale < 0.95 * minLength)
                continue;
            // Up to the borders of the pixels, in the image itself.
            const double shift = (scale - 1) / 2;
            p.first = (p.first - 0.5) * scale + shift;
            p.last = (p.last + 0.5) * scale + shift;
            p.middle = p.middle * scale + shift;
            p.curvature /= scale;
            fit.move(scale * (isForMany ? endForMany : end), p);
            const Vec4f s(float(p.column(p.first)), float(p.first), float(p.column(p.last)), float(p.last));
            segments.push_back(strip.isTransposed ? Vec4f(s[1], s[0], s[3], s[2]) : s);
        }
    }

    const Mat& searched;
    const Mat& gray;
    const std::vector<Strip>& strips;
    double noise, scale, minLength;
    bool isForMany;
    std::vector<std::vector<Vec4f>>& found;
};

} // namespace

void detectVerticals(const Mat& gray, const Mat& smaller, int scale, double minLength, bool isForMany,
                     std::vector<Vec4f>& segments)
{
    std::vector<Strip> strips;
    for (int k = 0; k < 2; k++)
    {
        const int width = k ? smaller.rows : smaller.cols, count = std::max(cvRound(width / double(STRIP_WIDTH)), 1);
        for (int i = 0; i < count; i++)
        {
            Strip s;
            s.isTransposed = k == 1;
            s.width = width;
            s.own = Range(int(int64(width) * i / count), int(int64(width) * (i + 1) / count));
            s.seen = Range(std::max(s.own.start - OVERLAP, 0), std::min(s.own.end + OVERLAP, width));
            strips.push_back(s);
        }
    }
    std::vector<std::vector<Vec4f>> found(strips.size());
    parallel_for_(Range(0, int(strips.size())),
                  FindEdges(smaller, gray, strips, imageNoise(smaller), scale, minLength, isForMany, found));
    segments.clear();
    for (size_t i = 0; i < found.size(); i++)
        segments.insert(segments.end(), found[i].begin(), found[i].end());
}

}} // namespace cv::rsackermann
