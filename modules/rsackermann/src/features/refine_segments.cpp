// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../parallel_loop.hpp"
#include "parabola_fit.hpp"
#include "refine_segments.hpp"

namespace cv { namespace rsackermann {

namespace {

// Intensities across a segment: at REACH + 1/2, REACH - 1/2 ... -REACH - 1/2 pixels from it.
enum { REACH = 3, INTENSITIES = 2 * REACH + 2, SLOPES = INTENSITIES - 1 };

// Pixels at each end that needn't tell the edge: intensities there may be those of another edge that begins at the end
// and goes on to one side, as the upper edge of a window does. Such edges mostly rise and fall together, and with them
// segments would lean. They don't come nearer than they go to the side, and interpolation takes another pixel.
static const float END = REACH + 1.5f;
static const float LONGEST_END = 0.15f; // of the length

enum { MOST_PLACES = 64 };

inline float bilinear(const Mat& gray, float x, float y)
{
    const int i = cvFloor(x), j = cvFloor(y);
    const float u = x - i, v = y - j;
    const uchar* p = gray.ptr(j) + i;
    const uchar* q = p + gray.step;
    return (1 - v) * (p[0] + u * (p[1] - p[0])) + v * (q[0] + u * (q[1] - q[0]));
}

// Slopes of the intensity across a segment at a point of it. Returns false near the border of the image.
bool slopesAcross(const Mat& gray, const Point2f& at, const Point2f& normal, float slopes[SLOPES])
{
    // The points are added up: they may end somewhat farther away.
    const float reach = REACH + 0.5f, rounding = 0.02f;
    const float dx = reach * std::abs(normal.x), dy = reach * std::abs(normal.y);
    if (!(at.x - dx >= rounding && at.y - dy >= rounding && at.x + dx < gray.cols - 1 - rounding &&
          at.y + dy < gray.rows - 1 - rounding))
        return false;
    Point2f p = at - reach * normal;
    float last = bilinear(gray, p.x, p.y);
    for (int k = 0; k < SLOPES; k++)
    {
        p += normal;
        const float next = bilinear(gray, p.x, p.y);
        slopes[k] = next - last;
        last = next;
    }
    return true;
}

// Centre of gravity of the slope around its peak. The slope is made positive by the sign that it has along the segment.
bool findEdge(const float slopes[SLOPES], float sign, float& beside)
{
    int peak = 1;
    for (int k = 2; k < SLOPES - 1; k++)
        if (sign * slopes[k] > sign * slopes[peak])
            peak = k;
    float sum = 0, moment = 0;
    for (int k = peak - 1; k <= peak + 1; k++)
    {
        const float slope = std::max(sign * slopes[k], 0.f);
        sum += slope;
        moment += slope * (k - REACH);
    }
    const float least = 4; // grey levels
    beside = moment / std::max(sum, least);
    return sum >= least;
}

// The line through places along a segment, from -1 to 1, and beside it, fitted with weights that fall off with the
// distance (after Geman and McClure). Returns false if there is none.
bool fitLine(const Point2f* places, int count, ParabolaFit& line)
{
    line = ParabolaFit();
    for (int i = 0; i < 5 && line.squares < DBL_MAX; i++)
    {
        const double scale = i == 0 ? 0 : 1; // no weights at first, then those of a pixel
        ParabolaSums sums;
        for (int k = 0; k < count; k++)
        {
            const double r = places[k].y - line.middle - line.slope * places[k].x, q = 1 + scale * r * r;
            sums.add(places[k].x, places[k].y, 1 / (q * q));
        }
        line = sums.fit(false);
    }
    return line.squares < DBL_MAX;
}

void refine(const Mat& gray, int maxPlaces, bool usesEnds, Vec4f& segment)
{
    const Point2f first(segment[0], segment[1]), last(segment[2], segment[3]), middle = (first + last) * 0.5f;
    const float length = float(norm(last - first));
    const int count = std::min(cvFloor(length), maxPlaces);
    if (count < 4)
        return;
    const Point2f along = (last - first) * (1 / length), normal(-along.y, along.x);

    const float inner = usesEnds ? 1 : 1 - 2 * std::min(END / length, LONGEST_END);
    float slopes[MOST_PLACES][SLOPES], alongs[MOST_PLACES], total = 0;
    int found = 0;
    for (int i = 0; i < count; i++)
    {
        alongs[found] = inner * ((2 * i + 1.f) / count - 1);
        if (!slopesAcross(gray, middle + alongs[found] * length / 2 * along, normal, slopes[found]))
            continue;
        for (int k = 1; k < SLOPES - 1; k++)
            total += slopes[found][k];
        found++;
    }
    Point2f places[MOST_PLACES];
    int edges = 0;
    for (int i = 0; i < found; i++)
    {
        float beside;
        if (findEdge(slopes[i], total < 0 ? -1.f : 1.f, beside))
            places[edges++] = Point2f(alongs[i], beside);
    }
    ParabolaFit line;
    if (edges * 2 < count || !fitLine(places, edges, line) || std::abs(line.middle) + std::abs(line.slope) > REACH)
        return;
    const float offset = float(line.middle), slope = float(line.slope);
    const Point2f newFirst = first + (offset - slope) * normal, newLast = last + (offset + slope) * normal;
    segment = Vec4f(newFirst.x, newFirst.y, newLast.x, newLast.y);
}

} // namespace

void refineSegments(const Mat& gray, int steps, bool usesEnds, std::vector<Vec4f>& segments)
{
    const int fewPlaces = 24; // bring a segment near the edge
    const double segmentsPerStripe = 32;
    forEachInParallel(
        int(segments.size()),
        [&](int i) {
            for (int step = 1; step < steps; step++)
                refine(gray, fewPlaces, usesEnds, segments[i]);
            refine(gray, MOST_PLACES, usesEnds, segments[i]);
        },
        segments.size() / segmentsPerStripe);
}

}} // namespace cv::rsackermann
