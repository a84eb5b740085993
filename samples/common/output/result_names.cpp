// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "result_names.hpp"
#include "files.hpp"

#include "opencv2/core/utils/filesystem.hpp"

namespace rsackermann_samples {

bool isResultFolder(const std::string& target, bool isSingle)
{
    return !target.empty() && (!isSingle || target.back() == '/' || cv::utils::fs::isDirectory(target));
}

std::string resultPath(const std::string& target, bool isFolder, const std::string& name)
{
    if (!isFolder || target.empty())
        return target;
    return target + (target.back() == '/' ? "" : "/") + name;
}

std::string overlayName(const std::string& input)
{
    // It has colours, which not every format of an image has.
    const std::string format = extension(input);
    return format == ".pgm" || format == ".pbm" ? stem(input) + ".png" : fileName(input);
}

void checkResult(const std::string& path, bool isReplaced)
{
    if (cv::utils::fs::isDirectory(path))
        throw InputError(path + " is a folder");
    if (isPipe(path))
        throw InputError(path + " is a pipe or a device, which no result replaces");
    if (!isReplaced && cv::utils::fs::exists(path))
        throw InputError(path + " exists (--overwrite replaces it)");
}

} // namespace rsackermann_samples
    for (size_t end = path.rfind('/'); end != std::string::npos && end > 0; end = path.rfind('/', end - 1))
    {
        const std::string folder = path.substr(0, end);
        if (cv::utils::fs::exists(folder) && !cv::utils::fs::isDirectory(folder))
            throw InputError(path + " can't be written: " + folder + " is no folder");
    }
