// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "contestants.hpp"
#include "displacement.hpp"
#include "forward_splat.hpp"
#include "information_bound.hpp"
#include "paper_method.hpp"
#include "setting.hpp"
#include "vertical_lines.hpp"

#include "opencv2/ts.hpp"

namespace opencv_test { namespace {

using namespace cv::rsackermann;
using namespace paper;

struct Street
{
    street::StreetCamera view;
    street::StreetScene scene;
    street::StreetRenderer renderer;
    RollingShutterCamera camera;
    AckermannMotion motion;

    Street(double speed, double yawRate)
        : view(paperCamera()), scene(paperScene(speed, yawRate, 3)), renderer(view, scene),
          camera(rsackermann_samples::libraryCamera(view)), motion(rsackermann_samples::libraryMotion(view, scene))
    {
    }

    cv::Mat lines(int count, double outliers = 0) const
    {
        cv::RNG rng(5);
        std::vector<int> walls;
        return verticalLines(renderer, view, count, 0, outliers, rng, walls);
    }
};

cv::Mat singlePrecision(const cv::Mat& lines)
{
    cv::Mat result;
    lines.convertTo(result, CV_32F);
    return result;
}

TEST(Paper, exact_lines_are_vertical_after_the_true_motion)
{
    const Street s(80, -50);
    const MinimalSolution motion = {s.motion.alpha, s.motion.wallSlope, s.motion.wallOffset, s.motion.wallRatio};
    const cv::Mat lines = s.lines(200);
    ASSERT_EQ(200, lines.rows);
    for (int i = 0; i < lines.rows; i++)
        EXPECT_NEAR(0,
                    columnDifference(verticalSegment(s.camera, lines.at<cv::Vec4d>(i)), motion, 0) *
                        s.camera.cameraMatrix(0, 0),
                    1e-5);
}

TEST(Paper, method_finds_a_turn)
{
    const Street s(0, 40);
    MethodParams params;
    params.model = MODEL_1LA;
    const MethodResult result = estimateAsPaper(s.camera, singlePrecision(s.lines(60, 0.3)), params);
    ASSERT_EQ(MOTION_OK, result.motion.status);
    // Any sample in the consensus may win: half a pixel over the shortest line.
    const double tolerance = 0.5 / 36 / s.camera.secondsPerUnitTime() / DEGREE;
    EXPECT_NEAR(40, MetricEstimate(result.motion, s.camera).yawRate, tolerance);
    EXPECT_GT(result.motion.inliers, 0.6 * result.motion.candidates);
}

TEST(Paper, method_finds_the_speed_of_a_car_that_drives_straight_ahead)
{
    const Street s(90, 0);
    MethodParams params;
    params.model = MODEL_3LA;
    const MethodResult result = estimateAsPaper(s.camera, singlePrecision(s.lines(60, 0.3)), params);
    ASSERT_EQ(MOTION_OK, result.motion.status);
    EXPECT_LT(DenseTruth(s.renderer, s.view.size).left(s.camera, result.motion),
              0.5 * DenseTruth(s.renderer, s.view.size).raw());
}

TEST(Paper, method_corrects_most_of_a_motion)
{
    const Street s(80, 40);
    const MethodResult result = estimateAsPaper(s.camera, singlePrecision(s.lines(60, 0.3)), MethodParams());
    ASSERT_EQ(MOTION_OK, result.motion.status);
    const DenseTruth truth(s.renderer, s.view.size);
    EXPECT_LT(truth.left(s.camera, result.motion), 0.5 * truth.raw());
}

TEST(Paper, method_without_segments)
{
    const Street s(80, 40);
    EXPECT_EQ(MOTION_TOO_FEW_SEGMENTS, estimateAsPaper(s.camera, cv::Mat(), MethodParams()).motion.status);
    EXPECT_EQ(MOTION_TOO_FEW_SEGMENTS,
              estimateAsPaper(s.camera, singlePrecision(s.lines(4)), MethodParams()).motion.status);
}

TEST(Paper, nothing_is_left_by_the_true_motion)
{
    const Street s(80, 40);
    const DenseTruth truth(s.renderer, s.view.size);
    EXPECT_GT(truth.raw(), 1);
    EXPECT_LT(truth.left(s.camera, s.motion), 1e-3);
    EXPECT_NEAR(truth.raw(), truth.left(s.camera, AckermannMotion()), 1e-4);
}

TEST(Paper, splatting_restores_the_global_shutter_image)
{
    const Street s(100, 60);
    const cv::Mat rolling = s.renderer.rollingShutter(), global = s.renderer.globalShutter();
    cv::Mat mask;
    const cv::Mat corrected = correctBySplatting(s.camera, s.motion, rolling, mask);
    EXPECT_GT(cv::countNonZero(mask), 0.9 * mask.total());
    cv::Mat filled = global.clone();
    corrected.copyTo(filled, mask);
    EXPECT_GT(cv::PSNR(filled, global), cv::PSNR(rolling, global) + 6);
}

TEST(Paper, splatting_without_motion_changes_nothing)
{
    const Street s(100, 60);
    const cv::Mat rolling = s.renderer.rollingShutter();
    cv::Mat mask;
    EXPECT_EQ(0, cv::norm(rolling, correctBySplatting(s.camera, AckermannMotion(), rolling, mask), cv::NORM_INF));
    EXPECT_EQ(int(mask.total()), cv::countNonZero(mask));
}

TEST(Paper, patches_measure_a_shift)
{
    const Street s(0, 0);
    const cv::Mat image = s.renderer.globalShutter();
    cv::Mat shifted;
    const cv::Matx23d shift(1, 0, 3, 0, 1, -4);
    cv::warpAffine(image, shifted, shift, image.size());
    EXPECT_NEAR(0, patchDisplacement(image, image, cv::Mat()), 0.1);
    EXPECT_NEAR(5, patchDisplacement(image, shifted, cv::Mat()), 0.1);
}

// With many lines and little noise an estimate by all of them is as exact as the bound says.
TEST(Paper, errors_of_an_estimate_are_near_the_bound)
{
    const Street s(80, 40);
    const double noise = 0.1;
    const int draws = 60;
    const cv::Mat lines = s.lines(300);
    const InformationBound bound = informationBound(s.camera, lines, s.motion, s.scene.left, noise);
    const Contestant contestant = libraryContestant("", MODEL_4LA, true);
    cv::RNG rng(7);
    double yawRate = 0, speed = 0;
    for (int i = 0; i < draws; i++)
    {
        cv::Mat errors(lines.size(), CV_64F);
        rng.fill(errors, cv::RNG::NORMAL, 0, noise);
        const Problem problem = {s.camera, singlePrecision(lines + errors), s.scene.left, MotionPrior(), 0};
        const MetricEstimate metric(contestant.estimate(problem).motion, s.camera);
        yawRate += (metric.yawRate - 40) * (metric.yawRate - 40) / draws;
        speed += (metric.speed - 80) * (metric.speed - 80) / draws;
    }
    EXPECT_NEAR(1, std::sqrt(yawRate) * DEGREE / bound.yawRate, 0.4);
    EXPECT_NEAR(1, std::sqrt(speed) * KMH / bound.speed, 0.4);
}

// Twice the noise is twice the bound, and four times the lines are half of it.
TEST(Paper, bound_follows_noise_and_number_of_lines)
{
    const Street s(80, 40);
    const cv::Mat lines = s.lines(50);
    cv::Mat four;
    cv::repeat(lines, 4, 1, four);
    const InformationBound one = informationBound(s.camera, lines, s.motion, 2.5, 0.3);
    const InformationBound noisy = informationBound(s.camera, lines, s.motion, 2.5, 0.6),
                           many = informationBound(s.camera, four, s.motion, 2.5, 0.3);
    EXPECT_NEAR(2, noisy.yawRate / one.yawRate, 1e-6);
    EXPECT_NEAR(2, noisy.speed / one.speed, 1e-6);
    EXPECT_NEAR(0.5, many.yawRate / one.yawRate, 1e-6);
    EXPECT_NEAR(0.5, many.speed / one.speed, 1e-6);
}

}} // namespace

int main(int argc, char** argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
