// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "opencv2/opencv_modules.hpp"
#include "../src/features/edges.hpp"
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

// To an edge in the middle of the image a segment moves from the left as it does from the right, wherever it begins,
// whether the edge rises or falls and crosses rows or columns.
TEST(RSAckermann_PrivateDetect, segments_move_to_their_edge_from_either_side)
{
    Mat falling(200, 201, CV_8U, Scalar(60));
    falling.colRange(0, 100).setTo(160);
    falling.col(100).setTo(110);
    GaussianBlur(falling, falling, Size(), 1);
    const Mat rising = 220 - falling;
    for (const Mat& image : {falling, rising, Mat(falling.t()), Mat(rising.t())})
        for (const float slope : {0.f, 0.01f})
            for (float beside = 0.2f; beside < 2.4f; beside += 0.25f)
            {
                const int across = image.rows > image.cols ? 1 : 0;
                std::vector<Vec4f> segments;
                for (const float side : {-1.f, 1.f})
                {
                    Vec4f s(40, 40, 160, 160);
                    s[across] = 100 + side * (beside - 60 * slope);
                    s[across + 2] = 100 + side * (beside + 60 * slope);
                    segments.push_back(s);
                }
                cv::rsackermann::moveToEdges(image, 1.5, segments);
                for (int end = across; end < 4; end += 2)
                {
                    EXPECT_NEAR(100 - segments[0][end], segments[1][end] - 100, 0.01) << beside;
                    EXPECT_NEAR(100, segments[1][end], 0.2) << beside;
                }
            }
}

//! A blurred edge between two grey levels that crosses some rows: column + slope t + bend t^2, with t from a row.
struct CurvedEdge
{
    const char* name;
    double column, slope, bend;
    int begin, end; // rows, of 240
    bool rises;

    double at(double row) const
    {
        const double t = row - 120;
        return column + t * (slope + t * bend);
    }

    //! @param beside grey level of the rows that it doesn't cross.
    Mat draw(int beside, double blur = 1.2) const
    {
        Mat image(240, 320, CV_8U, Scalar(beside));
        for (int y = begin; y < end; y++)
            for (int x = 0; x < image.cols; x++)
                image.at<uchar>(y, x) = saturate_cast<uchar>(120 + (rises ? 60 : -60) * std::erf((x - at(y)) / blur));
        return image;
    }
};

const CurvedEdge EDGES[] = {{"upright", 160.3, 0, 0, 0, 240, true},
                            {"falls", 40.6, -0.08, 0, 0, 240, false},
                            {"begins late", 180.4, 0.2, 0, 130, 240, true},
                            {"ends early", 180.4, -0.2, 0, 0, 100, false},
                            {"bent", 150.2, 0.05, 3e-4, 0, 240, true},
                            {"bent, begins late", 150.2, -0.1, -4e-4, 70, 240, false},
                            {"bent, ends early", 150.2, 0.2, 4e-4, 20, 180, true}};

// All along its rows, and no farther.
TEST(RSAckermann_PrivateDetect, edges_are_found_where_they_are)
{
    for (const CurvedEdge& edge : EDGES)
    {
        SCOPED_TRACE(edge.name);
        const std::vector<cv::rsackermann::EdgePiece> pieces = cv::rsackermann::findEdges(edge.draw(120), 1, 40);
        ASSERT_EQ(1u, pieces.size());
        const cv::rsackermann::EdgePiece& p = pieces[0];
        EXPECT_NEAR(edge.begin, p.first, 1);
        EXPECT_NEAR(edge.end - 1, p.last, 1);
        EXPECT_EQ(edge.rises, p.rises);
        EXPECT_NEAR(edge.bend, p.curvature, 2e-5);
        for (double row = p.first; row <= p.last; row++)
            EXPECT_NEAR(edge.at(row), p.column(row), 0.12) << row;
    }
}

// A line that bends at one place is two, wherever that is.
TEST(RSAckermann_PrivateDetect, kinks_are_found_where_they_are)
{
    for (const int kink : {60, 90, 150, 175})
        for (const double slope : {-0.25, 0.2})
        {
            SCOPED_TRACE(testing::Message() << kink << " " << slope);
            Mat image(240, 320, CV_8U);
            const auto at = [&](double y) { return 160.3 + 0.1 * y + (y > kink ? slope * (y - kink) : 0); };
            for (int y = 0; y < image.rows; y++)
                for (int x = 0; x < image.cols; x++)
                    image.at<uchar>(y, x) = saturate_cast<uchar>(120 + 60 * std::erf((x - at(y)) / 1.2));
            const std::vector<cv::rsackermann::EdgePiece> pieces = cv::rsackermann::findEdges(image, 1, 40);
            ASSERT_EQ(2u, pieces.size());
            for (const cv::rsackermann::EdgePiece& p : pieces)
                for (double row = p.first; row <= p.last; row++)
                    EXPECT_NEAR(at(row), p.column(row), 0.8) << row;
            EXPECT_NEAR(kink,
                        (std::max(pieces[0].first, pieces[1].first) + std::min(pieces[0].last, pieces[1].last)) / 2, 6);
        }
}

// A segment is as long as it is, whatever its direction.
TEST(RSAckermann_PrivateDetect, least_length_in_any_direction)
{
    const double minLength = 60;
    for (const double part : {0.85, 1.15})
        for (int angle = 0; angle < 180; angle += 6)
        {
            SCOPED_TRACE(testing::Message() << part << " " << angle);
            const int finer = 4;
            Mat fine(Size(200, 200) * finer, CV_8U, Scalar(60)), image, segments;
            const Point2d along(std::cos(angle * CV_PI / 180), std::sin(angle * CV_PI / 180)),
                across(-along.y, along.x), a = along * (part * minLength / 2), b = across * 15, centre(100, 100);
            std::vector<Point> corners;
            for (const Point2d& c : {centre + a + b, centre + a - b, centre - a - b, centre - a + b})
                corners.push_back(Point(c * finer));
            fillConvexPoly(fine, corners, Scalar(180));
            resize(fine, image, Size(200, 200), 0, 0, INTER_AREA);
            GaussianBlur(image, image, Size(), 0.7);
            cv::rsackermann::SegmentFinder().find(image, DETECTOR_VERTICALS, minLength, segments);
            EXPECT_TRUE(part > 1 ? segments.rows >= 2 : segments.rows == 0) << segments.rows;
        }
}

// Where it goes on beyond the image as well, along rows or along columns, whatever is seen at its ends.
TEST(RSAckermann_PrivateDetect, pieces_move_to_their_edge)
{
    const double added[][2] = {{0, 0}, {-40, 0}, {0, 25}, {30, -10}}; // to the first and to the last row
    for (const CurvedEdge& edge : EDGES)
        for (const auto& rows : added)
            for (const double blur : {0.8, 1.2, 2.})
                for (const double ends : {0., 5.})
                    for (const bool isTransposed : {false, true})
                    {
                        SCOPED_TRACE(testing::Message() << edge.name << " " << blur << " " << rows[0] << " " << rows[1]
                                                        << " " << ends << " " << isTransposed);
                        Mat image = edge.draw(120, blur);
                        cv::rsackermann::EdgePiece p;
                        p.first = edge.begin + std::max(rows[0], edge.begin > 0 ? 0. : -40.);
                        p.last = edge.end - 1 + std::min(rows[1], edge.end < 240 ? 0. : 25.);
                        // Other edges that begin at the ends.
                        for (int y = cvCeil(p.first); y < p.first + ends; y++)
                            if (y >= 0)
                                image.row(y).colRange(cvRound(edge.at(y)), image.cols).setTo(edge.rises ? 60 : 180);
                        for (int y = cvFloor(p.last); y > p.last - ends; y--)
                            if (y < image.rows)
                                image.row(y).colRange(cvRound(edge.at(y)), image.cols).setTo(edge.rises ? 60 : 180);
                        const double middle = p.middleRow();
                        p.rises = edge.rises;
                        p.curvature = edge.bend;
                        p.slope = edge.slope + 2 * edge.bend * (middle - 120) + 0.004;
                        p.middle = edge.at(middle) + 0.7;
                        if (isTransposed)
                            image = image.t();
                        cv::rsackermann::EdgeFit(cv::rsackermann::EdgeImage(image, isTransposed)).move(ends, p);
                        for (double row = p.first; row <= p.last; row++)
                            EXPECT_NEAR(edge.at(row), p.column(row), 0.03) << row;
                    }
}

// A piece is moved where its edge is, or not at all: not to one that passes by, crosses it, or is in a few rows only.
TEST(RSAckermann_PrivateDetect, pieces_without_an_edge_stay)
{
    for (const double away : {0., 1.5, 2.5, 4., 6., 9.})
        for (const double turned : {0., 0.02, 0.05, 0.1, 0.2, 0.4})
            for (const int rows : {12, 40, 160})
                for (const double blur : {0.8, 2.})
                    for (const bool isTransposed : {false, true})
                    {
                        SCOPED_TRACE(testing::Message()
                                     << away << " " << turned << " " << rows << " " << blur << " " << isTransposed);
                        const CurvedEdge edge = {"", 160.3, 0.1, 0, 0, 240, true};
                        Mat image = edge.draw(120, blur);
                        cv::rsackermann::EdgePiece p, before;
                        p.first = 120 - rows / 2;
                        p.last = 120 + rows / 2;
                        p.rises = true;
                        p.curvature = 0;
                        p.slope = edge.slope + turned;
                        p.middle = edge.at(120) + away;
                        before = p;
                        if (isTransposed)
                            image = image.t();
                        cv::rsackermann::EdgeFit(cv::rsackermann::EdgeImage(image, isTransposed)).move(0, p);
                        double error = 0, moved = 0;
                        for (double row = p.first; row <= p.last; row++)
                        {
                            error = std::max(error, std::abs(edge.at(row) - p.column(row)));
                            moved = std::max(moved, std::abs(before.column(row) - p.column(row)));
                        }
                        EXPECT_LT(std::min(error, moved), 0.3);
                    }
}

// An image that was made smaller shows each place where its scale says, whatever its size.
TEST(RSAckermann_PrivateDetect, smaller_images_leave_out_what_is_odd)
{
    RNG rng(5);
    Mat large(1803, 2203, CV_8U);
    rng.fill(large, RNG::UNIFORM, 0, 256);
    for (const Size& size : {Size(1403, 1201), Size(1402, 1201), Size(1403, 1200), large.size()})
    {
        SCOPED_TRACE(size);
        cv::rsackermann::SegmentFinder finder, ofEven;
        finder.prepare(large(Rect(Point(), size)));
        const int scale = finder.reduction();
        EXPECT_EQ(size == large.size() ? 4 : 2, scale);
        ofEven.prepare(large(Rect(0, 0, size.width / scale * scale, size.height / scale * scale)));
        ASSERT_EQ(scale, ofEven.reduction());
        ASSERT_EQ(ofEven.reduced().size(), finder.reduced().size());
        EXPECT_EQ(0, cvtest::norm(ofEven.reduced(), finder.reduced(), NORM_INF));
    }
}

}} // namespace opencv_test::
