// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "edges.hpp"

#include <cstring>

namespace cv { namespace rsackermann {

void EdgeWindows::resize(int rows)
{
    count = (rows + PADDING - 1) / PADDING * PADDING;
    if (pixels.size() < size_t(count) * WINDOW_STRIDE)
    {
        pixels.resize(size_t(count) * WINDOW_STRIDE);
        first.resize(count);
        step.resize(count);
        centre.resize(count);
    }
    for (int i = rows; i < count; i++)
        clear(i);
}

void EdgeWindows::clear(int row)
{
    std::memset(&pixels[size_t(row) * WINDOW_STRIDE], 0, WINDOW_STRIDE);
    first[row] = 0;
}

bool EdgeFit::readWindows(double end, int maxRows, const EdgePiece& piece)
{
    const double longestEnd = 0.15, cutOff = std::min(end, longestEnd * (piece.last - piece.first));
    const int first = std::max(cvCeil(piece.first + cutOff), 0),
              last = std::min(cvFloor(piece.last - cutOff), image.rows - 1),
              step = std::max((last - first + 1) / maxRows, 1), rows = (last - first) / step + 1;
    if (last - first < 3)
        return false;
    firstRow = first;
    spacing = step;
    count = rows;
    windows.resize(rows);
    // Copies, as bytes that are written might be any of them.
    const EdgeImage full = image;
    const EdgePiece expected = piece;
    uchar* pixels = windows.pixels.data();
    float* firsts = windows.first.data();
    for (int i = 0, row = first; i < rows; i++, row += step, pixels += WINDOW_STRIDE)
    {
        const double column = expected.column(row);
        const int start = cvFloor(column - 0.5) - WINDOW_REACH + 1; // of pixels; gradients are between them
        if (!(start >= 0 && start + WINDOW_PIXELS <= full.columns))
        {
            windows.clear(i);
            continue;
        }
        firsts[i] = float(start + 0.5 - column);
        const uchar* p = full.data + row * full.rowStep + start * full.columnStep;
        if (full.columnStep == 1)
            std::memcpy(pixels, p, WINDOW_PIXELS);
        else
            for (int k = 0; k < WINDOW_PIXELS; k++)
                pixels[k] = p[k * full.columnStep];
    }
    return true;
}

bool EdgeFit::approach(double end, int maxRows, EdgePiece& piece)
{
    if (!readWindows(end, maxRows, piece))
        return false;
    const EdgeMoments sums = sumWindows(windows, piece.rises ? 1.f : -1.f);
    if (!(sums.m0 > 0))
        return false;
    // The window draws the centre of gravity of a blurred edge to its own.
    const double windowVariance = WINDOW_REACH * WINDOW_REACH / 7., largestGain = 3, mean = sums.m1 / sums.m0;
    const double variance = std::max(sums.m2 / sums.m0 - mean * mean, 0.), usualStep = sums.m0 / count,
                 gain = std::min(windowVariance / std::max(windowVariance - variance, 1e-3), largestGain);
    ParabolaFit f = {0, 0, 0, 0};
    for (int step = 0; step < 3; step++)
    {
        f = sumCentres(windows, gain, usualStep * usualStep, firstRow - piece.middleRow(), spacing, step ? &f : 0)
                .fit(piece.curvature != 0);
        if (f.squares == DBL_MAX)
            return false;
    }
    if (std::abs(f.middle) + std::abs(f.slope) * (piece.last - piece.first) / 2 > WINDOW_REACH)
        return false;
    piece.middle += f.middle;
    piece.slope += f.slope;
    piece.curvature += f.curvature;
    return true;
}

void EdgeFit::move(double end, EdgePiece& piece)
{
    const int steps = 3;
    EdgePiece moved = piece;
    for (int step = 1; step < steps; step++)
        if (!approach(end, FEW_ROWS, moved))
            return;
    if (approach(end, INT_MAX, moved))
        piece = moved;
}

void EdgeFit::move(double end, Vec4f& segment)
{
    const Vec4f& s = segment;
    EdgePiece p = {
        std::min(s[1], s[3]), std::max(s[1], s[3]), (s[0] + s[2]) / 2, (s[2] - s[0]) / (s[3] - s[1]), 0, true};
    if (!readWindows(end, FEW_ROWS, p))
        return;
    p.rises = sumWindows(windows, 1).m0 > sumWindows(windows, -1).m0;
    move(end, p);
    segment[0] = float(p.column(s[1]));
    segment[2] = float(p.column(s[3]));
}

void moveToEdges(const Mat& gray, double end, std::vector<Vec4f>& segments)
{
    const double segmentsPerStripe = 32;
    const auto transposed = [](const Vec4f& s) { return Vec4f(s[1], s[0], s[3], s[2]); };
    parallel_for_(
        Range(0, int(segments.size())),
        [&](const Range& range) {
            EdgeFit upright(EdgeImage(gray, false)), flat(EdgeImage(gray, true));
            for (int i = range.start; i < range.end; i++)
            {
                Vec4f& s = segments[i];
                const bool isFlat = std::abs(s[2] - s[0]) > std::abs(s[3] - s[1]);
                if (!isFlat)
                {
                    upright.move(end, s);
                    continue;
                }
                s = transposed(s);
                flat.move(end, s);
                s = transposed(s);
            }
        },
        segments.size() / segmentsPerStripe);
}

}} // namespace cv::rsackermann
