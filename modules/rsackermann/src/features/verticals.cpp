// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../parallel_loop.hpp"
#include "detectors.hpp"
#include "edges.hpp"

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

} // namespace

// The segments of a strip of the smaller image, in the image itself.
static std::vector<Vec4f> findInStrip(const Strip& strip, const Mat& gray, const Mat& smaller, double scale,
                                      double noise, double minLength, bool isForMany)
{
    // Rows at the ends of a piece that needn't tell the edge; for many images as in refineSegments().
    const double end = 1.5, endForMany = 4.5;
    std::vector<Vec4f> segments;
    Mat image;
    if (strip.isTransposed)
        transpose(smaller.rowRange(strip.seen), image);
    else
        image = smaller.colRange(strip.seen);
    EdgeFit fit(EdgeImage(gray, strip.isTransposed));
    // Diagonals cross fewer rows than they are long.
    for (EdgePiece& p : findEdges(image, noise, cvFloor(0.7 * minLength / scale)))
    {
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
    return segments;
}

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
    const double noise = imageNoise(smaller);
    forEachInParallel(int(strips.size()), [&](int i) {
        found[i] = findInStrip(strips[i], gray, smaller, scale, noise, minLength, isForMany);
    });
    segments.clear();
    for (size_t i = 0; i < found.size(); i++)
        segments.insert(segments.end(), found[i].begin(), found[i].end());
}

}} // namespace cv::rsackermann
