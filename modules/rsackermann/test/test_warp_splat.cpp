// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_warp_cameras.hpp"

// The paper's way to correct an image, forward mapping with interpolation, against the inverse map and cv::remap.

namespace opencv_test { namespace {

using simulation::Simulator;

//! Brightness of a street with a smooth pattern on its planes at a pixel of the global-shutter camera.
float brightness(const Simulator& simulator, const Point2d& pixel)
{
    const Vec3d b =
        simulator.camera.uprightRotation * (simulator.camera.cameraMatrix.inv() * Vec3d(pixel.x, pixel.y, 1));
    const simulation::Surface plane = simulator.street.first(Vec3d(), b);
    if (plane == simulation::NOTHING)
        return float(150 + 50 * std::sin(120 * b[0] / b[2]) * std::sin(90 * b[1] / b[2]));
    const Vec3d P = b * simulator.street.distance(plane, Vec3d(), b);
    const double u = P[2] * 20, v = (plane == simulation::ROAD ? P[0] : P[1]) * 25;
    // windows far away would be smaller than a pixel
    const double fade = std::exp(-P.dot(P) / 25);
    return float(60 + 40 * plane + 60 * fade * std::sin(u) * std::sin(v));
}

//! Each raw pixel spreads its value over the four pixels around its place.
void splat(const Mat& raw, const Mat& places, Mat& image, Mat& weights)
{
    image = Mat(raw.size(), CV_32F, Scalar(0));
    weights = image.clone();
    for (int i = 0; i < places.rows; i++)
    {
        const double x = places.at<double>(i, 0), y = places.at<double>(i, 1);
        const int x0 = cvFloor(x), y0 = cvFloor(y);
        for (int dy = 0; dy < 2; dy++)
            for (int dx = 0; dx < 2; dx++)
            {
                if (x0 + dx < 0 || x0 + dx >= raw.cols || y0 + dy < 0 || y0 + dy >= raw.rows)
                    continue;
                const double weight = (1 - std::abs(x - x0 - dx)) * (1 - std::abs(y - y0 - dy));
                image.at<float>(y0 + dy, x0 + dx) += float(weight * raw.at<float>(i / raw.cols, i % raw.cols));
                weights.at<float>(y0 + dy, x0 + dx) += float(weight);
            }
    }
    image /= weights + 1e-6;
}

double psnr(const Mat& a, const Mat& b, const Mat& mask)
{
    const double rms = cvtest::norm(a, b, NORM_L2, mask) / std::sqrt((double)cv::countNonZero(mask));
    return 20 * std::log10(255 / rms);
}

typedef testing::TestWithParam<int> WarpSplat; // TestLens

TEST_P(WarpSplat, forward_mapping_agrees)
{
    RNG rng(41);
    for (int round = 0; round < 4; round++)
    {
        RollingShutterCamera camera = lensCamera(GetParam());
        const Point2d rollPitch = uniformPoint(rng, Point2d(-0.05, -0.05), Point2d(0.05, 0.05));
        camera.setRollPitch(rollPitch.x, rollPitch.y);
        camera.heading = round == 3 ? 1.5 : 0;
        const AckermannMotion motion = motionFromMetric(camera, round % 2 ? -1 : 0.9, round < 2 ? 25 : 15, 2.5, 3, 0);
        const Simulator simulator = Simulator::fromMetric(camera, 0, 1, 2.5, 3, 0);
        const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);

        Mat pixels(camera.imageSize.area(), 2, CV_64F), places;
        for (int i = 0; i < pixels.rows; i++)
        {
            pixels.at<double>(i, 0) = i % camera.imageSize.width;
            pixels.at<double>(i, 1) = i / camera.imageSize.width;
        }
        generator->correctPoints(motion, pixels, places);
        Mat raw(camera.imageSize, CV_32F), truth = raw.clone();
        for (int i = 0; i < pixels.rows; i++)
        {
            raw.at<float>(i / raw.cols, i % raw.cols) =
                brightness(simulator, Point2d(places.at<double>(i, 0), places.at<double>(i, 1)));
            truth.at<float>(i / raw.cols, i % raw.cols) = brightness(simulator, Point2d(i % raw.cols, i / raw.cols));
        }

        Mat map1, map2, mask, remapped, splatted, weights;
        generator->initRectifyMap(motion, map1, map2, CV_32FC1, mask);
        cv::remap(raw, remapped, map1, map2, INTER_LINEAR);
        splat(raw, places, splatted, weights);
        const Mat common = mask & (weights > 0.5);
        EXPECT_GE(cv::countNonZero(common), 0.7 * common.size().area());
        EXPECT_GE(psnr(remapped, splatted, common), 40) << "round " << round;
        EXPECT_GE(psnr(remapped, truth, common), 40) << "round " << round;
        EXPECT_LT(psnr(raw, truth, common), 36) << "round " << round;
    }
}

INSTANTIATE_TEST_CASE_P(RSAckermann, WarpSplat, testing::Values(ALL_LENSES));

}} // namespace opencv_test::
