// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "edge_fit.hpp"
#include "parabola_fit.hpp"

namespace cv { namespace rsackermann {

enum { REACH = 3 }; // pixels of the window to both sides

// Sums of the gradient of a row in a window about a column, with powers of the distance from it.
struct RowMoments
{
    float m0, m1, m2;
};

// Returns false near the border of the image.
static bool momentsOf(const EdgeImage& image, int row, float column, float sign, RowMoments& m)
{
    const int taps = 2 * REACH, start = cvFloor(column - 0.5f) - REACH + 1; // of pixels; gradients are between them
    if (!(start >= 0 && start + taps < image.columns))
        return false;
    const uchar* p = image.data + row * image.rowStep + start * image.columnStep;
    const float scale = 1.f / (REACH * REACH);
    m.m0 = m.m1 = m.m2 = 0;
    float u = start + 0.5f - column, last = p[0];
    for (int k = 0; k < taps; k++, u += 1)
    {
        p += image.columnStep;
        const float inside = 1 - u * u * scale, g = inside * inside * (*p - last) * sign;
        last = *p;
        m.m0 += g;
        m.m1 += g * u;
        m.m2 += g * u * u;
    }
    return true;
}

// One step towards the edge. Returns false if there is none.
static bool approach(const EdgeImage& image, double end, int maxRows, EdgePiece& piece)
{
    const double longestEnd = 0.15, rows = piece.last - piece.first, cutOff = std::min(end, longestEnd * rows),
                 centre = piece.middleRow();
    const int first = std::max(cvCeil(piece.first + cutOff), 0),
              last = std::min(cvFloor(piece.last - cutOff), image.rows - 1),
              spacing = std::max((last - first + 1) / maxRows, 1), count = (last - first) / spacing + 1;
    if (last - first < 3)
        return false;
    AutoBuffer<RowMoments> moments(count);
    const float sign = piece.rises ? 1.f : -1.f;
    double m0 = 0, m1 = 0, m2 = 0;
    for (int i = 0; i < count; i++)
    {
        const int row = first + i * spacing;
        if (!momentsOf(image, row, float(piece.column(row)), sign, moments[i]))
            moments[i].m0 = 0;
        if (!(moments[i].m0 > 0))
            continue;
        m0 += moments[i].m0;
        m1 += moments[i].m1;
        m2 += moments[i].m2;
    }
    if (!(m0 > 0))
        return false;
    // The window draws the centre of gravity of a blurred edge to its own.
    const double windowVariance = REACH * REACH / 7., largestGain = 3;
    const double variance = std::max(m2 / m0 - (m1 / m0) * (m1 / m0), 0.),
                 gain = std::min(windowVariance / std::max(windowVariance - variance, 1e-3), largestGain),
                 mean2 = (m0 / count) * (m0 / count);
    // Rows of much contrast count up to twice as much as usual ones; rows that differ count less (after Geman and
    // McClure).
    ParabolaFit f = {0, 0, 0, 0};
    for (int step = 0; step < 3; step++)
    {
        ParabolaSums sums;
        for (int i = 0; i < count; i++)
        {
            const RowMoments& m = moments[i];
            if (!(m.m0 > 0))
                continue;
            const double t = first + i * spacing - centre, x = gain * m.m1 / m.m0,
                         r = step ? x - f.middle - t * (f.slope + t * f.curvature) : 0, q = 1 + r * r;
            sums.add(t, x, m.m0 * m.m0 / ((m.m0 * m.m0 + mean2) * q * q));
        }
        f = sums.fit(piece.curvature != 0);
        if (f.squares == DBL_MAX)
            return false;
    }
    if (std::abs(f.middle) + std::abs(f.slope) * rows / 2 > REACH)
        return false;
    piece.middle += f.middle;
    piece.slope += f.slope;
    piece.curvature += f.curvature;
    return true;
}

void fitEdge(const EdgeImage& image, double end, EdgePiece& piece)
{
    const int steps = 3, fewRows = 24; // few rows bring a piece near its edge
    EdgePiece moved = piece;
    for (int step = 1; step < steps; step++)
        if (!approach(image, end, fewRows, moved))
            return;
    if (approach(image, end, INT_MAX, moved))
        piece = moved;
}

}} // namespace cv::rsackermann
