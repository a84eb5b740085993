// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"
#include "lens.hpp"
#include "street_model.hpp"

#include "opencv2/calib3d.hpp"
#include "opencv2/imgproc.hpp"

namespace opencv_test { namespace {

struct Setting
{
    const char* name;
    double yawRate, speed;              // deg/s, km/h
    double heading, direction;          // degrees
    double roll, pitch;                 // degrees
    int scan;
    std::vector<double> lens;
    double left, right;                 // metres
};

void PrintTo(const Setting& s, std::ostream* stream)
{
    *stream << s.name;
}

// The renderer's own geometry against the library's maps: two implementations that share nothing.
class Street : public testing::TestWithParam<Setting>
{
protected:
    Street() : camera(cv::Size(320, 190), 408, 0.4 / 30 / 190, 1.2)
    {
        const Setting& s = GetParam();
        const double degree = CV_PI / 180;
        camera.heading = s.heading * degree;
        camera.roll = s.roll * degree;
        camera.pitch = s.pitch * degree;
        camera.scan = s.scan;
        camera.lens = s.lens;
        camera.reference = s.scan < 2 ? 70 : 200;
        scene.yawRate = s.yawRate * degree;
        scene.speed = s.speed / 3.6;
        scene.wallDirection = s.direction * degree;
        scene.left = s.left;
        scene.right = s.right;
    }

    street::StreetCamera camera;
    street::StreetScene scene;
};

TEST_P(Street, there_and_back)
{
    const street::StreetRenderer renderer(camera, scene);
    int seen = 0;
    for (int y = 0; y < camera.size.height; y += 7)
        for (int x = 0; x < camera.size.width; x += 7)
        {
            cv::Point2d rolling, back;
            if (!renderer.toRolling(cv::Point2d(x, y), rolling))
                continue;
            ASSERT_TRUE(renderer.toGlobal(rolling, back));
            EXPECT_LT(cv::norm(back - cv::Point2d(x, y)), 1e-5) << x << ", " << y;
            seen++;
        }
    EXPECT_GT(seen, 1000);
}

TEST_P(Street, maps_of_the_library)
{
    using namespace cv::rsackermann;
    const street::StreetRenderer renderer(camera, scene);
    const cv::Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(rsackermann_samples::libraryCamera(camera));
    const AckermannMotion motion = rsackermann_samples::libraryMotion(camera, scene);
    cv::Mat map1, map2, columns, rows, mask, inside;
    generator->initRectifyMap(motion, map1, map2, CV_32FC1, mask);
    renderer.rectifyMap(columns, rows, inside);
    EXPECT_LT(cv::norm(map1, columns, cv::NORM_INF, inside), 2e-3);
    EXPECT_LT(cv::norm(map2, rows, cv::NORM_INF, inside), 2e-3);
    // cv::remap rounds to 1/32 pixel: a place half of this outside counts as seen. Next to that limit accuracy decides.
    const double slack = 1. / 64, right = camera.size.width - 1 + slack, bottom = camera.size.height - 1 + slack;
    for (int y = 0; y < mask.rows; y++)
        for (int x = 0; x < mask.cols; x++)
        {
            const double u = columns.at<float>(y, x), v = rows.at<float>(y, x);
            const double depth = std::min(std::min(u + slack, right - u), std::min(v + slack, bottom - v)); // within the image
            ASSERT_TRUE(std::abs(depth) < 2e-3 || (depth > 0) == (mask.at<uchar>(y, x) != 0)) << x << ", " << y;
        }
    EXPECT_GT(cv::countNonZero(inside), camera.size.area() * 3 / 4);

    generator->initDistortMap(motion, map1, map2);
    for (int y = 0; y < camera.size.height; y++)
        for (int x = 0; x < camera.size.width; x++)
        {
            cv::Point2d global;
            ASSERT_TRUE(renderer.toGlobal(cv::Point2d(x, y), global));
            ASSERT_NEAR(global.x, map1.at<float>(y, x), 1e-3) << x << ", " << y;
            ASSERT_NEAR(global.y, map2.at<float>(y, x), 1e-3) << x << ", " << y;
        }
}

TEST_P(Street, true_map_turns_one_picture_into_the_other)
{
    scene.noise = 0;
    const street::StreetRenderer renderer(camera, scene);
    cv::Mat columns, rows, mask, rectified, difference;
    renderer.rectifyMap(columns, rows, mask);
    cv::Mat rolling = renderer.rollingShutter(4), global = renderer.globalShutter(4);
    cv::remap(rolling, rectified, columns, rows, cv::INTER_LINEAR);
    // What is finer than a pixel looks different in each picture.
    for (cv::Mat* image : {&rolling, &global, &rectified})
        cv::GaussianBlur(*image, *image, cv::Size(), 1);
    cv::erode(mask, mask, cv::Mat(), cv::Point(-1, -1), 4);
    cv::absdiff(rectified, global, difference);
    const double left = cv::mean(difference, mask)[0];
    cv::absdiff(rolling, global, difference);
    EXPECT_LT(left, 0.5 * cv::mean(difference, mask)[0]);
}

const std::vector<double> barrel = {-0.28, 0.09, 1e-3, -5e-4, -0.01}, rational = {0.2, 0.05, 1e-3, 1e-3, 0.01, 0.5, 0.1, 0.02};

const Setting settings[] = {{"straight", 0, 100, 0, 0, 0, 0, 0, {}, 2.5, 3},
                            {"turn", 60, 0, 0, 0, 0, 0, 0, {}, 2.5, 3},
                            {"both", -60, 120, 0, 0, 0, 0, 0, {}, 2.5, 3},
                            {"reverse", 30, -50, 0, 0, 0, 0, 0, {}, 2.5, 3},
                            {"askew", 40, 60, -5, 12, 0, 0, 0, {}, 2.5, 3},
                            {"tilted", 40, 60, 0, 0, 4, -6, 0, {}, 2.5, 3},
                            {"sideways", 20, 60, -90, -90, 1, 2, 0, {}, 2.5, 3},
                            {"to_the_right", 20, 60, -90, -85, 1, 2, 0, {}, 0, 3},
                            {"to_the_left", 20, 60, 90, 90, 1, 2, 0, {}, 2.5, 0},
                            {"left_wall_only", 20, 60, 0, 0, 0, 0, 0, {}, 2.5, 0},
                            {"upwards", 40, 60, 0, 0, 0, 0, 1, {}, 2.5, 3},
                            {"columns", 40, 60, 0, 0, 0, 0, 2, {}, 2.5, 3},
                            {"columns_back", 40, 60, 0, 0, 2, 3, 3, {}, 2.5, 3},
                            {"lens", 40, 60, 3, 3, 1, -2, 0, barrel, 2.5, 3},
                            {"rational_lens", 40, 60, 0, 0, 0, 0, 0, rational, 2.5, 3}};

INSTANTIATE_TEST_CASE_P(Samples, Street, testing::ValuesIn(settings));

TEST(StreetLens, same_as_projectPoints)
{
    for (const std::vector<double>& lens : {barrel, rational, std::vector<double>{0.1, -0.05, 2e-3, 1e-3}})
        for (double x = -0.6; x <= 0.6; x += 0.3)
            for (double y = -0.4; y <= 0.4; y += 0.2)
            {
                std::vector<cv::Point2d> projected;
                cv::projectPoints(std::vector<cv::Point3d>{cv::Point3d(x, y, 1)}, cv::Vec3d(), cv::Vec3d(), cv::Matx33d::eye(), lens, projected);
                EXPECT_LT(cv::norm(projected[0] - street::distortPoint(lens, cv::Point2d(x, y))), 1e-12);
                EXPECT_LT(cv::norm(street::undistortPoint(lens, projected[0]) - cv::Point2d(x, y)), 1e-9);
            }
}

}} // namespace
