// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "strip_warp.hpp"

#include "opencv2/imgproc.hpp"
#include <algorithm>

namespace rsackermann_samples {

using namespace cv::rsackermann;

namespace {

double secondsSince(int64 tick)
{
    return double(cv::getTickCount() - tick) / cv::getTickFrequency();
}

} // namespace

StripWarp::StripWarp(const RollingShutterCamera& camera) : generator_(WarpMapGenerator::create(camera)) {}

template <class Use>
void StripWarp::forEachStrip(const AckermannMotion& motion, const DepthMap& depth, const Use& use)
{
    const RollingShutterCamera camera = generator_->getCamera();
    const int rows = depth.empty() ? 128 : camera.imageSize.height; // 128: maps are made in tiles of so many
    for (cv::Mat* map : {&map1_, &map2_})
        map->create(std::min(rows, camera.imageSize.height), camera.imageSize.width, CV_32FC1);
    for (int y = 0; y < camera.imageSize.height; y += rows)
    {
        const cv::Range strip(y, std::min(y + rows, camera.imageSize.height));
        WarpMapGenerator::Params params;
        params.newSize = cv::Size(camera.imageSize.width, strip.size());
        params.newCameraMatrix = camera.cameraMatrix;
        params.newCameraMatrix(1, 2) -= y;
        generator_->setParams(params);
        cv::Mat map1 = map1_.rowRange(0, strip.size()), map2 = map2_.rowRange(0, strip.size());
        generator_->initRectifyMap(motion, map1, map2, CV_32FC1, cv::noArray(), depth);
        use(strip, map1, map2);
    }
}

void StripWarp::correct(const cv::Mat& image, const AckermannMotion& motion, const DepthMap& depth, cv::Mat& corrected,
                        cv::Vec2d& seconds)
{
    corrected.create(image.size(), image.type());
    seconds = cv::Vec2d();
    int64 start = cv::getTickCount();
    forEachStrip(motion, depth, [&](const cv::Range& rows, const cv::Mat& map1, const cv::Mat& map2) {
        seconds[0] += secondsSince(start);
        start = cv::getTickCount();
        cv::remap(image, corrected.rowRange(rows), map1, map2, cv::INTER_LINEAR);
        seconds[1] += secondsSince(start);
        start = cv::getTickCount();
    });
}

void StripWarp::maps(const AckermannMotion& motion, const DepthMap& depth, cv::Mat& map1, cv::Mat& map2)
{
    for (cv::Mat* map : {&map1, &map2})
        map->create(generator_->getCamera().imageSize, CV_32FC1);
    forEachStrip(motion, depth, [&](const cv::Range& rows, const cv::Mat& strip1, const cv::Mat& strip2) {
        strip1.copyTo(map1.rowRange(rows));
        strip2.copyTo(map2.rowRange(rows));
    });
}

bool StripWarp::hasNoLens() const
{
    const RollingShutterCamera camera = generator_->getCamera();
    return camera.lensModel == LENS_PINHOLE && std::all_of(camera.distCoeffs.begin(), camera.distCoeffs.end(),
                                                           [](double coefficient) { return coefficient == 0; });
}

// Pixels along both axes of which coarse maps have one.
static const int STEP = 8;

WarpMapGenerator::Params StripWarp::coarse(const RollingShutterCamera& camera)
{
    WarpMapGenerator::Params params;
    params.newCameraMatrix = cv::Matx33d::diag(cv::Vec3d(1. / STEP, 1. / STEP, 1)) * camera.cameraMatrix;
    params.newSize = cv::Size((camera.imageSize.width + STEP - 1) / STEP, (camera.imageSize.height + STEP - 1) / STEP);
    return params;
}

// Of STEP x STEP pixels the first one that is known: of a few points none would be where the coarse pixels are.
template <class Value>
static cv::Mat firstKnown(const cv::Mat_<Value>& values)
{
    cv::Mat_<Value> kept((values.rows + STEP - 1) / STEP, (values.cols + STEP - 1) / STEP, Value(0));
    for (int y = 0; y < values.rows; y++)
        for (int x = 0; x < values.cols; x++)
        {
            Value& first = kept(y / STEP, x / STEP);
            if (!(first > 0) && values(y, x) > 0 && values(y, x) <= FLT_MAX)
                first = values(y, x);
        }
    return kept;
}

DepthMap StripWarp::coarse(const DepthMap& depth)
{
    if (depth.empty() || depth.camera == DEPTH_RAW)
        return depth;
    const bool isWhole = depth.values.depth() == CV_16U;
    DepthMap result = depth;
    result.values = isWhole ? firstKnown<ushort>(depth.values) : firstKnown<float>(depth.values);
    return result;
}

} // namespace rsackermann_samples
