// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "opencv2/opencv_modules.hpp"
#include "../src/features/refine_segments.hpp"
#include "../src/features/segment_finder.hpp"

namespace opencv_test { namespace {

//! Mean lean of the sides of upright windows on a wall that is seen from the side: upper and lower edges rise.
double foundLean(int detector, bool isForMany, int scale)
{
    const Size size(640 * scale, 400 * scale);
    const int finer = 4, width = 30 * scale, height = 44 * scale;
    const double rise = 0.6;
    Mat fine(size * finer, CV_8U, Scalar(60)), image, segments;
    for (int y = 40 * scale; y + height < size.height - 30 * scale; y += 71 * scale)
        for (int x = 20 * scale; x + width < size.width - 20 * scale; x += 61 * scale)
        {
            const int left = finer * x + (x + y) % finer, right = left + finer * width, top = finer * y,
                      bottom = top + finer * height, up = int(rise * (right - left));
            const Point corners[] = {Point(left, top), Point(right, top - up), Point(right, bottom - up),
                                     Point(left, bottom)};
            fillConvexPoly(fine, corners, 4, Scalar(150));
        }
    resize(fine, image, size, 0, 0, INTER_AREA);
    cv::rsackermann::SegmentFinder(isForMany).find(image, detector, 0.8 * height, segments);
    double sum = 0;
    int count = 0;
    for (int i = 0; i < segments.rows; i++)
    {
        const float* s = segments.ptr<float>(i);
        const double lean = (s[2] - s[0]) / (s[3] - s[1]);
        if (std::abs(lean) > 0.2)
            continue;
        sum += lean;
        count++;
    }
    EXPECT_GE(count, 50);
    return sum / count;
}

// For one image all of a side counts.
TEST(RSAckermann_PrivateDetect, edges_at_the_ends_do_not_make_sides_lean)
{
    std::vector<int> detectors = {DETECTOR_LSD, DETECTOR_VERTICALS};
#ifdef HAVE_OPENCV_XIMGPROC
    detectors.insert(detectors.end(), {DETECTOR_FLD, DETECTOR_EDLINES});
#endif
    for (const int detector : detectors)
    {
        SCOPED_TRACE(detector);
        for (const int scale : {1, 3})
            EXPECT_NEAR(0, foundLean(detector, true, scale), 1e-5);
        EXPECT_GT(std::abs(foundLean(detector, false, 1)), 1e-4);
    }
}

// To an edge in the middle of the image a segment moves from the left as it does from the right, wherever it begins.
TEST(RSAckermann_PrivateDetect, segments_move_to_their_edge_from_either_side)
{
    Mat image(200, 201, CV_8U, Scalar(60));
    image.colRange(0, 100).setTo(160);
    image.col(100).setTo(110);
    GaussianBlur(image, image, Size(), 1);
    for (const float slope : {0.f, 0.01f})
        for (float beside = 0.2f; beside < 2.4f; beside += 0.25f)
            for (const int steps : {1, 3})
            {
                std::vector<Vec4f> segments;
                for (const float side : {-1.f, 1.f})
                    segments.push_back(
                        Vec4f(100 + side * (beside - 60 * slope), 40, 100 + side * (beside + 60 * slope), 160));
                cv::rsackermann::refineSegments(image, steps, true, segments);
                for (int end = 0; end < 4; end += 2)
                {
                    EXPECT_NEAR(100 - segments[0][end], segments[1][end] - 100, 0.01) << beside;
                    EXPECT_NEAR(100, segments[1][end], steps > 1 ? 0.2 : 0.8) << beside;
                }
            }
}

}} // namespace opencv_test::
