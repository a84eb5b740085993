// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../optim/median.hpp"
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
    const double end = 1.5; // rows at the ends of a piece that needn't tell the edge
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
        fit.move(scale * (isForMany ? END_FOR_MANY : end), p);
        const Vec4f s(float(p.column(p.first)), float(p.first), float(p.column(p.last)), float(p.last));
        segments.push_back(strip.isTransposed ? Vec4f(s[1], s[0], s[3], s[2]) : s);
    }
    return segments;
}

// Whether the middle of a segment is on another one that goes the same way.
static bool isOn(const Vec4f& segment, const Vec4f& other, double tolerance)
{
    const double parallel = 0.1; // rad
    const Point2d middle((segment[0] + segment[2]) / 2, (segment[1] + segment[3]) / 2), a(other[0], other[1]),
        b(other[2], other[3]), along = b - a, own(segment[2] - segment[0], segment[3] - segment[1]);
    if ((middle.x - a.x) * (middle.x - b.x) > 0 || (middle.y - a.y) * (middle.y - b.y) > 0)
        return false;
    const double length = norm(along);
    return std::abs(along.cross(middle - a)) < tolerance * length &&
           std::abs(along.cross(own)) < parallel * length * norm(own);
}

// An edge near the diagonal is found in the image and in the transposed one. It stays where it crosses more rows, and
// so do parts that are found there alone.
static void dropRepeated(size_t ofImage, double tolerance, std::vector<Vec4f>& segments)
{
    const float steepest = 2.5f; // chains follow no edge that crosses as many columns per row
    struct Diagonal
    {
        size_t index;
        float rows;
    };
    std::vector<Diagonal> diagonals;
    for (size_t i = 0; i < segments.size(); i++)
    {
        const Vec4f& s = segments[i];
        const float width = std::abs(s[2] - s[0]), height = std::abs(s[3] - s[1]);
        if (width < steepest * height && height < steepest * width)
            diagonals.push_back({i, i < ofImage ? height : width});
    }
    std::stable_sort(diagonals.begin(), diagonals.end(),
                     [](const Diagonal& a, const Diagonal& b) { return a.rows > b.rows; });
    std::vector<size_t> kept[2];
    std::vector<bool> isDropped(segments.size());
    for (const Diagonal& d : diagonals)
    {
        const bool isTransposed = d.index >= ofImage;
        const std::vector<size_t>& others = kept[!isTransposed];
        isDropped[d.index] = std::any_of(others.begin(), others.end(), [&](size_t other) {
            return isOn(segments[d.index], segments[other], tolerance);
        });
        if (!isDropped[d.index])
            kept[isTransposed].push_back(d.index);
    }
    size_t count = 0;
    for (size_t i = 0; i < segments.size(); i++)
        if (!isDropped[i])
            segments[count++] = segments[i];
    segments.resize(count);
}

double imageNoise(const Mat& gray)
{
    const int enoughPixels = 100000, levels = 8 * UCHAR_MAX + 1;
    const double gain = 6, rounding = 0.29; // of second differences
    std::vector<int> counts(levels);
    const int step = std::max(int(gray.total() / enoughPixels), 1);
    int total = 0;
    for (int y = 1; y + 1 < gray.rows; y += step)
    {
        const uchar* a = gray.ptr(y - 1);
        const uchar* b = gray.ptr(y);
        const uchar* c = gray.ptr(y + 1);
        int left = a[0] - 2 * b[0] + c[0], middle = a[1] - 2 * b[1] + c[1];
        for (int x = 2; x < gray.cols; x++, total++)
        {
            const int right = a[x] - 2 * b[x] + c[x];
            counts[std::abs(left - 2 * middle + right)]++;
            left = middle;
            middle = right;
        }
    }
    int median = 0;
    for (int n = counts[0]; n * 2 < total; n += counts[median])
        median++;
    return std::max(sigmaOfMedian(median) / gain, rounding);
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
    size_t ofImage = 0;
    for (size_t i = 0; i < found.size(); i++)
    {
        segments.insert(segments.end(), found[i].begin(), found[i].end());
        if (!strips[i].isTransposed)
            ofImage = segments.size();
    }
    dropRepeated(ofImage, scale, segments);
}

}} // namespace cv::rsackermann
