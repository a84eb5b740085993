// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "workload.hpp"

namespace benchmark {

using namespace rsackermann_samples;

namespace {

street::StreetCamera makeView(const cv::Size& size, const std::vector<double>& lens)
{
    street::StreetCamera view(size, 0.9 * size.width, 0.4 / 30 / size.height, 1.2);
    view.lens = lens;
    return view;
}

street::StreetScene makeScene()
{
    street::StreetScene scene;
    scene.speed = 15;
    scene.yawRate = 0.7;
    scene.left = 2.5;
    scene.right = 3;
    scene.seed = 1;
    scene.noise = 1;
    return scene;
}

} // namespace

Drive::Drive(const cv::Size& size, const std::vector<double>& lens)
    : view(makeView(size, lens)), scene(makeScene()), camera(libraryCamera(view)), motion(libraryMotion(view, scene))
{
}

cv::Mat render(const Drive& drive)
{
    return street::StreetRenderer(drive.view, drive.scene).rollingShutter(2);
}

cv::Mat verticalSegments(const Drive& drive, int count, double outliers, std::vector<int>& walls)
{
    const street::StreetRenderer renderer(drive.view, drive.scene);
    const cv::Size size = drive.view.size;
    const double minLength = 0.1 * size.height, noise = 0.2;
    cv::RNG rng(1);
    cv::Mat segments(count, 4, CV_32F);
    walls.resize(count);
    for (int i = 0; i < count;)
    {
        // Above the horizon there are only walls, and vertical lines of an upright camera are columns.
        const double x = rng.uniform(0., size.width - 1.), length = rng.uniform(minLength, drive.view.cy);
        const double top = rng.uniform(0., drive.view.cy - length);
        cv::Point2d u, v;
        if (!renderer.toRolling(cv::Point2d(x, top), u) || !renderer.toRolling(cv::Point2d(x, top + length), v))
            continue;
        const double slant = rng.uniform(0., 1.) < outliers ? rng.uniform(-0.25, 0.25) * length : 0;
        cv::Vec4d segment(u.x + slant, u.y, v.x, v.y);
        for (int k = 3; k >= 0; k--)
            segment[k] += rng.gaussian(noise);
        segments.at<cv::Vec4f>(i) = segment;
        walls[i++] = x < drive.view.cx ? -1 : 1;
    }
    return segments;
}

} // namespace benchmark
