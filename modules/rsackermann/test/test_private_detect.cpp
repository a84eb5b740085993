// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"

#include "../src/features/refine_segments.hpp"

namespace opencv_test { namespace {

//! Mean lean of the sides of upright windows on a wall that is seen from the side: upper and lower edges rise.
double refinedLean(bool usesEnds)
{
    const Size size(640, 400);
    const int finer = 4, width = 30, height = 44;
    const double rise = 0.6;
    Mat fine(size * finer, CV_8U, Scalar(60)), image;
    std::vector<Vec4f> segments;
    for (int y = 40; y + height < size.height - 30; y += 71)
        for (int x = 20; x + width < size.width - 20; x += 61)
        {
            const int left = finer * x + (x + y) % finer, right = left + finer * width, top = finer * y,
                      bottom = top + finer * height, up = int(rise * (right - left));
            const Point corners[] = {Point(left, top), Point(right, top - up), Point(right, bottom - up),
                                     Point(left, bottom)};
            fillConvexPoly(fine, corners, 4, Scalar(150));
            const float u = float(left) / finer, v = float(right) / finer, raised = float(up) / finer;
            segments.push_back(Vec4f(u + 0.3f, float(y), u - 0.2f, float(y + height)));
            segments.push_back(Vec4f(v - 0.2f, float(y) - raised, v + 0.3f, float(y + height) - raised));
        }
    resize(fine, image, size, 0, 0, INTER_AREA);
    cv::rsackermann::refineSegments(image, 3, usesEnds, segments);
    double sum = 0;
    for (size_t i = 0; i < segments.size(); i++)
        sum += (segments[i][2] - segments[i][0]) / (segments[i][3] - segments[i][1]);
    return sum / double(segments.size());
}

TEST(RSAckermann_PrivateDetect, edges_at_the_ends_do_not_make_sides_lean)
{
    EXPECT_NEAR(0, refinedLean(false), 1e-5);
    EXPECT_GT(std::abs(refinedLean(true)), 1e-4);
}

}} // namespace opencv_test::
