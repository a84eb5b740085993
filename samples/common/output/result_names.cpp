// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "result_names.hpp"
#include "files.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/imgcodecs.hpp"

namespace rsackermann_samples {

// Whether a name is that of a result in a file.
static bool isNamedLikeFile(const std::string& path)
{
    return extension(path) == ".gz" || isStorageFormat(extension(path)) || isVideo(path) || cv::haveImageWriter(path);
}

bool isResultFolder(const std::string& target, bool isSingle, const std::string& option)
{
    if (target.empty())
        return false;
    if (target.back() == '/' || cv::utils::fs::isDirectory(target))
        return true;
    const bool isFile = cv::utils::fs::exists(target);
    if (!isSingle && (isFile || isNamedLikeFile(target)))
        throw UsageError("option --" + option + ": " + target + " is " + (isFile ? "a file" : "named like a file") +
                         ", and several results need a folder: one that exists, or a name that ends with / or has no "
                         "extension of a file");
    return !isSingle;
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
    for (size_t end = path.rfind('/'); end != std::string::npos && end > 0; end = path.rfind('/', end - 1))
    {
        const std::string folder = path.substr(0, end);
        if (cv::utils::fs::exists(folder) && !cv::utils::fs::isDirectory(folder))
            throw InputError(path + " can't be written: " + folder + " is no folder");
    }
}

} // namespace rsackermann_samples
