// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_warp_cameras.hpp"

// What maps have in common with those of cv::initUndistortRectifyMap: types, rounding, sizes, outputs.

namespace opencv_test { namespace {

typedef testing::TestWithParam<std::tuple<int, bool>> WarpContract; // TestLens, whether to distort

class Maps
{
public:
    explicit Maps(const std::tuple<int, bool>& param, const Size& size = Size())
        : distort(std::get<1>(param)), camera(lensCamera(std::get<0>(param)))
    {
        if (size != Size())
        {
            // the principal point in the image, in which every pixel has a place
            camera.imageSize = size;
            camera.cameraMatrix(0, 2) = 33;
            camera.cameraMatrix(1, 2) = 4;
            camera.referenceRow = 4;
        }
        generator = WarpMapGenerator::create(camera);
        motion = motionFromMetric(camera, 0.6, 15, 2.5, 3, camera.heading);
    }

    void make(OutputArray map1, OutputArray map2, int m1type = CV_32FC1, OutputArray mask = noArray()) const
    {
        if (distort)
            generator->initDistortMap(motion, map1, map2, m1type, mask);
        else
            generator->initRectifyMap(motion, map1, map2, m1type, mask);
    }

    bool distort;
    RollingShutterCamera camera;
    Ptr<WarpMapGenerator> generator;
    AckermannMotion motion;
};

double maxDifference(const Mat& a, const Mat& b)
{
    return cvtest::norm(a, b, NORM_INF);
}

//! A coordinate in 1/32 pixel as remap takes it: its whole part, saturated, and its fraction.
void round32(float coordinate, short& whole, int& fraction)
{
    const int rounded = cvRound(coordinate * 32.);
    whole = saturate_cast<short>(cvFloor(rounded / 32.));
    fraction = rounded - 32 * cvFloor(rounded / 32.);
}

//! CV_16SC2 and CV_16UC1 of coordinates, one by one.
void roundMaps(const Mat& columns, const Mat& rows, Mat& whole, Mat& fraction)
{
    whole.create(columns.size(), CV_16SC2);
    fraction.create(columns.size(), CV_16UC1);
    for (int y = 0; y < columns.rows; y++)
        for (int x = 0; x < columns.cols; x++)
        {
            Vec2s& w = whole.at<Vec2s>(y, x);
            int fx, fy;
            round32(columns.at<float>(y, x), w[0], fx);
            round32(rows.at<float>(y, x), w[1], fy);
            fraction.at<ushort>(y, x) = ushort(32 * fy + fx);
        }
}

TEST_P(WarpContract, sizes)
{
    // The pixels of a small image are those of a large one with the same camera matrix. The motions are one of a car,
    // such as move the image out of the frame or beyond the range of a short, and such as leave pixels without a place.
    const double factors[] = {1, 300, 1e4};
    for (int k = 0; k < 3; k++)
    {
        Maps large(GetParam(), Size(67, 9));
        large.motion.alpha *= factors[k];
        large.motion.roadSlope *= factors[k];
        Mat columns, rows;
        large.make(columns, rows);
        for (int height = 1; height <= 9; height++)
            for (int width = 1; width <= 67; width++)
            {
                Maps maps(GetParam(), Size(width, height));
                maps.motion = large.motion;
                const Rect part(Point(), maps.camera.imageSize);
                Mat map1, map2, xy, none, whole, fraction, expectedWhole, expectedFraction;
                maps.make(map1, map2);
                ASSERT_EQ(part.size(), map1.size());
                EXPECT_EQ(0, maxDifference(map1, columns(part))) << part.size();
                EXPECT_EQ(0, maxDifference(map2, rows(part))) << part.size();

                maps.make(whole, fraction, CV_16SC2);
                roundMaps(map1, map2, expectedWhole, expectedFraction);
                EXPECT_EQ(0, maxDifference(whole, expectedWhole)) << part.size();
                EXPECT_EQ(0, maxDifference(fraction, expectedFraction)) << part.size();

                maps.make(xy, none, CV_32FC2);
                Mat split[2];
                cv::split(xy, split);
                EXPECT_EQ(0, maxDifference(map1, split[0])) << part.size();
                EXPECT_EQ(0, maxDifference(map2, split[1])) << part.size();
            }
    }
}

TEST_P(WarpContract, types)
{
    const Maps maps(GetParam());
    Mat columns, rows, xy, none(3, 3, CV_32F), whole, fraction;
    maps.make(columns, rows, CV_32FC1);
    EXPECT_EQ(CV_32FC1, columns.type());
    EXPECT_EQ(CV_32FC1, rows.type());

    maps.make(xy, none, CV_32FC2);
    EXPECT_EQ(CV_32FC2, xy.type());
    EXPECT_TRUE(none.empty());
    Mat split[2];
    cv::split(xy, split);
    EXPECT_EQ(0, maxDifference(columns, split[0]));
    EXPECT_EQ(0, maxDifference(rows, split[1]));

    Mat expectedWhole, expectedFraction, converted[2];
    roundMaps(columns, rows, expectedWhole, expectedFraction);
    cv::convertMaps(columns, rows, converted[0], converted[1], CV_16SC2);
    EXPECT_EQ(0, maxDifference(converted[0], expectedWhole));
    EXPECT_EQ(0, maxDifference(converted[1], expectedFraction));
    const int fixedPoint[] = {CV_16SC2, 0, -1, -1000};
    for (int i = 0; i < 4; i++)
    {
        maps.make(whole, fraction, fixedPoint[i]);
        EXPECT_EQ(CV_16SC2, whole.type());
        EXPECT_EQ(CV_16UC1, fraction.type());
        EXPECT_EQ(0, maxDifference(whole, expectedWhole));
        EXPECT_EQ(0, maxDifference(fraction, expectedFraction));
    }
}

TEST_P(WarpContract, bad_types)
{
    const Maps maps(GetParam());
    Mat map1, map2;
    const int bad[] = {CV_32FC3, CV_64FC1, CV_16SC1, CV_8UC2, CV_64FC2};
    for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); i++)
        EXPECT_THROW(maps.make(map1, map2, bad[i]), cv::Exception) << bad[i];
}

TEST_P(WarpContract, preallocated_outputs_are_reused)
{
    const Maps maps(GetParam());
    const int types[] = {CV_32FC1, CV_32FC2, CV_16SC2, -1};
    for (int i = 0; i < 4; i++)
    {
        Mat map1, map2, mask;
        maps.make(map1, map2, types[i], mask);
        const uchar* const data[] = {map1.data, map2.data, mask.data};
        const Mat copy1 = map1.clone(), copy2 = map2.clone(), copyMask = mask.clone();
        map1.setTo(7);
        map2.setTo(7);
        mask.setTo(7);
        maps.make(map1, map2, types[i], mask);
        EXPECT_EQ(data[0], map1.data);
        EXPECT_EQ(data[1], map2.data);
        EXPECT_EQ(data[2], mask.data);
        EXPECT_EQ(0, maxDifference(copy1, map1));
        EXPECT_EQ(types[i] == CV_32FC2, map2.empty());
        if (!map2.empty())
        {
            EXPECT_EQ(0, maxDifference(copy2, map2));
        }
        EXPECT_EQ(0, maxDifference(copyMask, mask));
    }
}

TEST_P(WarpContract, parts_of_larger_matrices)
{
    const Maps maps(GetParam());
    Mat map1, map2;
    maps.make(map1, map2);
    const Size size = map1.size();
    // rows of the same and of different length
    for (int extra = 0; extra < 2; extra++)
    {
        Mat large1(size.height + 4, size.width + 6, CV_32F, Scalar(1)),
            large2(size.height + 4, size.width + 6 + extra, CV_32F, Scalar(1));
        Mat part1 = large1(Rect(Point(2, 3), size)), part2 = large2(Rect(Point(2, 3), size));
        maps.make(part1, part2);
        EXPECT_EQ(0, maxDifference(map1, large1(Rect(Point(2, 3), size))));
        EXPECT_EQ(0, maxDifference(map2, large2(Rect(Point(2, 3), size))));
        EXPECT_EQ(large1.total() - size.area(), (size_t)cv::countNonZero(large1 == 1));
        EXPECT_EQ(large2.total() - size.area(), (size_t)cv::countNonZero(large2 == 1));
    }
}

TEST_P(WarpContract, same_for_any_number_of_threads)
{
    const Maps maps(GetParam());
    const int threads = cv::getNumThreads();
    Mat map1, map2, one1, one2;
    cv::setNumThreads(1);
    maps.make(one1, one2);
    for (int number = 2; number <= 8; number *= 4)
    {
        cv::setNumThreads(number);
        maps.make(map1, map2);
        EXPECT_EQ(0, maxDifference(map1, one1));
        EXPECT_EQ(0, maxDifference(map2, one2));
    }
    cv::setNumThreads(threads);
}

INSTANTIATE_TEST_CASE_P(RSAckermann, WarpContract, testing::Combine(testing::Values(ALL_LENSES), testing::Bool()));

TEST(RSAckermann_WarpContract, fixed_point_far_outside)
{
    // Coordinates beyond the range of a short, and none at all, both in the columns that vectors take and in the rest.
    const float none = -16384;
    WarpMapGenerator::Params params;
    params.newCameraMatrix = Matx33d(1e-2, 0, 33, 0, 1e-2, 2, 0, 0, 1);
    params.newSize = Size(67, 5);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(simulation::paperCamera(), params);
    Mat map1, map2, whole, fraction, mask;
    generator->initRectifyMap(AckermannMotion(), map1, map2);
    generator->initRectifyMap(AckermannMotion(), whole, fraction, CV_16SC2, mask);
    for (int y = 0; y < map1.rows; y++)
        for (int x = 0; x < map1.cols; x++)
        {
            const bool center = x == 33 && y == 2;
            EXPECT_EQ(center ? 320 : none, cvRound(map1.at<float>(y, x))) << x << ", " << y;
            EXPECT_EQ(center ? Vec2s(319, 189) : Vec2s::all((short)none), whole.at<Vec2s>(y, x)) << x << ", " << y;
            EXPECT_EQ(center ? 255 : 0, mask.at<uchar>(y, x)) << x << ", " << y;
        }
}

}} // namespace opencv_test::
