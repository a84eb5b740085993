// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_simulator.hpp"

namespace opencv_test { namespace {

RollingShutterCamera makeCamera()
{
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(Size(640, 380), 816);
    camera.lineDelay = 0.4 / 30 / 380;
    camera.height = 1.2;
    return camera;
}

const double SPEED = 80 / 3.6;

AckermannMotion makeMotion(const RollingShutterCamera& camera, double speed = SPEED)
{
    return motionFromMetric(camera, 40 * CV_PI / 180, speed, 2.5, 3, camera.heading);
}

Vec3b colourAt(const Mat& image, const Vec4f& segment)
{
    return image.at<Vec3b>(cvRound((segment[1] + segment[3]) / 2), cvRound((segment[0] + segment[2]) / 2));
}

typedef testing::TestWithParam<int> DrawColours; // 1: forward, -1: in reverse

TEST_P(DrawColours, tell_labels_and_distance)
{
    RollingShutterCamera camera = makeCamera();
    camera.height = 0; // no road
    const std::vector<Vec4f> segments = {Vec4f(40, 60, 40, 160),   Vec4f(280, 60, 280, 160), Vec4f(600, 60, 600, 160),
                                         Vec4f(350, 60, 350, 160), Vec4f(200, 60, 200, 160), Vec4f(450, 60, 450, 160)};
    const std::vector<uchar> labels = {SEGMENT_LEFT_WALL,  SEGMENT_LEFT_WALL, SEGMENT_RIGHT_WALL,
                                       SEGMENT_RIGHT_WALL, SEGMENT_OUTLIER,   SEGMENT_REJECTED};
    Mat image(camera.imageSize, CV_8UC3, Scalar::all(255));
    drawMotion(image, segments, labels, camera, makeMotion(camera, GetParam() * SPEED), 3);

    const Vec3b nearLeft = colourAt(image, segments[0]), farLeft = colourAt(image, segments[1]);
    const Vec3b nearRight = colourAt(image, segments[2]), farRight = colourAt(image, segments[3]);
    EXPECT_EQ(Vec3b(255, 0, 0), nearLeft); // the nearest of all
    // From far to near red fades into blue; on the straight left wall w is proportional to the distance from the
    // centre.
    for (const Vec3b& c : {farLeft, nearRight, farRight})
    {
        EXPECT_EQ(0, c[1]);
        EXPECT_NEAR(255, c[0] + c[2], 1);
    }
    EXPECT_NEAR(255 * (319.5 - 280) / (319.5 - 40), farLeft[0], 12);
    EXPECT_NEAR(255 * ((600 - 319.5) / 3) / ((319.5 - 40) / 2.5), nearRight[0], 12); // the right wall is further away
    EXPECT_LT(farRight[0], 50);
    EXPECT_EQ(Vec3b(0, 0, 0), colourAt(image, segments[4]));
    const Vec3b rejected = colourAt(image, segments[5]);
    EXPECT_EQ(rejected[0], rejected[1]);
    EXPECT_EQ(rejected[0], rejected[2]);
    EXPECT_NE(Vec3b(0, 0, 0), rejected);
    // The background is untouched.
    EXPECT_EQ(Vec3b(255, 255, 255), image.at<Vec3b>(300, 320));
}

INSTANTIATE_TEST_CASE_P(RSAckermann, DrawColours, testing::Values(1, -1));

// Where the walls meet the road, by an exact simulation of points there.
std::vector<Point2d> borderPoints(const RollingShutterCamera& camera, double wallDirection, double speed)
{
    const simulation::Simulator simulator =
        simulation::Simulator::fromMetric(camera, 40 * CV_PI / 180, speed, 2.5, 3, wallDirection);
    std::vector<Point2d> points;
    for (double side : {-2.5, 3.})
        for (double x = -1.57; x < 1.57; x += 2e-4)
        {
            const double along = 3 * std::tan(x); // metres along the street
            const double c = std::cos(wallDirection), s = std::sin(wallDirection);
            Point2d pixel;
            if (simulator.project(Vec3d(side * c + along * s, camera.height, along * c - side * s), pixel))
                points.push_back(pixel);
        }
    return points;
}

typedef testing::TestWithParam<int> DrawBorders;

TEST_P(DrawBorders, are_where_walls_meet_the_road)
{
    RollingShutterCamera camera = makeCamera();
    const double speed = GetParam() == 4 ? -SPEED : SPEED;
    if (GetParam() == 1)
        camera.setRollPitch(0.07, -0.1);
    else if (GetParam() == 2)
        camera.distCoeffs = {-0.28, 0.09, 1e-3, -5e-4};
    else if (GetParam() == 3)
    {
        camera.heading = -1.5;
        camera.height = 0.5;
    }
    Mat image(camera.imageSize, CV_8UC3, Scalar::all(0));
    drawMotion(image, noArray(), noArray(), camera, makeMotion(camera, speed), 1);

    Mat drawn;
    inRange(image, Scalar(0, 100, 100), Scalar(0, 255, 255), drawn);
    const std::vector<Point2d> points = borderPoints(camera, camera.heading, speed);
    ASSERT_GT(points.size(), 30u);
    Mat expected = Mat::zeros(camera.imageSize, CV_8U), wide;
    for (size_t i = 0; i < points.size(); i++)
    {
        const Point p(cvRound(points[i].x), cvRound(points[i].y));
        expected.at<uchar>(p) = 255;
        // Each point of the border is drawn, except at its end at infinity.
        const Rect around = Rect(p - Point(1, 1), Size(3, 3)) & Rect(Point(), camera.imageSize);
        if (i > 0 && cv::norm(points[i] - points[i - 1]) > 0.01)
        {
            EXPECT_GT(countNonZero(drawn(around)), 0) << points[i];
        }
    }
    dilate(expected, wide, Mat::ones(7, 7, CV_8U));
    EXPECT_EQ(0, countNonZero(drawn & ~wide)); // nothing else is
}

INSTANTIATE_TEST_CASE_P(RSAckermann, DrawBorders, testing::Range(0, 5));

TEST(Draw, no_borders_without_road_or_motion)
{
    RollingShutterCamera camera = makeCamera();
    Mat image(camera.imageSize, CV_8UC3, Scalar::all(7));
    const Mat before = image.clone();
    drawMotion(image, noArray(), noArray(), camera, AckermannMotion());
    EXPECT_EQ(0, cvtest::norm(image, before, NORM_INF));
    camera.height = 0;
    drawMotion(image, noArray(), noArray(), camera, makeMotion(camera));
    EXPECT_EQ(0, cvtest::norm(image, before, NORM_INF));
}

TEST(Draw, segments_at_rest_are_far)
{
    const RollingShutterCamera camera = makeCamera();
    Mat image(camera.imageSize, CV_8UC3, Scalar::all(255));
    const Vec4f segment(40, 60, 40, 160);
    drawMotion(image, std::vector<Vec4f>(1, segment), std::vector<uchar>(1, SEGMENT_LEFT_WALL), camera,
               AckermannMotion());
    EXPECT_EQ(Vec3b(0, 0, 255), colourAt(image, segment));
}

TEST(Draw, coordinates_that_make_no_sense)
{
    const RollingShutterCamera camera = makeCamera();
    Mat image(camera.imageSize, CV_8UC3, Scalar::all(255));
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const std::vector<Vec4f> segments = {Vec4f(nan, 0, 1, 1), Vec4f(0, inf, 10, 10), Vec4f(1e30f, 5, -1e30f, 7),
                                         Vec4f(40, 60, 40, 160)};
    EXPECT_NO_THROW(drawMotion(image, segments, std::vector<uchar>(4, SEGMENT_LEFT_WALL), camera, makeMotion(camera)));
    EXPECT_GT(colourAt(image, segments[3])[0], 200);
}

TEST(Draw, bad_arguments)
{
    const RollingShutterCamera camera = makeCamera();
    const AckermannMotion motion = makeMotion(camera);
    const std::vector<Vec4f> segments(2, Vec4f(1, 2, 3, 4));
    const std::vector<uchar> labels(2, SEGMENT_OUTLIER);
    Mat image(camera.imageSize, CV_8UC3, Scalar::all(0)), grey(camera.imageSize, CV_8UC1, Scalar(0)),
        small(10, 10, CV_8UC3, Scalar::all(0)), empty;
    EXPECT_NO_THROW(drawMotion(image, segments, labels, camera, motion));
    EXPECT_THROW(drawMotion(grey, segments, labels, camera, motion), cv::Exception);
    EXPECT_THROW(drawMotion(small, segments, labels, camera, motion), cv::Exception);
    EXPECT_THROW(drawMotion(empty, segments, labels, camera, motion), cv::Exception);
    EXPECT_THROW(drawMotion(image, segments, std::vector<uchar>(1, SEGMENT_OUTLIER), camera, motion), cv::Exception);
    EXPECT_THROW(drawMotion(image, segments, std::vector<int>(2, 0), camera, motion), cv::Exception);
    EXPECT_THROW(drawMotion(image, std::vector<Vec3f>(2), labels, camera, motion), cv::Exception);
    EXPECT_THROW(drawMotion(image, segments, labels, camera, motion, 0), cv::Exception);
    EXPECT_THROW(drawMotion(image, segments, labels, RollingShutterCamera(), motion), cv::Exception);
}

}} // namespace
