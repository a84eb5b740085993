// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"
#include "lens.hpp"
#include "street_model.hpp"
#include "texture.hpp"

#include "test_lens_models.hpp"

namespace opencv_test { namespace {

struct Setting
{
    const char* name;
    double yawRate, speed;     // deg/s, km/h
    double heading, direction; // degrees
    double roll, pitch;        // degrees
    int scan;
    std::vector<double> lens;
    double left, right; // metres
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

    // Share of the difference between both pictures of a street that the map of a street leaves. No pixel counts more
    // than the cap.
    double differenceLeft(const street::StreetRenderer& shown, const street::StreetRenderer& mapped,
                          double cap = 255) const
    {
        cv::Mat columns, rows, mask, rectified, difference;
        mapped.rectifyMap(columns, rows, mask);
        cv::Mat rolling = shown.rollingShutter(4), global = shown.globalShutter(4);
        cv::remap(rolling, rectified, columns, rows, cv::INTER_LINEAR);
        // What is finer than a pixel looks different in each picture.
        for (cv::Mat* image : {&rolling, &global, &rectified})
            cv::GaussianBlur(*image, *image, cv::Size(), 1);
        cv::erode(mask, mask, cv::Mat(), cv::Point(-1, -1), 4);
        cv::absdiff(rectified, global, difference);
        cv::threshold(difference, difference, cap, 0, cv::THRESH_TRUNC);
        const double left = cv::mean(difference, mask)[0];
        cv::absdiff(rolling, global, difference);
        cv::threshold(difference, difference, cap, 0, cv::THRESH_TRUNC);
        return left / cv::mean(difference, mask)[0];
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
            // Within the image
            const double depth = std::min(std::min(u + slack, right - u), std::min(v + slack, bottom - v));
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
    EXPECT_LT(differenceLeft(renderer, renderer), 0.5);
}

// Streets whose houses aren't in line and where cars, posts and trees stand.
class UnevenStreet : public Street
{
protected:
    UnevenStreet() : even(camera, scene)
    {
        scene.stagger = 1.5;
        scene.obstacles = 15;
    }

    // Share of the pixels for which a condition holds.
    template <class Condition>
    double share(Condition condition) const
    {
        int count = 0, all = 0;
        for (int y = 0; y < camera.size.height; y += 3)
            for (int x = 0; x < camera.size.width; x += 3, all++)
                count += condition(cv::Point2d(x, y));
        return count / double(all);
    }

    const street::StreetRenderer even;
};

TEST_P(UnevenStreet, there_and_back)
{
    const street::StreetRenderer renderer(camera, scene);
    // What is hidden at the other instant can't come back: that is a stripe at the side of whatever stands in front.
    EXPECT_GT(share([&](const cv::Point2d& p) {
                  cv::Point2d rolling, back;
                  return renderer.toRolling(p, rolling) && renderer.toGlobal(rolling, back) &&
                         cv::norm(back - p) < 1e-5;
              }),
              0.97);
}

TEST_P(UnevenStreet, depth_is_another_one)
{
    const street::StreetRenderer renderer(camera, scene);
    const double changed = share([&](const cv::Point2d& p) {
        cv::Point2d here, there;
        return renderer.toRolling(p, here) && even.toRolling(p, there) && cv::norm(here - there) > 1e-3;
    });
    if (scene.speed == 0)
        EXPECT_EQ(changed, 0);
    else
        EXPECT_GT(changed, 0.25);
}

TEST_P(UnevenStreet, houses_stand_within_the_setbacks)
{
    scene.obstacles = 0;
    const street::StreetRenderer renderer(camera, scene);
    street::StreetScene far = scene;
    far.stagger = 0;
    far.left += scene.left > 0 ? scene.stagger : 0;
    far.right += scene.right > 0 ? scene.stagger : 0;
    const street::StreetRenderer farther(camera, far);
    // Only the walls above the neighbours' roofs are behind the farther plane.
    EXPECT_GT(share([&](const cv::Point2d& p) {
                  cv::Point2d near, between, behind;
                  return !even.toRolling(p, near) || !renderer.toRolling(p, between) || !farther.toRolling(p, behind) ||
                         cv::norm(between - near) < 1.01 * cv::norm(behind - near) + 1e-6;
              }),
              0.97);
}

TEST_P(UnevenStreet, true_map_turns_one_picture_into_the_other)
{
    camera.lineDelay *= 3; // for differences that are large enough
    scene.noise = 0;
    const street::StreetRenderer renderer(camera, scene);
    street::StreetScene ideal = scene;
    ideal.stagger = 0;
    ideal.obstacles = 0;
    // What one of the pictures hides differs in any case, and much.
    const double cap = 10, left = differenceLeft(renderer, renderer, cap);
    EXPECT_LT(left, 0.5);
    if (scene.speed != 0) // turning doesn't show the depth
    {
        EXPECT_LT(left, 0.98 * differenceLeft(renderer, street::StreetRenderer(camera, ideal), cap));
    }
}

TEST_P(UnevenStreet, same_picture_for_the_same_seed)
{
    const cv::Mat image = street::StreetRenderer(camera, scene).rollingShutter(1);
    EXPECT_EQ(cv::norm(image, street::StreetRenderer(camera, scene).rollingShutter(1), cv::NORM_INF), 0);
    scene.noise = 0;
    const cv::Mat quiet = street::StreetRenderer(camera, scene).rollingShutter(1);
    scene.seed++;
    EXPECT_GT(cv::norm(quiet, street::StreetRenderer(camera, scene).rollingShutter(1), cv::NORM_L1), quiet.total());
}

TEST_P(UnevenStreet, even_where_nothing_is_uneven)
{
    const cv::Mat image = even.rollingShutter(1);
    scene.stagger = 0;
    scene.obstacles = 0;
    EXPECT_EQ(cv::norm(image, street::StreetRenderer(camera, scene).rollingShutter(1), cv::NORM_INF), 0);
    scene.obstacles = 1e-6; // none on the length of the street, but another way of casting rays
    const cv::Mat different = image != street::StreetRenderer(camera, scene).rollingShutter(1);
    EXPECT_LT(cv::countNonZero(different.reshape(1)), 0.001 * image.total());
}

const std::vector<double> barrel = {-0.28, 0.09, 1e-3, -5e-4, -0.01},
                          rational = {0.2, 0.05, 1e-3, 1e-3, 0.01, 0.5, 0.1, 0.02};

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
INSTANTIATE_TEST_CASE_P(Samples, UnevenStreet, testing::ValuesIn(settings));

TEST(StreetLens, same_as_projectPoints)
{
    for (const std::vector<double>& lens : {barrel, rational, std::vector<double>{0.1, -0.05, 2e-3, 1e-3}})
        for (double x = -0.6; x <= 0.6; x += 0.3)
            for (double y = -0.4; y <= 0.4; y += 0.2)
            {
                std::vector<cv::Point2d> projected;
                cv::projectPoints(std::vector<cv::Point3d>{cv::Point3d(x, y, 1)}, cv::Vec3d(), cv::Vec3d(),
                                  cv::Matx33d::eye(), lens, projected);
                EXPECT_LT(cv::norm(projected[0] - street::distortPoint(lens, cv::Point2d(x, y))), 1e-12);
                EXPECT_LT(cv::norm(street::undistortPoint(lens, projected[0]) - cv::Point2d(x, y)), 1e-9);
            }
}

// Places of one surface: the stains are there whatever is seen of them, fade where pixels are larger, and aren't lines.
TEST(Stains, are_spots_of_all_sizes)
{
    double mean = 0, squares = 0, along = 0, up = 0, far = 0;
    const int count = 200;
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++)
        {
            const double u = 0.37 * i, v = 0.37 * j, at = street::stains(u, v, 0.001);
            mean += at / (count * count);
            squares += at * at / (count * count);
            along += std::pow(at - street::stains(u + 0.01, v, 0.001), 2) / (count * count);
            up += std::pow(at - street::stains(u, v + 0.01, 0.001), 2) / (count * count);
            far += std::pow(street::stains(u, v, 0.2), 2) / (count * count);
        }
    EXPECT_NEAR(0, mean, 0.01);
    EXPECT_NEAR(0.27, squares, 0.05);
    EXPECT_LT(far, 0.4 * squares);
    EXPECT_GT(far, 0.1 * squares);
    EXPECT_LT(along, 0.5 * squares);
    EXPECT_NEAR(along, up, 0.2 * along);
    EXPECT_EQ(0, street::stains(1.2, 3.4, 10));
}

}} // namespace
