// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "exports.hpp"
#include "output/image_file.hpp"
#include "opencv2/rsackermann/warp.hpp"

namespace rsackermann_samples {

using namespace cv::rsackermann;

cv::Mat stMap(const cv::Mat& columns, const cv::Mat& rows, const cv::Size& source, int depth)
{
    cv::Mat image(columns.size(), CV_32FC3);
    for (int y = 0; y < image.rows; y++)
        for (int x = 0; x < image.cols; x++)
        {
            const float column = columns.at<float>(y, x), row = rows.at<float>(y, x);
            const bool seen = column >= 0 && row >= 0 && column <= source.width - 1 && row <= source.height - 1;
            image.at<cv::Vec3f>(y, x) =
                cv::Vec3f(seen ? 1.f : 0.f, 1 - (row + 0.5f) / source.height, (column + 0.5f) / source.width);
        }
    if (depth == CV_16U)
        image.convertTo(image, CV_16U, 65535);
    return image;
}

std::string stMapFile(const std::string& folder, const MotionFrame& frame, const std::string& direction,
                      const std::string& format)
{
    return folder + "/" + frame.name() + "." + direction + "." + format;
}

void writeStMaps(const std::string& folder, const std::string& format, const RollingShutterCamera& camera,
                 const std::vector<MotionFrame>& frames)
{
    const int depth = format == "png" ? CV_16U : CV_32F;
    const cv::Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    for (const MotionFrame& frame : frames)
    {
        cv::Mat columns, rows;
        const auto write = [&](const char* direction) {
            writeImage(stMapFile(folder, frame, direction, format), stMap(columns, rows, camera.imageSize, depth));
        };
        generator->setCamera(frame.cameraOf(camera));
        generator->initRectifyMap(frame.motion, columns, rows);
        write("rectify");
        generator->initDistortMap(frame.motion, columns, rows);
        write("distort");
    }
}

} // namespace rsackermann_samples
