// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "image_task.hpp"
#include "files.hpp"
#include "map_file.hpp"
#include "output/image_file.hpp"

#include <cstring>

namespace rsackermann_samples {

namespace {

bool isSame(const cv::Mat& a, const cv::Mat& b)
{
    bool same = a.size() == b.size() && a.type() == b.type();
    for (int y = 0; y < a.rows && same && a.data != b.data; y++)
        same = std::memcmp(a.ptr(y), b.ptr(y), a.cols * a.elemSize()) == 0;
    return same;
}

// An image that stays as it is would lose by being coded again. Of formats with an orientation only those whose Exif
// data are kept in corrected images are copied, so that all results are turned alike.
bool isCopied(const std::string& input, const std::string& output)
{
    const std::string format = extension(input);
    return extension(output) == format && format != ".webp" && format != ".tif" && format != ".tiff";
}

} // namespace

StoredImage readStored(const std::string& input)
{
    StoredImage stored;
    stored.pixels = readImage(input, &stored.metadata);
    return stored;
}

AtomicFiles writeResults(const std::string& input, const StoredImage& stored, const CorrectedFrame& frame,
                         const Targets& targets)
{
    AtomicFiles files;
    if (!targets.overlay.empty())
        writeImage(files.add(targets.overlay), frame.overlay, stored.metadata);
    if (!targets.maps.empty())
        writeMaps(files.add(targets.maps), frame.map1, frame.map2);
    if (!targets.output.empty())
    {
        AtomicFile& file = files.add(targets.output);
        if (isCopied(input, targets.output) && isSame(stored.pixels, frame.image))
        {
            const std::vector<uchar> bytes = readBytes(input);
            file.write(bytes.data(), bytes.size());
        }
        else
            writeImage(file, frame.image, stored.metadata);
    }
    return files;
}

} // namespace rsackermann_samples
