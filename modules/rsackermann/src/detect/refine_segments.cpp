// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "refine_segments.hpp"

namespace cv {
namespace rsackermann {

namespace {

// Intensities across a segment: at REACH + 1/2, REACH - 1/2 ... -REACH - 1/2 pixels from it.
enum { REACH = 3, INTENSITIES = 2 * REACH + 2, SLOPES = INTENSITIES - 1 };

const int MAX_PLACES = 64;

// Where along the segment, and how far beside it, the edge was found.
struct EdgePlace
{
    float along, beside;
    float weight;
};

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
    const float reach = REACH + 0.5f;
    const float dx = reach * std::abs(normal.x), dy = reach * std::abs(normal.y);
    if (!(at.x - dx >= 0 && at.y - dy >= 0 && at.x + dx < gray.cols - 1 && at.y + dy < gray.rows - 1))
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
bool findEdge(const float slopes[SLOPES], float sign, EdgePlace& place)
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
    place.weight = sum;
    place.beside = moment / std::max(sum, least);
    return sum >= least;
}

// The line beside = offset + slope along, fitted with weights that fall off with the distance (after Geman and McClure).
bool fitLine(const std::vector<EdgePlace>& places, float& offset, float& slope)
{
    const double scale2 = 0.3 * 0.3;
    offset = slope = 0;
    for (int i = 0; i < 5; i++)
    {
        double s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
        for (size_t k = 0; k < places.size(); k++)
        {
            const EdgePlace& p = places[k];
            const double r = p.beside - offset - slope * p.along;
            const double w = i == 0 ? 1 : 1 / ((1 + r * r / scale2) * (1 + r * r / scale2));
            s += w;
            sx += w * p.along;
            sy += w * p.beside;
            sxx += w * p.along * p.along;
            sxy += w * p.along * p.beside;
        }
        const double det = s * sxx - sx * sx;
        if (!(det > 1e-6 * s * sxx))
            return false;
        offset = float((sy * sxx - sx * sxy) / det);
        slope = float((s * sxy - sx * sy) / det);
    }
    return true;
}

void refine(const Mat& gray, Vec4f& segment, std::vector<EdgePlace>& places)
{
    const Point2f first(segment[0], segment[1]), last(segment[2], segment[3]), middle = (first + last) * 0.5f;
    const float length = float(norm(last - first));
    const int count = std::min(cvFloor(length), MAX_PLACES);
    if (count < 4)
        return;
    const Point2f along = (last - first) * (1 / length), normal(-along.y, along.x);

    float slopes[MAX_PLACES][SLOPES], alongs[MAX_PLACES], total = 0;
    int found = 0;
    for (int i = 0; i < count; i++)
    {
        alongs[found] = ((i + 0.5f) / count - 0.5f) * length;
        if (!slopesAcross(gray, middle + alongs[found] * along, normal, slopes[found]))
            continue;
        for (int k = 1; k < SLOPES - 1; k++)
            total += slopes[found][k];
        found++;
    }
    places.clear();
    for (int i = 0; i < found; i++)
    {
        EdgePlace place;
        place.along = alongs[i];
        if (findEdge(slopes[i], total < 0 ? -1.f : 1.f, place))
            places.push_back(place);
    }
    float offset, slope;
    if (int(places.size()) * 2 < count || !fitLine(places, offset, slope))
        return;
    const float atFirst = offset - slope * length / 2, atLast = offset + slope * length / 2;
    if (std::max(std::abs(atFirst), std::abs(atLast)) > REACH)
        return;
    const Point2f newFirst = first + atFirst * normal, newLast = last + atLast * normal;
    segment = Vec4f(newFirst.x, newFirst.y, newLast.x, newLast.y);
}

class RefineBody : public ParallelLoopBody
{
public:
    RefineBody(const Mat& gray_, std::vector<Vec4f>& segments_) : gray(gray_), segments(segments_) {}

    void operator()(const Range& range) const CV_OVERRIDE
    {
        std::vector<EdgePlace> places;
        for (int i = range.start; i < range.end; i++)
            refine(gray, segments[i], places);
    }

private:
    const Mat& gray;
    std::vector<Vec4f>& segments;
};

} // namespace

void refineSegments(const Mat& gray, std::vector<Vec4f>& segments)
{
    const double segmentsPerStripe = 64;
    parallel_for_(Range(0, int(segments.size())), RefineBody(gray, segments), segments.size() / segmentsPerStripe);
}

}} // namespace cv::rsackermann
