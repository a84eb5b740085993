// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"

// DETECTOR_VERTICALS against edges that are known to any precision; test_detect.cpp has what is true of all detectors.

namespace opencv_test { namespace {

//! An edge at column = middle + slope t + curvature t^2, with t from the middle row.
struct Edge
{
    double middle, slope, curvature, blur;
    double low, high; // grey levels left and right of it
};

double columnOf(const Edge& e, double t)
{
    return e.middle + t * (e.slope + t * e.curvature);
}

//! Image of an edge and, if it isn't empty, the derivatives of its intensities by the middle and by the slope.
Mat render(const Size& size, const Edge& e, Mat derivatives[2] = 0)
{
    Mat image(size, CV_64F);
    for (int i = 0; derivatives && i < 2; i++)
        derivatives[i].create(size, CV_64F);
    for (int y = 0; y < size.height; y++)
        for (int x = 0; x < size.width; x++)
        {
            const double t = y - (size.height - 1) / 2., slope = e.slope + 2 * e.curvature * t,
                         sigma = e.blur * std::sqrt(1 + slope * slope), u = (x - columnOf(e, t)) / sigma;
            image.at<double>(y, x) = e.low + (e.high - e.low) * 0.5 * std::erfc(-u / std::sqrt(2.));
            if (!derivatives)
                continue;
            const double byMiddle = -(e.high - e.low) / sigma * std::exp(-u * u / 2) / std::sqrt(2 * CV_PI);
            derivatives[0].at<double>(y, x) = byMiddle;
            derivatives[1].at<double>(y, x) = byMiddle * t;
        }
    return image;
}

Mat withNoise(const Mat& image, double sigma, RNG& rng)
{
    Mat noise(image.size(), CV_64F), result;
    rng.fill(noise, RNG::NORMAL, 0, sigma);
    Mat(image + noise).convertTo(result, CV_8U);
    return result;
}

Edge randomEdge(const Size& size, RNG& rng)
{
    const double contrast = rng.uniform(30., 120.), low = rng.uniform(40., 90.);
    const bool rises = rng.uniform(0, 2) != 0;
    const Edge e = {size.width / 2 + rng.uniform(-3., 3.), rng.uniform(-0.4, 0.4),      0, rng.uniform(0.6, 1.2),
                    rises ? low : low + contrast,          rises ? low + contrast : low};
    return e;
}

double slopeOf(const Vec4f& s)
{
    return (s[2] - s[0]) / (s[3] - s[1]);
}

//! The longest segment; zeros if there is none.
Vec4f longest(const std::vector<Vec4f>& segments)
{
    Vec4f best = Vec4f::all(0);
    for (const Vec4f& s : segments)
        if (std::hypot(s[2] - s[0], s[3] - s[1]) > std::hypot(best[2] - best[0], best[3] - best[1]))
            best = s;
    return best;
}

//! Errors of the slopes of edges with noise, in standard deviations of the Cramér-Rao bound.
struct SlopeErrors
{
    std::vector<double> errors;
    int missed;
};

SlopeErrors slopeErrors(int detector, int cases, uint64 seed, bool isTransposed = false)
{
    RNG rng(seed);
    SlopeErrors result = {std::vector<double>(), 0};
    for (int k = 0; k < cases; k++)
    {
        const Size size(90, 60 + rng.uniform(0, 80));
        const Edge e = randomEdge(size, rng);
        const double noise = rng.uniform(0.5, 0.12 * std::abs(e.high - e.low));
        Mat d[2];
        Mat image = withNoise(render(size, e, d), noise, rng);
        if (isTransposed)
            cv::transpose(image.clone(), image);
        std::vector<Vec4f> segments;
        detectSegments(image, segments, detector, 30);
        Vec4f s = longest(segments);
        if (isTransposed)
            s = Vec4f(s[1], s[0], s[3], s[2]);
        const double length = std::abs(s[3] - s[1]);
        if (length < 0.8 * size.height)
        {
            result.missed++;
            continue;
        }
        // Rounding is noise, too.
        const double variance = noise * noise + 1 / 12., a = d[0].dot(d[0]), b = d[0].dot(d[1]), c = d[1].dot(d[1]);
        result.errors.push_back((slopeOf(s) - e.slope) / std::sqrt(variance * a / (a * c - b * b)));
    }
    return result;
}

double rootMeanSquare(const std::vector<double>& v)
{
    return std::sqrt(Mat(v).dot(Mat(v)) / double(v.size()));
}

double median(std::vector<double> v)
{
    std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
    return v[v.size() / 2];
}

double medianSize(std::vector<double> v)
{
    for (double& x : v)
        x = std::abs(x);
    return median(v);
}

TEST(RSAckermann_Verticals, slope_is_nearly_as_exact_as_noise_allows)
{
    const double normal = 0.6745; // median size of a normal distribution
    const SlopeErrors lsd = slopeErrors(DETECTOR_LSD, 300, 1);
    for (int transposed = 0; transposed < 2; transposed++)
    {
        const SlopeErrors found = slopeErrors(DETECTOR_VERTICALS, 1000, 1, transposed != 0);
        EXPECT_LE(found.missed, 10);
        EXPECT_LE(medianSize(found.errors), 1.8 * normal);
        EXPECT_LE(medianSize(found.errors), 0.8 * medianSize(lsd.errors));
        EXPECT_LE(rootMeanSquare(found.errors), 2);
        EXPECT_LE(std::abs(median(found.errors)), 0.2);
    }
}

TEST(RSAckermann_Verticals, noise_is_no_edge)
{
    RNG rng(3);
    const double sigmas[] = {0.3, 1, 3, 8, 15, 30};
    for (double sigma : sigmas)
    {
        int found = 0;
        for (int i = 0; i < 5; i++)
        {
            std::vector<Vec4f> segments;
            detectSegments(withNoise(Mat(480, 640, CV_64F, Scalar(120)), sigma, rng), segments, DETECTOR_VERTICALS, 25);
            found += int(segments.size());
        }
        EXPECT_EQ(0, found) << sigma;
    }
}

//! In which images and how edges are seen.
enum EdgeForm { AS_IT_IS, TRANSPOSED, IN_A_LARGE_IMAGE, EDGE_FORMS };

// A lens bends an edge: it stays one segment, whose ends are on it, straight or bent.
TEST(RSAckermann_Verticals, bent_edges_stay_whole)
{
    for (int form = 0; form < EDGE_FORMS; form++)
        for (const bool isBent : {false, true})
        {
            RNG rng(4);
            const bool isLarge = form == IN_A_LARGE_IMAGE; // which is halved
            const Size size = isLarge ? Size(850, 1000) : Size(120, 160);
            for (int k = 0; k < (isLarge ? 5 : 50); k++)
            {
                SCOPED_TRACE(testing::Message() << form << isBent << k);
                Edge e = randomEdge(size, rng);
                e.slope /= 2;
                e.curvature = isBent ? rng.uniform(-0.015, 0.015) * 4 / size.height : 0;
                Mat image = withNoise(render(size, e), 2, rng);
                if (form == TRANSPOSED)
                    cv::transpose(image.clone(), image);
                std::vector<Vec4f> segments;
                detectSegments(image, segments, DETECTOR_VERTICALS, 30);
                Vec4f s = longest(segments);
                if (form == TRANSPOSED)
                    s = Vec4f(s[1], s[0], s[3], s[2]);
                ASSERT_GE(std::abs(s[3] - s[1]), (isLarge ? 0.7 : 0.9) * size.height);
                for (int end = 0; end < 4; end += 2)
                    EXPECT_NEAR(columnOf(e, s[end + 1] - (size.height - 1) / 2.), s[end], 0.4);
            }
        }
}

// Both sides of a bar are where they are, though each draws the other one a little.
TEST(RSAckermann_Verticals, sides_of_narrow_bars)
{
    for (int width = 3; width <= 8; width++)
        for (int dark = 0; dark < 2; dark++)
        {
            Mat image(100, 80, CV_8U, Scalar(dark ? 150 : 60));
            image.colRange(40, 40 + width).setTo(dark ? 60 : 150);
            std::vector<Vec4f> segments;
            detectSegments(image, segments, DETECTOR_VERTICALS, 50);
            ASSERT_EQ(2u, segments.size()) << width;
            for (const Vec4f& s : segments)
                for (int end = 0; end < 4; end += 2)
                    EXPECT_LE(std::min(std::abs(s[end] - 39.5), std::abs(s[end] - 39.5 - width)), 0.5) << width;
            EXPECT_GT(std::abs(segments[0][0] - segments[1][0]), width - 0.5) << width;
        }
}

// An edge that turns is two segments, which meet where it does.
TEST(RSAckermann_Verticals, kinks_with_noise)
{
    RNG rng(9);
    for (const double noise : {0., 2., 5.})
        for (const double turn : {-0.5, -0.25, 0.25, 0.5})
            for (const bool isTransposed : {false, true})
                for (int k = 0; k < 5; k++)
                {
                    SCOPED_TRACE(cv::format("noise %g, turn %g, transposed %d", noise, turn, int(isTransposed)));
                    const Size size(120, 160);
                    const double middle = rng.uniform(50., 70.), slope = rng.uniform(-0.2, 0.2) - turn / 2,
                                 corner = rng.uniform(60., 100.);
                    Mat image(size, CV_64F);
                    for (int y = 0; y < size.height; y++)
                        for (int x = 0; x < size.width; x++)
                        {
                            const double t = y - corner, column = middle + t * (slope + (t > 0 ? turn : 0));
                            image.at<double>(y, x) = 60 + 50 * std::erfc(-(x - column));
                        }
                    Mat noisy = withNoise(image, noise, rng);
                    if (isTransposed)
                        cv::transpose(noisy.clone(), noisy);
                    std::vector<Vec4f> segments;
                    detectSegments(noisy, segments, DETECTOR_VERTICALS, 25);
                    ASSERT_EQ(2u, segments.size());
                    for (Vec4f s : segments)
                    {
                        if (isTransposed)
                            s = Vec4f(s[1], s[0], s[3], s[2]);
                        const double low = std::min(s[1], s[3]), high = std::max(s[1], s[3]);
                        const bool isAbove = low + high < 2 * corner;
                        EXPECT_NEAR(corner, isAbove ? high : low, 6);
                        EXPECT_NEAR(isAbove ? 0 : size.height, isAbove ? low : high, 4);
                        const double found = (s[2] - s[0]) / (s[3] - s[1]);
                        EXPECT_NEAR(slope + (isAbove ? 0 : turn), found, 0.02);
                    }
                }
}

//! A bar between two edges that are turned from the vertical, or one edge if it has no width.
Mat diagonalBar(const Size& size, double angle, double middle, double width, double noise, RNG& rng)
{
    Mat image(size, CV_64F);
    for (int y = 0; y < size.height; y++)
        for (int x = 0; x < size.width; x++)
        {
            const double across = (x - (size.width - 1) / 2. - middle) * std::cos(angle) -
                                  (y - (size.height - 1) / 2.) * std::sin(angle),
                         step = std::erfc(-across / (0.8 * std::sqrt(2.))),
                         back = width > 0 ? std::erfc(-(across - width) / (0.8 * std::sqrt(2.))) : 0;
            image.at<double>(y, x) = 60 + 40 * (step - back);
        }
    return withNoise(image, noise, rng);
}

// Rows and columns of an image see an edge near the diagonal: it is one segment nevertheless, over all of its length.
TEST(RSAckermann_Verticals, diagonal_edges_are_found_once)
{
    RNG rng(8);
    std::vector<double> angles;
    for (double angle = 20; angle <= 70; angle += angle >= 40 && angle < 50 ? 0.5 : 2.5)
        angles.push_back(angle * CV_PI / 180);
    for (const double noise : {0., 1., 2., 5.})
        for (const double angle : angles)
            for (const double sign : {-1., 1.})
                for (const double width : {0., 5.})
                {
                    SCOPED_TRACE(
                        cv::format("%g degrees, noise %g, width %g", sign * angle * 180 / CV_PI, noise, width));
                    const Size size(120, 160);
                    const double middle = rng.uniform(-3., 3.),
                                 length = std::min(size.width / std::sin(angle), size.height / std::cos(angle));
                    std::vector<Vec4f> segments;
                    detectSegments(diagonalBar(size, sign * angle, middle, width, noise, rng), segments,
                                   DETECTOR_VERTICALS, 30);
                    ASSERT_EQ(width > 0 ? 2u : 1u, segments.size());
                    for (const Vec4f& s : segments)
                    {
                        EXPECT_GT(std::hypot(s[2] - s[0], s[3] - s[1]), 0.85 * length);
                        for (int end = 0; end < 4; end += 2)
                        {
                            const double across = (s[end] - (size.width - 1) / 2. - middle) * std::cos(angle) -
                                                  sign * (s[end + 1] - (size.height - 1) / 2.) * std::sin(angle);
                            EXPECT_LT(std::min(std::abs(across), std::abs(across - width)), 0.5);
                        }
                    }
                }
}

//! Upright edges of a rendered street, and how many of them and of nothing a detector finds.
struct Found
{
    int edges, ofEdges, segments, ofNothing;
};

Found findWindows(int detector, double noise, uint64 seed)
{
    Found f = {0, 0, 0, 0};
    RNG rng(seed);
    for (int k = 0; k < 6; k++)
    {
        const int finer = 4;
        const Size size(640, 480);
        Mat fine(size * finer, CV_8U, Scalar(120)), small, blurred, image;
        std::vector<Vec4f> edges;
        for (int y = 10; y + 90 < size.height; y += 92)
            for (int x = 10; x + 60 < size.width; x += 62)
            {
                const int width = rng.uniform(8, 50), height = rng.uniform(27, 84), lean = rng.uniform(-16, 17),
                          rise = rng.uniform(-20, 21), level = 120 + (rng.uniform(0, 2) ? 1 : -1) * rng.uniform(20, 90);
                const Point a(finer * x + rng.uniform(0, finer) + 20, finer * y), b(a.x + finer * width, a.y + rise),
                    down(lean, finer * height);
                const Point corners[] = {a, b, b + down, a + down};
                fillConvexPoly(fine, corners, 4, Scalar(level));
                const Point tops[] = {a, b};
                for (const Point& top : tops)
                {
                    const Point2f p = Point2f(top) / finer, q = Point2f(top + down) / finer;
                    edges.push_back(Vec4f(p.x - 0.375f, p.y, q.x - 0.375f, q.y));
                }
            }
        resize(fine, small, size, 0, 0, INTER_AREA);
        GaussianBlur(small, blurred, Size(), 0.7);
        blurred.convertTo(image, CV_64F);
        std::vector<Vec4f> segments;
        detectSegments(withNoise(image, noise, rng), segments, detector, 20);
        std::vector<bool> isFound(edges.size());
        for (const Vec4f& s : segments)
        {
            if (std::abs(s[3] - s[1]) < 2 * std::abs(s[2] - s[0]))
                continue;
            f.segments++;
            bool isTrue = false;
            for (size_t i = 0; i < edges.size(); i++)
            {
                const Vec4f& e = edges[i];
                const double slope = (e[2] - e[0]) / (e[3] - e[1]), top = std::min(s[1], s[3]),
                             bottom = std::max(s[1], s[3]),
                             overlap = std::min<double>(bottom, e[3]) - std::max<double>(top, e[1]);
                if (overlap < 0.5 * (bottom - top) || std::abs(e[0] + slope * (s[1] - e[1]) - s[0]) > 1.5 ||
                    std::abs(e[0] + slope * (s[3] - e[1]) - s[2]) > 1.5)
                    continue;
                isTrue = true;
                if (overlap > 0.5 * (e[3] - e[1]))
                    isFound[i] = true;
            }
            f.ofNothing += !isTrue;
        }
        f.edges += int(edges.size());
        f.ofEdges += int(std::count(isFound.begin(), isFound.end(), true));
    }
    return f;
}

TEST(RSAckermann_Verticals, finds_more_edges_than_lsd_and_no_more_of_nothing)
{
    const double noises[] = {2, 6, 15};
    for (double noise : noises)
    {
        const Found f = findWindows(DETECTOR_VERTICALS, noise, 5), lsd = findWindows(DETECTOR_LSD, noise, 5);
        EXPECT_GE(f.ofEdges, lsd.ofEdges) << noise;
        EXPECT_LE(f.ofNothing, lsd.ofNothing) << noise;
        EXPECT_GE(f.ofEdges, (noise > 10 ? 0.6 : 0.95) * f.edges) << noise;
    }
}

}} // namespace opencv_test::
