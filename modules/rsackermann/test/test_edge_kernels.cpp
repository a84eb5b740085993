// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"

// Internals of the library that it doesn't export: the kernels with the vectors that the tests are compiled for, in a
// namespace of their own.
#undef CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN
#undef CV_CPU_OPTIMIZATION_NAMESPACE_END
#define CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN namespace tested {
#define CV_CPU_OPTIMIZATION_NAMESPACE_END }
#include "../src/features/edge_kernels.simd.hpp"

// And what they are if there are no vectors.
#undef CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN
#define CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN namespace tested_without_vectors {
#undef CV_SIMD_64F
#define CV_SIMD_64F 0
#undef CV_SIMD
#define CV_SIMD 0
#include "../src/features/edge_kernels.simd.hpp"

namespace opencv_test { namespace {

namespace vectors = cv::rsackermann::tested;
namespace scalars = cv::rsackermann::tested_without_vectors;
using cv::rsackermann::EdgePoint;
using cv::rsackermann::EdgeWindows;

typedef int (*FindExtremes)(const uchar* const (&)[3], int, double, short*, EdgePoint*);

std::vector<EdgePoint> extremes(FindExtremes find, const Mat& rows, double least)
{
    const uchar* const pointers[] = {rows.ptr(0), rows.ptr(1), rows.ptr(2)};
    std::vector<short> buffer(2 * rows.cols);
    std::vector<EdgePoint> points(rows.cols);
    points.resize(find(pointers, rows.cols, least, buffer.data(), points.data()));
    return points;
}

// The gradient of a row, eight times as large, at the place after a column.
int gradientAfter(const Mat& rows, int x)
{
    int sum = 0;
    for (int y = 0; y < 3; y++)
        for (int k = 0; k < 2; k++)
            sum += (y == 1 ? 2 : 1) * (rows.at<uchar>(y, x + 1 + k) - rows.at<uchar>(y, x - k));
    return sum;
}

TEST(RSAckermann_EdgeKernels, extremes_of_rows_of_any_width)
{
    RNG rng(1);
    for (int width = 1; width < 150; width++)
    {
        Mat rows(3, width, CV_8U);
        rng.fill(rows, RNG::UNIFORM, 0, 256);
        const double least = rng.uniform(0., 60.);
        std::vector<Vec2d> expected; // column and step
        for (int x = 2; x + 3 < width; x++)
        {
            const int sign = gradientAfter(rows, x) > 0 ? 1 : -1, g = sign * gradientAfter(rows, x),
                      left = sign * gradientAfter(rows, x - 1), right = sign * gradientAfter(rows, x + 1);
            if (g >= 8 * least && g > left && g >= right)
                expected.push_back(Vec2d(x + 0.5 + 0.5 * (right - left) / (2 * g - left - right), sign * g / 8.));
        }
        const FindExtremes kernels[] = {vectors::findExtremes, scalars::findExtremes, cv::rsackermann::findExtremes};
        for (FindExtremes find : kernels)
        {
            const std::vector<EdgePoint> found = extremes(find, rows, least);
            ASSERT_EQ(expected.size(), found.size()) << width;
            for (size_t i = 0; i < found.size(); i++)
            {
                EXPECT_NEAR(expected[i][0], found[i].column, 1e-4) << width;
                EXPECT_EQ(expected[i][1], found[i].step) << width;
            }
        }
    }
}

//! Windows about an edge of a slope, blur and noise; some rows have none.
EdgeWindows randomWindows(RNG& rng, int rows, double slope)
{
    EdgeWindows windows;
    windows.resize(rows);
    for (int i = 0; i < rows; i++)
    {
        windows.first[i] = float(rng.uniform(-3., -2.));
        for (int k = 0; k < cv::rsackermann::WINDOW_PIXELS; k++)
        {
            const double u = windows.first[i] - 0.5 + k - slope * (i - rows / 2.);
            windows.pixels[i * cv::rsackermann::WINDOW_STRIDE + k] =
                saturate_cast<uchar>(100 + 50 * std::erf(u) + rng.gaussian(5));
        }
        if (rng.uniform(0, 10) == 0)
            windows.clear(i);
    }
    return windows;
}

void expectNear(const cv::rsackermann::ParabolaSums& a, const cv::rsackermann::ParabolaSums& b)
{
    const cv::rsackermann::ParabolaFit f = a.fit(true), g = b.fit(true);
    EXPECT_NEAR(a.n, b.n, 1e-4 * std::abs(a.n));
    EXPECT_NEAR(f.middle, g.middle, 1e-4);
    EXPECT_NEAR(f.slope, g.slope, 1e-5);
    EXPECT_NEAR(f.curvature, g.curvature, 1e-6);
    EXPECT_NEAR(f.squares, g.squares, 1e-4);
}

TEST(RSAckermann_EdgeKernels, sums_of_windows)
{
    RNG rng(2);
    for (int rows = 4; rows < 120; rows++)
    {
        const double slope = rng.uniform(-1., 1.) / rows;
        EdgeWindows one = randomWindows(rng, rows, slope), other = one, third = one;
        const cv::rsackermann::EdgeMoments a = vectors::sumWindows(one, 1), b = scalars::sumWindows(other, 1),
                                           c = cv::rsackermann::sumWindows(third, 1);
        EXPECT_NEAR(a.m0, b.m0, 1e-5 * a.m0);
        EXPECT_NEAR(a.m1, b.m1, 1e-5 * a.m0);
        EXPECT_NEAR(a.m2, b.m2, 1e-5 * a.m0);
        EXPECT_NEAR(a.m2, c.m2, 1e-5 * a.m0);
        const double usual = (a.m0 / rows) * (a.m0 / rows);
        const cv::rsackermann::ParabolaSums first = vectors::sumCentres(one, 1.2, usual, -rows / 2., 1, 0);
        const cv::rsackermann::ParabolaFit line = first.fit(false);
        EXPECT_NEAR(slope, line.slope, 2. / rows / std::sqrt(rows));
        expectNear(first, scalars::sumCentres(other, 1.2, usual, -rows / 2., 1, 0));
        expectNear(vectors::sumCentres(one, 1.2, usual, -rows / 2., 1, &line),
                   scalars::sumCentres(other, 1.2, usual, -rows / 2., 1, &line));
        expectNear(vectors::sumCentres(one, 1.2, usual, -rows / 2., 1, &line),
                   cv::rsackermann::sumCentres(third, 1.2, usual, -rows / 2., 1, &line));
    }
}

}} // namespace opencv_test::
