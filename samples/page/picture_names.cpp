// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "picture_names.hpp"
#include "files.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include <cstdlib>

namespace rsackermann_samples {

std::string pictureName(size_t frame, const std::string& kind)
{
    return cv::format("%06zu_%s.jpg", frame, kind.c_str());
}

std::vector<std::string> picturesIn(const std::string& folder)
{
    std::vector<std::string> pictures;
    if (!cv::utils::fs::isDirectory(folder))
        return pictures;
    std::vector<cv::String> paths;
    cv::utils::fs::glob(folder, "*.jpg", paths, false, false);
    for (const std::string& path : paths)
        for (const char* kind : {"raw", "overlay", "corrected"})
            if (fileName(path) == pictureName(std::strtoul(fileName(path).c_str(), nullptr, 10), kind))
                pictures.push_back(path);
    return pictures;
}

} // namespace rsackermann_samples
