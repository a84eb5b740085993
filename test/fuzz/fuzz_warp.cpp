// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "values.hpp"

// A motion, a camera and sizes for WarpMapGenerator: what maps and points say is finite, and within the range of
// cv::remap where it is valid.

using namespace cv::rsackermann;
using fuzz::require;

namespace {

const double NONE = -16384, LARGEST = 32767;

// Mostly tiny, which is quick; some as wide as vectors and a few as tiles of the maps.
int largestSide(fuzz::Values& values)
{
    const int kind = values.integer(0, 63);
    return kind == 0 ? 160 : kind < 12 ? 24 : 6;
}

bool isPlace(double x, double y)
{
    return std::abs(x) <= LARGEST && std::abs(y) <= LARGEST;
}

void checkMaps(const cv::Mat& map1, const cv::Mat& map2, const cv::Mat& mask, const cv::Size& size, int type)
{
    require(map1.size() == size && mask.size() == size && mask.type() == CV_8U, "a map hasn't the size of the camera");
    if (type == CV_16SC2)
        return require(map1.type() == CV_16SC2 && map2.size() == size, "a map isn't of the type asked for");
    require(map1.type() == type, "a map isn't of the type asked for");
    for (int y = 0; y < size.height; y++)
        for (int x = 0; x < size.width; x++)
        {
            const cv::Point2f p =
                type == CV_32FC2 ? map1.at<cv::Point2f>(y, x) : cv::Point2f(map1.at<float>(y, x), map2.at<float>(y, x));
            require(isPlace(p.x, p.y), "a map has a place that isn't finite or beyond what cv::remap takes");
            require(mask.at<uchar>(y, x) == 0 || p != cv::Point2f(NONE, NONE),
                    "the mask has a pixel that has no place");
        }
}

void checkPoints(const std::vector<cv::Point2d>& points, const cv::Mat& mask)
{
    for (size_t i = 0; i < points.size(); i++)
        require(isPlace(points[i].x, points[i].y) && (mask.at<uchar>(int(i)) || points[i] == cv::Point2d(NONE, NONE)),
                "a point isn't finite, or has a place without having one");
}

void usePoints(fuzz::Values& values, const WarpMapGenerator& generator, const AckermannMotion& motion,
               const cv::Size& size)
{
    std::vector<cv::Point2d> points, moved;
    std::vector<double> depths;
    for (int i = 0; i < 16; i++)
    {
        points.push_back(cv::Point2d(values.number(-10, size.width + 10), values.number(-10, size.height + 10)));
        depths.push_back(values.number(-1, 30));
    }
    const bool withDepths = values.flag() && (motion.wallDistance > 0);
    cv::Mat mask;
    generator.correctPoints(motion, points, moved, withDepths ? cv::InputArray(depths) : cv::noArray(), mask);
    checkPoints(moved, mask);
    generator.distortPoints(motion, points, moved, withDepths ? cv::InputArray(depths) : cv::noArray(), mask);
    checkPoints(moved, mask);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    fuzz::Values values(data, size);
    try
    {
        static const int types[] = {CV_32FC1, CV_32FC2, CV_16SC2};
        const RollingShutterCamera camera = values.camera(largestSide(values));
        const AckermannMotion motion = values.motion(camera);
        WarpMapGenerator::Params params;
        if (values.flag())
        {
            params.newSize = cv::Size(values.integer(1, 40), values.integer(1, 40));
            params.newCameraMatrix = cv::Matx33d(values.number(1, 200), 0, values.number(-80, 160), 0,
                                                 values.number(1, 200), values.number(-80, 160), 0, 0, 1);
        }
        params.maxIterations = values.integer(0, 3) ? params.maxIterations : values.integer(0, 100);
        params.tolerance = values.around(params.tolerance, 0, 1);
        const cv::Size newSize = params.newSize.empty() ? camera.imageSize : params.newSize;
        const int type = types[values.integer(0, 2)];
        const cv::Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera, params);
        cv::Mat map1, map2, mask;
        generator->initRectifyMap(motion, map1, map2, type, mask);
        checkMaps(map1, map2, mask, newSize, type);
        generator->initDistortMap(motion, map1, map2, type, mask);
        checkMaps(map1, map2, mask, camera.imageSize, type);
        const cv::Rect roi = generator->validRoi(motion);
        require((roi & cv::Rect(cv::Point(), newSize)) == roi, "the valid area is larger than the image");
        const cv::Matx33d K = generator->optimalNewCameraMatrix(motion, values.number(0, 1));
        require(fuzz::isFinite(cv::Mat(K)) && K(0, 0) > 0 && K(1, 1) > 0, "the new camera matrix isn't one");
        usePoints(values, *generator, motion, newSize);
    }
    catch (const cv::Exception& e)
    {
        require(e.code == cv::Error::StsBadArg, "an exception isn't about an argument");
        require(!e.err.empty(), "an exception has no message");
    }
    return 0;
}
