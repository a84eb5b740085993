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

void EdgeFit::readWindows(int row, int spacing, int count, const EdgePiece& piece)
{
    windows.resize(count);
    // Copies, as bytes that are written might be any of them.
    const EdgeImage full = image;
    const EdgePiece expected = piece;
    uchar* pixels = windows.pixels.data();
    float* first = windows.first.data();
    for (int i = 0; i < count; i++, row += spacing, pixels += WINDOW_STRIDE)
    {
        const double column = expected.column(row);
        const int start = cvFloor(column - 0.5) - WINDOW_REACH + 1; // of pixels; gradients are between them
        if (!(start >= 0 && start + WINDOW_PIXELS <= full.columns))
        {
            windows.clear(i);
            continue;
        }
        first[i] = float(start + 0.5 - column);
        const uchar* p = full.data + row * full.rowStep + start * full.columnStep;
        if (full.columnStep == 1)
            std::memcpy(pixels, p, WINDOW_PIXELS);
        else
            for (int k = 0; k < WINDOW_PIXELS; k++)
                pixels[k] = p[k * full.columnStep];
    }
}

bool EdgeFit::approach(double end, int maxRows, EdgePiece& piece)
{
    const double longestEnd = 0.15, rows = piece.last - piece.first, cutOff = std::min(end, longestEnd * rows);
    const int first = std::max(cvCeil(piece.first + cutOff), 0),
              last = std::min(cvFloor(piece.last - cutOff), image.rows - 1),
              spacing = std::max((last - first + 1) / maxRows, 1), count = (last - first) / spacing + 1;
    if (last - first < 3)
        return false;
    readWindows(first, spacing, count, piece);
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
        f = sumCentres(windows, gain, usualStep * usualStep, first - piece.middleRow(), spacing, step ? &f : 0)
                .fit(piece.curvature != 0);
        if (f.squares == DBL_MAX)
            return false;
    }
    if (std::abs(f.middle) + std::abs(f.slope) * rows / 2 > WINDOW_REACH)
        return false;
    piece.middle += f.middle;
    piece.slope += f.slope;
    piece.curvature += f.curvature;
    return true;
}

void EdgeFit::move(double end, EdgePiece& piece)
{
    const int steps = 3, fewRows = 24; // few rows bring a piece near its edge
    EdgePiece moved = piece;
    for (int step = 1; step < steps; step++)
        if (!approach(end, fewRows, moved))
            return;
    if (approach(end, INT_MAX, moved))
        piece = moved;
}

}} // namespace cv::rsackermann
