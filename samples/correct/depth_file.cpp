// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "depth_file.hpp"
#include "files.hpp"

#include "opencv2/imgcodecs.hpp"
#include "opencv2/imgproc.hpp"

namespace rsackermann_samples {

namespace {

cv::Mat decode(const std::string& path)
{
    const std::vector<uchar> bytes = readBytes(path);
    if (extension(path) == ".npy")
        return decodeNpy(bytes);
    cv::Mat values;
    try
    {
        values = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    }
    catch (const cv::Exception&) // of formats that are there but switched off, as EXR
    {
    }
    if (values.empty())
        throw InputError("the image can't be decoded");
    return values;
}

cv::Mat valuesOf(const std::string& path)
{
    const cv::Mat values = decode(path);
    if (values.channels() != 1 || (values.depth() != CV_16U && values.depth() != CV_32F && values.depth() != CV_64F))
        throw InputError("a depth of type " + cv::typeToString(values.type()) +
                         " isn't supported; one channel of 16 bits or of floating-point numbers is expected");
    return values;
}

cv::rsackermann::DepthMap depthOfPoints(const std::string& path, const DepthMeaning& meaning,
                                        const cv::rsackermann::RollingShutterCamera& camera)
{
    if (meaning.kind != DepthMeaning::METRIC)
        throw InputError(path + ": points are metric, not of another --depth_kind");
    cv::rsackermann::DepthMap depth = cv::rsackermann::DepthMap::fromPoints(readPointCloud(path), camera);
    depth.scale = meaning.scale > 0 ? meaning.scale : 1;
    return depth;
}

} // namespace

static cv::rsackermann::DepthMap readValues(const std::string& path, const DepthMeaning& meaning,
                                            const cv::rsackermann::RollingShutterCamera& camera)
{
    const cv::Mat stored = namingFile(path, [](const std::string& name) { return valuesOf(name); });
    const bool isMetric = meaning.kind == DepthMeaning::METRIC, isRelative = meaning.kind == DepthMeaning::RELATIVE,
               isWhole = stored.depth() == CV_16U;
    double scale = isRelative ? 1 : meaning.scale;
    if (scale == 0)
        scale = !isWhole ? 1 : isMetric ? 0.001 : 1. / 256;
    cv::Mat values = stored;
    if (stored.depth() == CV_64F)
        stored.convertTo(values, CV_32F);
    if (meaning.kind == DepthMeaning::DISPARITY)
    {
        // Disparities are in pixels of their own image.
        const double units =
            camera.cameraMatrix(0, 0) * stored.cols / camera.imageSize.width * meaning.baseline / scale;
        cv::Mat1f disparities, metres(stored.size(), 0.f);
        values.convertTo(disparities, CV_32F);
        for (int y = 0; y < metres.rows; y++)
            for (int x = 0; x < metres.cols; x++)
                if (disparities(y, x) > 0)
                    metres(y, x) = float(units / disparities(y, x));
        values = metres;
        scale = 1;
    }
    // Between a near and a far surface there is nothing.
    if (values.size() != camera.imageSize)
        cv::resize(values, values, camera.imageSize, 0, 0, cv::INTER_NEAREST);
    return cv::rsackermann::DepthMap(values, meaning.camera, scale,
                                     isRelative ? cv::rsackermann::DEPTH_RELATIVE : cv::rsackermann::DEPTH_METRIC);
}

cv::rsackermann::DepthMap readDepth(const std::string& path, const DepthMeaning& meaning,
                                    const cv::rsackermann::RollingShutterCamera& camera)
{
    cv::rsackermann::DepthMap depth =
        extension(path) == ".csv" ? depthOfPoints(path, meaning, camera) : readValues(path, meaning, camera);
    depth.scaleSigma = meaning.scaleSigma;
    return depth;
}

} // namespace rsackermann_samples
