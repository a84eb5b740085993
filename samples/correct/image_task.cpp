// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "image_task.hpp"
#include "files.hpp"
#include "map_file.hpp"
#include "output/image_file.hpp"

namespace rsackermann_samples {

namespace {

bool isSame(const cv::Mat& a, const cv::Mat& b)
{
    return a.data == b.data || cv::norm(a, b, cv::NORM_INF) == 0;
}

// An image that stays as it is would lose by being coded again. Of formats with an orientation only those whose Exif
// data are kept in corrected images are copied, so that all results are turned alike.
bool isCopied(const std::string& input, const std::string& output)
{
    const std::string format = extension(input);
    return extension(output) == format && format != ".webp" && format != ".tif" && format != ".tiff";
}

} // namespace

FrameReport correctImage(const std::string& input, const Targets& targets, const NextFrame& next,
                         const std::string& depthFile, FrameCorrector& corrector)
{
    std::vector<uchar> exif;
    const cv::Mat image = readImage(input, &exif);
    CorrectedFrame frame = corrector.correct(image, next, depthFile);
    AtomicFiles files;
    if (!targets.overlay.empty())
        writeImage(files.add(targets.overlay), frame.overlay, exif);
    if (!targets.maps.empty())
        writeMaps(files.add(targets.maps), frame.map1, frame.map2);
    if (!targets.output.empty())
    {
        AtomicFile& file = files.add(targets.output);
        if (isCopied(input, targets.output) && isSame(image, frame.image))
        {
            const std::vector<uchar> bytes = readBytes(input);
            file.write(bytes.data(), bytes.size());
        }
        else
            writeImage(file, frame.image, exif);
    }
    files.commit();
    frame.report.input = input;
    return frame.report;
}

} // namespace rsackermann_samples
