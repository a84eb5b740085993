// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "opencv2/opencv_modules.hpp"
#include "../src/features/edges.hpp"
#include <functional>

// The segments of an image in each detector: what a mirror, a camera on its head or on its side, a negative and a
// larger image show is the same.

namespace opencv_test { namespace {

const Size SIZE(720, 480); // of some strips, whichever detector has cut it

//! A polygon of an image.
struct Patch
{
    std::vector<Point2d> corners;
    int level;
};

//! Between two sides that cross the rows from y - height / 2 on: x + slope t + bend t^2.
Patch patchOf(double x, double y, double width, double height, double slope, double bend, int level)
{
    const int steps = bend != 0 ? 60 : 1;
    Patch p;
    p.level = level;
    for (int side = 0; side < 2; side++)
        for (int i = 0; i <= steps; i++)
        {
            const double t = height * (side ? 0.5 - double(i) / steps : double(i) / steps - 0.5);
            p.corners.push_back(Point2d(x + (side ? width : -width) / 2 + t * (slope + t * bend), y + t));
        }
    return p;
}

//! Windows that lean, some of them where strips meet, bars that a lens has bent, and bars that are interrupted.
std::vector<Patch> scene(bool isOwn)
{
    RNG rng(4);
    std::vector<Patch> patches;
    for (int i = 0; i < 6; i++)
        patches.push_back(patchOf(58.3 + 120 * i, 90 + rng.uniform(-20., 20.), rng.uniform(40., 60.),
                                  rng.uniform(90., 130.), rng.uniform(-0.3, 0.3), 0, i % 2 ? 30 : 190));
    for (const double x : {52., 185., 244., 330., 392., 478., 530., 660.}) // about where strips meet
        patches.push_back(
            patchOf(x, 237, 16, 90, (x < 360 ? 1 : -1) * (!isOwn && x > 300 && x < 400 ? 0.85 : 0.3), 0, 200));
    for (int i = 0; i < 4 && isOwn; i++)
        patches.push_back(patchOf(100 + 170 * i, 390, 40, 140, 0.02 * i, (i % 2 ? 4e-4 : -3e-4), i < 2 ? 40 : 180));
    return patches;
}

Mat draw(const std::vector<Patch>& patches, int scale)
{
    const int finer = 4, shift = 6;
    Mat fine(SIZE * (scale * finer), CV_8U, Scalar(100)), image;
    for (const Patch& p : patches)
    {
        std::vector<std::vector<Point>> corners(1);
        for (const Point2d& c : p.corners)
            corners[0].push_back(Point(((c + Point2d(0.5, 0.5)) * (scale * finer) - Point2d(0.5, 0.5)) * (1 << shift)));
        fillPoly(fine, corners, Scalar(p.level), LINE_8, shift);
    }
    resize(fine, image, SIZE * scale, 0, 0, INTER_AREA);
    GaussianBlur(image, image, Size(), 0.7);
    return image;
}

//! What is done to an image, and where its places are then.
struct Change
{
    const char* name;
    std::function<void(Mat&)> ofImage;
    std::function<Point2d(const Point2d&, const Size&)> ofPlace; // the size is that of the image before
};

const Change CHANGES[] = {{"mirrored", [](Mat& image) { flip(image, image, 1); },
                           [](const Point2d& p, const Size& size) { return Point2d(size.width - 1 - p.x, p.y); }},
                          {"upside down", [](Mat& image) { flip(image, image, 0); },
                           [](const Point2d& p, const Size& size) { return Point2d(p.x, size.height - 1 - p.y); }},
                          {"transposed", [](Mat& image) { image = image.t(); },
                           [](const Point2d& p, const Size&) { return Point2d(p.y, p.x); }},
                          {"negative", [](Mat& image) { image = (image.depth() == CV_16U ? 65535 : 255) - image; },
                           [](const Point2d& p, const Size&) { return p; }}};

struct Ends
{
    Point2d a, b;

    double length() const { return cv::norm(b - a); }

    //! Whether both ends are next to those of another one.
    bool isNear(const Ends& other, double along, double beside) const
    {
        const Point2d ahead = (other.b - other.a) * (1 / other.length());
        const Point2d p = a - other.a, q = b - other.b;
        if (ahead.dot(b - a) < 0)
            return Ends{b, a}.isNear(other, along, beside);
        return std::max(std::abs(ahead.cross(p)), std::abs(ahead.cross(q))) < beside &&
               std::max(std::abs(ahead.dot(p)), std::abs(ahead.dot(q))) < along;
    }
};

std::vector<Ends> detect(const Mat& image, int detector, int scale)
{
    Mat segments;
    detectSegments(image, segments, detector, 40 * scale);
    std::vector<Ends> all;
    for (int i = 0; i < segments.rows; i++)
    {
        const float* s = segments.ptr<float>(i);
        all.push_back({Point2d(s[0], s[1]), Point2d(s[2], s[3])});
    }
    return all;
}

//! Those of OpenCV don't find quite the same themselves.
void expectSame(const std::vector<Ends>& expected, const std::vector<Ends>& found, int detector, double along,
                double beside)
{
    const bool isOwn = detector == DETECTOR_VERTICALS;
    const int most = isOwn ? 1 : 2;
    int missed = 0;
    for (const Ends& e : expected)
        missed += std::none_of(found.begin(), found.end(), [&](const Ends& f) {
            return e.isNear(f, isOwn ? along : std::max(along, 0.12 * e.length()), beside);
        });
    EXPECT_LE(missed, most);
    EXPECT_NEAR(expected.size(), found.size(), most);
}

typedef testing::TestWithParam<int> DetectSymmetry;

TEST_P(DetectSymmetry, of_segments)
{
    const int detector = GetParam();
    std::vector<Patch> patches = scene(detector == DETECTOR_VERTICALS);
    std::vector<Ends> ofSmall;
    for (const int form : {1, 2, 16})
    {
        SCOPED_TRACE(form);
        const int scale = form == 2 ? 2 : 1;
        if (form == 16) // what is darker and brighter than the rest is seen as well
        {
            patches.push_back(patchOf(118, 237, 16, 90, 0.3, 0, 14));
            patches.push_back(patchOf(595, 237, 16, 90, -0.3, 0, 216));
        }
        Mat image = draw(patches, scale);
        if (form == 16) // bits, of which not all of the range is used
            image.convertTo(image, CV_16U, 11, 9000);
        const std::vector<Ends> all = detect(image, detector, scale);
        EXPECT_GT(all.size(), 30u);
        for (const Change& change : CHANGES)
        {
            SCOPED_TRACE(change.name);
            Mat changed = image.clone();
            change.ofImage(changed);
            std::vector<Ends> expected;
            for (const Ends& e : all)
                expected.push_back({change.ofPlace(e.a, image.size()), change.ofPlace(e.b, image.size())});
            // 16 bits are rounded to 8, to other ones in a negative, which may cost an end a row.
            expectSame(expected, detect(changed, detector, scale), detector, (form == 16 ? 1.5 : 0.5) * scale,
                       (detector == DETECTOR_VERTICALS ? 0.07 : 0.25) * scale);
        }
        if (form == 1)
            ofSmall = all;
        else if (form == 2)
        {
            const Point2d half(0.5, 0.5);
            for (Ends& e : ofSmall)
                e = {(e.a + half) * scale - half, (e.b + half) * scale - half};
            expectSame(ofSmall, all, detector, 2.5, 0.5);
        }
    }
}

INSTANTIATE_TEST_CASE_P(RSAckermann, DetectSymmetry,
                        testing::Values(DETECTOR_LSD, DETECTOR_VERTICALS
#ifdef HAVE_OPENCV_XIMGPROC
                                        ,
                                        DETECTOR_FLD, DETECTOR_EDLINES
#endif
                                        ));

// A chain is one piece in spite of rows without an edge, and it is where its rows say, however uneven these are.
TEST(RSAckermann_DetectSymmetry, edges_with_gaps)
{
    for (int k = 0; k < 8; k++)
    {
        SCOPED_TRACE(k);
        const bool isSteep = (k & 1) != 0, isUpsideDown = (k & 2) != 0, isNegative = (k & 4) != 0;
        const double slope = isSteep ? 0.3 : -0.15;
        const Patch bar = patchOf(360.2, 239.5, 300, 470, slope, 0, 200);
        Mat image = draw({bar}, 1);
        for (int row = 10; row < 200; row += 10)
            image.rowRange(row, row + (row % 20 ? 3 : 4)).setTo(150);
        if (isUpsideDown)
            flip(image, image, 0);
        if (isNegative)
            image = 255 - image;
        const std::vector<cv::rsackermann::EdgePiece> pieces = cv::rsackermann::findEdges(image, 1, 40);
        ASSERT_EQ(2u, pieces.size());
        for (int i = 0; i < 2; i++)
        {
            const cv::rsackermann::EdgePiece& p = pieces[size_t(i)];
            EXPECT_GT(p.last - p.first, 460);
            EXPECT_EQ((p.middle < 360) != isNegative, p.rises);
            for (const double row : {p.first, p.last})
            {
                const double along = row - 239.5;
                EXPECT_NEAR(360.2 + (p.middle < 360 ? -150 : 150) + (isUpsideDown ? -1 : 1) * slope * along,
                            p.column(row), 0.3);
            }
        }
    }
}

}} // namespace opencv_test::
