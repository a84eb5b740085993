// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "map_file.hpp"
#include "files.hpp"
#include "options.hpp"

namespace rsackermann_samples {

void writeMaps(const std::string& path, const cv::Mat& map1, const cv::Mat& map2)
{
    AtomicFile file(path);
    // Base64 takes a quarter of the time of decimal numbers and two thirds of their room, and it is exact.
    cv::FileStorage fs(file.temporaryName(), cv::FileStorage::WRITE_BASE64);
    if (!fs.isOpened())
        throw InputError(path + " can't be written");
    fs << "map1" << map1 << "map2" << map2;
    fs.release();
    file.commit();
}

} // namespace rsackermann_samples
