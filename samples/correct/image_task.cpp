// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "image_task.hpp"
#include "map_file.hpp"

namespace rsackermann_samples {

namespace {

bool isSame(const cv::Mat& a, const cv::Mat& b)
{
    return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

} // namespace

std::string correctImage(const std::string& input, const Targets& targets, const FrameFacts& facts, FrameCorrector& corrector)
{
    const cv::Mat image = readImage(input);
    CorrectedFrame frame = corrector.correct(image, facts);
    if (!targets.overlay.empty())
        writeImage(targets.overlay, frame.overlay);
    if (!targets.maps.empty())
        writeMaps(targets.maps, frame.map1, frame.map2);
    if (!targets.output.empty())
    {
        // An image that stays as it is doesn't lose anything by being coded again.
        if (extension(targets.output) == extension(input) && isSame(image, frame.image))
            copyFile(input, targets.output);
        else
            writeImage(targets.output, frame.image);
    }
    frame.report.input = input;
    return reportLine(frame.report);
}

} // namespace rsackermann_samples
