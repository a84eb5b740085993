// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "opencv2/opencv_modules.hpp"

namespace opencv_test { namespace {

//! A bright quadrilateral with slightly slanted sides on dark ground, drawn with subpixel accuracy.
Mat quadrilateral(int type)
{
    Mat image(240, 320, CV_8U, Scalar(60));
    const int shift = 4, one = 1 << shift;
    const Point corners[] = {Point(80 * one, 40 * one), Point(220 * one, 45 * one), Point(230 * one, 200 * one),
                             Point(90 * one, 195 * one)};
    fillConvexPoly(image, corners, 4, Scalar(180), LINE_AA, shift);
    Mat blurred, result;
    GaussianBlur(image, blurred, Size(5, 5), 0.8);
    blurred.convertTo(result, CV_MAT_DEPTH(type), CV_MAT_DEPTH(type) == CV_16U ? 20 : 1,
                      CV_MAT_DEPTH(type) == CV_16U ? 3000 : 0);
    if (CV_MAT_CN(type) > 1)
        cvtColor(result, result, CV_MAT_CN(type) == 3 ? COLOR_GRAY2BGR : COLOR_GRAY2BGRA);
    return result;
}

//! Whether a segment covers most of the line from a to b and lies within a pixel of it.
bool covers(const Mat& segments, const Point2d& a, const Point2d& b)
{
    const Point2d along = (b - a) * (1 / cv::norm(b - a));
    for (int i = 0; i < segments.rows; i++)
    {
        const float* s = segments.ptr<float>(i);
        const Point2d p = Point2d(s[0], s[1]) - a, q = Point2d(s[2], s[3]) - a;
        if (std::abs(along.cross(p)) < 1 && std::abs(along.cross(q)) < 1 &&
            std::abs(along.dot(p - q)) > 0.8 * cv::norm(b - a))
            return true;
    }
    return false;
}

typedef testing::TestWithParam<int> Detectors;

TEST_P(Detectors, finds_the_sides_in_images_of_every_type)
{
    const int types[] = {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3, CV_16UC4};
    for (size_t i = 0; i < sizeof(types) / sizeof(types[0]); i++)
    {
        const Mat image = quadrilateral(types[i]), before = image.clone();
        Mat segments;
        detectSegments(image, segments, GetParam());
        ASSERT_EQ(CV_32FC1, segments.type());
        ASSERT_EQ(4, segments.cols);
        EXPECT_TRUE(covers(segments, Point2d(80, 40), Point2d(90, 195))) << types[i];
        EXPECT_TRUE(covers(segments, Point2d(220, 45), Point2d(230, 200))) << types[i];
        EXPECT_LE(segments.rows, 16) << types[i];
        EXPECT_EQ(0, cvtest::norm(image, before, NORM_INF)) << types[i];
    }
}

TEST_P(Detectors, segments_of_the_caller_s_type)
{
    const Mat image = quadrilateral(CV_8UC1);
    Mat rows;
    std::vector<Vec4f> list;
    detectSegments(image, rows, GetParam());
    detectSegments(image, list, GetParam());
    ASSERT_GT(rows.rows, 0);
    ASSERT_EQ(size_t(rows.rows), list.size());
    EXPECT_EQ(0, cvtest::norm(rows, Mat(list).reshape(1), NORM_INF));
    detectSegments(Mat(image.size(), CV_8U, Scalar(0)), list, GetParam());
    EXPECT_EQ(0u, list.size());
}

TEST_P(Detectors, segments_are_as_long_as_asked_for)
{
    const Mat image = quadrilateral(CV_8UC1);
    for (const double minLength : {10., 40., 100., 150., 200.})
    {
        std::vector<Vec4f> segments;
        detectSegments(image, segments, GetParam(), minLength);
        EXPECT_EQ(minLength < 155, !segments.empty()) << minLength;
        for (const Vec4f& s : segments)
            EXPECT_GE(std::hypot(s[2] - s[0], s[3] - s[1]), minLength - 1e-3);
    }
}

//! Facades with noise as a 16-bit camera sees them: levels from low to high, noise with a hundredth of that as its
//! deviation.
Mat facades16(double low, double high, int seed = 5)
{
    Mat image(380, 640, CV_32F, Scalar(0)), blurred, result;
    RNG rng(seed);
    for (int i = 0; i < 60; i++)
    {
        const int height = rng.uniform(40, 160), width = rng.uniform(15, 60), y = rng.uniform(0, 300),
                  x = rng.uniform(0, 600);
        const Rect window(x, y, width, height);
        rectangle(image, window, Scalar(rng.uniform(0., 1.)), FILLED);
    }
    GaussianBlur(image, blurred, Size(), 0.8);
    Mat noise(image.size(), CV_32F);
    rng.fill(noise, RNG::NORMAL, 0, 0.01);
    Mat(blurred + noise).convertTo(result, CV_16U, high - low, low);
    return result;
}

//! How many segments lie on one of the others: both ends within a pixel of its line, and the middle beside it.
int countFound(const Mat& segments, const Mat& others)
{
    int found = 0;
    for (int i = 0; i < segments.rows; i++)
    {
        const Vec4f s = *segments.ptr<Vec4f>(i);
        bool isFound = false;
        for (int j = 0; j < others.rows && !isFound; j++)
        {
            const Vec4f other = *others.ptr<Vec4f>(j);
            const Point2d a(other[0], other[1]), b(other[2], other[3]), p(s[0], s[1]), q(s[2], s[3]),
                along = (b - a) / cv::norm(b - a);
            const double middle = along.dot((p + q) / 2 - a);
            isFound = std::abs(along.cross(p - a)) < 1 && std::abs(along.cross(q - a)) < 1 && middle > 0 &&
                      middle < cv::norm(b - a);
        }
        found += isFound;
    }
    return found;
}

double shareFound(const Mat& segments, const Mat& others)
{
    return segments.rows > 0 ? countFound(segments, others) / double(segments.rows) : 0;
}

TEST_P(Detectors, one_bright_or_dark_pixel_in_16_bit_images)
{
    for (int scale = 1; scale <= 3; scale += 2)
    {
        Mat image, expected;
        resize(facades16(3000, 6000), image, Size(), scale, scale, INTER_CUBIC);
        detectSegments(image, expected, GetParam(), 30 * scale);
        ASSERT_GE(expected.rows, 40);
        const int values[] = {65535, 0};
        for (int i = 0; i < 2; i++)
        {
            Mat onePixel = image.clone(), segments;
            onePixel.at<ushort>(0, 5) = ushort(values[i]);
            detectSegments(onePixel, segments, GetParam(), 30 * scale);
            EXPECT_GE(shareFound(expected, segments), 0.95) << values[i] << ", scale " << scale;
            EXPECT_GE(shareFound(segments, expected), 0.95) << values[i] << ", scale " << scale;
        }
    }
}

//! The segments that don't come near a circle.
Mat segmentsAway(const Mat& segments, const Point2d& centre, double radius)
{
    Mat away(0, 4, CV_32F);
    for (int i = 0; i < segments.rows; i++)
    {
        const Vec4f s = *segments.ptr<Vec4f>(i);
        const Point2d a(s[0], s[1]), b(s[2], s[3]);
        const double along = std::min(std::max((centre - a).dot(b - a) / (b - a).dot(b - a), 0.), 1.);
        if (cv::norm(a + along * (b - a) - centre) > radius)
            away.push_back(segments.row(i));
    }
    return away;
}

// A lamp of half a percent of the pixels moves the range of the rest by less than a hundredth. A change of the contrast
// by that much makes detectors cut many segments elsewhere, in smooth images most: no more than that may be lost to the
// lamp, but for what is chance.
TEST_P(Detectors, lamps_in_16_bit_images)
{
    const int low = 3000, high = 6000, values[] = {65535, 0};
    const double contrast = 255 / (1.2 * (high - low)); // with a margin
    for (int scale = 1; scale <= 3; scale += 2)
    {
        int all = 0, all8Bit = 0, withOtherContrast = 0, withLamp[2] = {0, 0};
        for (int seed = 5; seed < 10; seed++)
        {
            Mat image, gray, expected, segments;
            resize(facades16(low, high, seed), image, Size(), scale, scale, INTER_CUBIC);

            image.convertTo(gray, CV_8U, contrast, 25 - low * contrast);
            detectSegments(gray, expected, GetParam(), 30 * scale);
            image.convertTo(gray, CV_8U, contrast / 1.01, 25 - low * contrast / 1.01);
            detectSegments(gray, segments, GetParam(), 30 * scale);
            withOtherContrast += countFound(expected, segments);
            all8Bit += expected.rows;

            const Point centre(600 * scale, 350 * scale);
            const int radius = 20 * scale, margin = 5 * scale;
            detectSegments(image, segments, GetParam(), 30 * scale);
            expected = segmentsAway(segments, centre, radius + margin);
            all += expected.rows;
            for (int i = 0; i < 2; i++)
            {
                Mat lamp = image.clone();
                circle(lamp, centre, radius, Scalar(values[i]), FILLED);
                detectSegments(lamp, segments, GetParam(), 30 * scale);
                withLamp[i] += countFound(expected, segments);
            }
        }
        ASSERT_GE(all, 200);
        ASSERT_GE(all8Bit, 200);
        const double share = withOtherContrast / double(all8Bit),
                     sigma = std::sqrt(share * (1 - share) * (1. / all + 1. / all8Bit));
        for (int i = 0; i < 2; i++)
            EXPECT_GE(withLamp[i] / double(all), share - 3 * sigma) << values[i] << ", scale " << scale;
    }
}

// What is seen doesn't depend on where in the 16 bits it is.
TEST_P(Detectors, dark_and_low_contrast_in_16_bit_images)
{
    Mat expected;
    detectSegments(facades16(8000, 56000), expected, GetParam(), 30);
    ASSERT_GE(expected.rows, 40);
    const int levels[][2] = {{3000, 6000}, {100, 400}, {200, 264}, {60000, 60300}};
    for (int i = 0; i < 4; i++)
    {
        Mat segments;
        detectSegments(facades16(levels[i][0], levels[i][1]), segments, GetParam(), 30);
        EXPECT_GE(shareFound(expected, segments), 0.8) << levels[i][0];
        EXPECT_GE(shareFound(segments, expected), 0.8) << levels[i][0];
    }
}

// Fewer than a hundredth of the pixels differ from the rest, and are all that there is to see.
TEST_P(Detectors, few_bright_pixels_in_16_bit_images)
{
    Mat image(240, 320, CV_16U, Scalar(1000)), segments;
    image(Rect(160, 60, 2, 120)).setTo(3000);
    detectSegments(image, segments, GetParam(), 60);
    EXPECT_GE(segments.rows, 1);
    for (int i = 0; i < segments.rows; i++)
        for (int end = 0; end < 4; end += 2)
            EXPECT_NEAR(160.5, segments.at<float>(i, end), 2);
}

//! A slightly slanted edge, column = x + slope (row - 120), each pixel the mean of the area around its centre.
Mat edge(double x, double slope, bool brightRight)
{
    const int samples = 16;
    Mat image(240, 320, CV_8U), blurred;
    for (int v = 0; v < image.rows; v++)
        for (int u = 0; u < image.cols; u++)
        {
            double covered = 0;
            for (int k = 0; k < samples; k++)
                covered +=
                    std::min(std::max(u + 0.5 - x - slope * (v - 0.5 + (k + 0.5) / samples - 120), 0.), 1.) / samples;
            image.at<uchar>(v, u) = saturate_cast<uchar>(60 + 120 * (brightRight ? covered : 1 - covered));
        }
    GaussianBlur(image, blurred, Size(), 0.6);
    return blurred;
}

TEST_P(Detectors, pixel_centres_are_at_integers)
{
    double sum = 0;
    int n = 0;
    for (int i = 0; i < 16; i++)
    {
        const double x = 160 + i / 8., slope = 0.004 * (i - 7);
        Mat segments;
        detectSegments(edge(x, slope, i % 2 == 0), segments, GetParam(), 100);
        for (int j = 0; j < segments.rows; j++)
            for (int end = 0; end < 4; end += 2)
            {
                sum += segments.at<float>(j, end) - x - slope * (segments.at<float>(j, end + 1) - 120);
                n++;
            }
    }
    ASSERT_GE(n, 16);
    EXPECT_LE(std::abs(sum / n), 0.05);
}

//! Vertical bars on a large image, whose sides are slightly slanted edges: column = x + slope (row - middle).
Mat bars(const Size& size, const std::vector<double>& x, double slope)
{
    Mat image(size, CV_8U), blurred;
    for (int v = 0; v < size.height; v++)
        for (int u = 0; u < size.width; u++)
        {
            double level = 60;
            for (size_t i = 0; i < x.size(); i++)
            {
                const double covered = std::min(std::max(u + 0.5 - x[i] - slope * (v - size.height / 2), 0.), 1.);
                level += i % 2 ? -120 * covered : 120 * covered;
            }
            image.at<uchar>(v, u) = saturate_cast<uchar>(level);
        }
    GaussianBlur(image, blurred, Size(), 0.8);
    return blurred;
}

TEST_P(Detectors, large_images)
{
    // One bar is in the middle, where the strips meet in which large images are searched.
    const Size sizes[] = {Size(1280, 721), Size(1921, 1080), Size(3840, 1500)};
    for (size_t k = 0; k < sizeof(sizes) / sizeof(sizes[0]); k++)
    {
        const Size size = sizes[k];
        const double slope = 0.013, middle = size.width / 2;
        std::vector<double> x;
        x.push_back(200.3);
        x.push_back(300.6);
        x.push_back(middle - 18.2);
        x.push_back(middle + 21.7);
        x.push_back(size.width - 150.4);
        Mat segments;
        detectSegments(bars(size, x, slope), segments, GetParam());
        std::vector<double> lengths(x.size());
        for (int i = 0; i < segments.rows; i++)
        {
            const float* s = segments.ptr<float>(i);
            size_t nearest = 0;
            for (size_t j = 1; j < x.size(); j++)
                if (std::abs(s[0] - x[j]) < std::abs(s[0] - x[nearest]))
                    nearest = j;
            for (int end = 0; end < 4; end += 2)
                EXPECT_NEAR(x[nearest] + slope * (s[end + 1] - size.height / 2), s[end], 0.15)
                    << size << ", edge " << nearest;
            lengths[nearest] += std::abs(s[3] - s[1]);
        }
        for (size_t j = 0; j < x.size(); j++)
        {
            EXPECT_GE(lengths[j], 0.8 * size.height) << size << ", edge " << j;
            EXPECT_LE(lengths[j], 1.02 * size.height) << size << ", edge " << j << " was found twice";
        }
    }
}

// Large images are searched in halved form: the ends have to be exact in the image itself.
TEST_P(Detectors, ends_in_large_images_are_exact)
{
    const Size size(1280, 800);
    for (int i = 0; i < 6; i++)
    {
        const double slope = 0.011 * (i - 2.5);
        std::vector<double> x;
        for (int k = 0; k < 6; k++)
            x.push_back(150 + 190 * k + 0.17 * i + 0.13 * k);
        Mat segments;
        detectSegments(bars(size, x, slope), segments, GetParam(), 100);
        ASSERT_GE(segments.rows, int(x.size())) << slope;
        for (int k = 0; k < segments.rows; k++)
            for (int end = 0; end < 4; end += 2)
            {
                double error = 10;
                for (size_t j = 0; j < x.size(); j++)
                {
                    const double e =
                        segments.at<float>(k, end) - x[j] - slope * (segments.at<float>(k, end + 1) - size.height / 2);
                    error = std::abs(e) < std::abs(error) ? e : error;
                }
                EXPECT_NEAR(0, error, 0.04) << slope << ", segment " << k;
            }
    }
}

TEST_P(Detectors, long_and_narrow_images)
{
    // Halved twice they would be too narrow for the detectors.
    const Size sizes[] = {Size(60000, 17), Size(40, 60000)};
    for (int i = 0; i < 2; i++)
    {
        Mat image(sizes[i], CV_8U, Scalar(60)), segments;
        image(Rect(0, 0, sizes[i].width / 2, sizes[i].height / 2)).setTo(180);
        EXPECT_NO_THROW(detectSegments(image, segments, GetParam(), 5)) << sizes[i];
        EXPECT_EQ(4, segments.cols);
    }
}

// For the borders of the strips the width is multiplied by their number, which doesn't fit an int here.
TEST_P(Detectors, very_wide_image)
{
    // LSD searches strips of halved images only.
    const Size size = GetParam() == DETECTOR_LSD ? Size(2200000, 40) : Size(1100000, 31);
    const int edge = size.width - 100001;
    Mat image(size, CV_8U, Scalar(60)), segments;
    image.colRange(edge, size.width).setTo(180);
    ASSERT_NO_THROW(detectSegments(image, segments, GetParam(), 5));
    if (GetParam() != DETECTOR_LSD) // at the scale of LSD so low an image shows nothing
    {
        EXPECT_GE(segments.rows, 1);
    }
    for (int i = 0; i < segments.rows; i++)
        EXPECT_NEAR(edge - 0.5, segments.at<float>(i, 0), 2);
}

TEST_P(Detectors, same_for_any_number_of_threads)
{
    const Size size(1920, 1080);
    std::vector<double> x;
    for (int i = 0; i < 40; i++)
        x.push_back(30 + 47.3 * i);
    const Mat image = bars(size, x, -0.02);
    const int threads = cv::getNumThreads();
    Mat segments, one;
    detectSegments(image, segments, GetParam());
    cv::setNumThreads(1);
    detectSegments(image, one, GetParam());
    cv::setNumThreads(threads);
    ASSERT_EQ(one.size(), segments.size());
    EXPECT_EQ(0, cvtest::norm(one, segments, NORM_INF));
}

TEST_P(Detectors, part_of_a_larger_image)
{
    const Mat image = quadrilateral(CV_8UC1);
    Mat large(400, 500, CV_8U, Scalar(0));
    Mat part = large(Rect(Point(51, 33), image.size()));
    image.copyTo(part);
    Mat segments, expected;
    detectSegments(part, segments, GetParam());
    detectSegments(image, expected, GetParam());
    ASSERT_EQ(expected.size(), segments.size());
    EXPECT_EQ(0, cvtest::norm(expected, segments, NORM_INF));
}

TEST_P(Detectors, minimum_length)
{
    const Mat image = quadrilateral(CV_8UC1);
    Mat all, lengthy, none;
    detectSegments(image, all, GetParam(), 0);
    detectSegments(image, lengthy, GetParam(), 100);
    EXPECT_GE(all.rows, lengthy.rows);
    EXPECT_GE(lengthy.rows, 2);
    for (int i = 0; i < lengthy.rows; i++)
        EXPECT_GE(std::hypot(lengthy.at<float>(i, 2) - lengthy.at<float>(i, 0),
                             lengthy.at<float>(i, 3) - lengthy.at<float>(i, 1)),
                  100);
    for (const double tooLong : {1000., DBL_MAX})
    {
        detectSegments(image, none, GetParam(), tooLong);
        EXPECT_EQ(0, none.rows);
        EXPECT_EQ(4, none.cols);
        EXPECT_EQ(CV_32FC1, none.type());
    }
}

TEST_P(Detectors, tiny_images)
{
    RNG rng(1);
    for (int height = 1; height <= 40; height += height < 20 ? 1 : 7)
        for (int width = 1; width <= 40; width += width < 20 ? 1 : 7)
        {
            Mat noise(height, width, CV_8U), segments;
            rng.fill(noise, RNG::UNIFORM, 0, 256);
            EXPECT_NO_THROW(detectSegments(noise, segments, GetParam(), 5)) << noise.size();
            EXPECT_EQ(4, segments.cols);
            if (height == 1 || width == 1)
            {
                EXPECT_EQ(0, segments.rows);
            }
        }
}

TEST_P(Detectors, images_without_lines)
{
    const int types[] = {CV_8UC1, CV_8UC3, CV_16UC1};
    const double values[] = {0, 128, 65535};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
        {
            Mat segments;
            detectSegments(Mat(120, 160, types[i], Scalar::all(values[j])), segments, GetParam());
            EXPECT_EQ(0, segments.rows);
        }
}

// One chain of edge pixels that winds through the whole image.
TEST_P(Detectors, serpentine)
{
    Mat image(400, 400, CV_8U, Scalar(0));
    for (int y = 20, side = 0; y < 380; y += 12, side = 1 - side)
    {
        rectangle(image, Rect(20, y, 360, 6), Scalar(255), FILLED);
        rectangle(image, Rect(side ? 20 : 374, y, 6, 18), Scalar(255), FILLED);
    }
    Mat segments;
    detectSegments(image, segments, GetParam(), 100);
    EXPECT_GE(segments.rows, 30);
}

INSTANTIATE_TEST_CASE_P(RSAckermann, Detectors,
                        testing::Values(DETECTOR_LSD, DETECTOR_VERTICALS
#ifdef HAVE_OPENCV_XIMGPROC
                                        ,
                                        DETECTOR_FLD, DETECTOR_EDLINES
#endif
                                        ));

TEST(RSAckermann_Detect, bad_arguments)
{
    const Mat image(100, 100, CV_8U, Scalar(0));
    Mat segments;
    EXPECT_THROW(detectSegments(Mat(), segments), cv::Exception);
    EXPECT_THROW(detectSegments(Mat(100, 100, CV_32F, Scalar(0)), segments), cv::Exception);
    EXPECT_THROW(detectSegments(Mat(100, 100, CV_8UC2, Scalar(0)), segments), cv::Exception);
    EXPECT_THROW(detectSegments(Mat(100, 100, CV_8S, Scalar(0)), segments), cv::Exception);
    EXPECT_THROW(detectSegments(image, segments, 4), cv::Exception);
    EXPECT_THROW(detectSegments(image, segments, -1), cv::Exception);
    EXPECT_THROW(detectSegments(image, segments, DETECTOR_LSD, -1), cv::Exception);
    EXPECT_THROW(detectSegments(image, segments, DETECTOR_LSD, std::numeric_limits<double>::quiet_NaN()),
                 cv::Exception);
}

#ifndef HAVE_OPENCV_XIMGPROC
TEST(RSAckermann_Detect, detectors_of_ximgproc_are_missing)
{
    Mat segments;
    EXPECT_THROW(detectSegments(Mat(100, 100, CV_8U, Scalar(0)), segments, DETECTOR_FLD), cv::Exception);
    EXPECT_THROW(detectSegments(Mat(100, 100, CV_8U, Scalar(0)), segments, DETECTOR_EDLINES), cv::Exception);
}
#endif

}} // namespace opencv_test::
