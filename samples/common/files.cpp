// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "files.hpp"
#include "options.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/imgcodecs.hpp"
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <iostream>
#include <iterator>
#include <set>
#include <sstream>
#include <sys/stat.h>

namespace rsackermann_samples {

const char* const PIPE = "it is a pipe or a device; a file is expected";

bool isPipe(const std::string& path)
{
    struct stat status;
    return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

std::vector<uchar> readBytes(const std::string& path)
{
    if (!cv::utils::fs::exists(path))
        throw InputError("there is no such file");
    if (isPipe(path))
        throw InputError(PIPE);
    if (cv::utils::fs::isDirectory(path))
        throw InputError("it is a folder; a file is expected");
    std::ifstream file(path.c_str(), std::ios::binary | std::ios::ate);
    const std::streamoff size = file.tellg();
    std::vector<uchar> bytes(size > 0 ? size_t(size) : 0u);
    file.seekg(0);
    if (bytes.empty() || !file.read(reinterpret_cast<char*>(bytes.data()), size))
        throw InputError("the file can't be read or is empty");
    return bytes;
}

cv::Mat readImage(const std::string& path, ImageMetadata* metadata)
{
    const std::vector<uchar> bytes = readBytes(path);
    // Some decoders fill up missing parts and say nothing.
    if (isCutShort(bytes))
        throw InputError("the image is cut short");
    if (isCmyk(bytes))
        throw InputError("images with the colours of printers (CMYK) aren't supported");
    // The sensor's rows count, hence no turning after the Exif orientation.
    const cv::Mat image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    if (image.empty())
        throw InputError("the image can't be decoded");
    if (image.depth() != CV_8U && image.depth() != CV_16U)
        throw InputError("the image is of type " + cv::typeToString(image.type()) +
                         "; only 8 and 16 bits without a sign are supported");
    const int longest = 32766; // of cv::remap
    if (std::max(image.cols, image.rows) > longest)
        throw InputError(cv::format("the image has %d x %d pixels; up to %d along each side are supported", image.cols,
                                    image.rows, longest));
    const bool isTiff = extension(path) == ".tif" || extension(path) == ".tiff";
    const size_t pages = isTiff ? cv::imcount(path, cv::IMREAD_UNCHANGED) : 1;
    if (pages > 1)
        std::cerr << path << ": warning: only the first of " << pages << " pages is read" << std::endl;
    if (metadata)
    {
        *metadata = metadataOf(bytes);
        metadata->isGrey = image.channels() == 1;
    }
    return image;
}

std::vector<uchar> encodeImage(const std::string& path, const cv::Mat& image, const ImageMetadata& metadata)
{
    const std::string format = extension(path);
    if (!cv::haveImageWriter(path))
        throw InputError(path + " has the extension of no image format that can be written");
    // Not every format has integers, colours, 16 bits or an alpha channel, and encoders drop them in silence.
    const bool isPortableMap = format == ".pbm" || format == ".pgm" || format == ".ppm" || format == ".pnm",
               isRadiance = format == ".hdr" || format == ".pic";
    std::vector<uchar> bytes;
    bool encoded = false;
    try
    {
        encoded = cv::imencode(format, image, bytes);
        if (encoded && (isPortableMap || isRadiance || image.depth() != CV_8U || image.channels() == 4))
        {
            const cv::Mat again = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
            encoded = again.type() == image.type() && (!isPortableMap || cv::norm(again, image, cv::NORM_INF) == 0);
        }
    }
    catch (const cv::Exception&)
    {
        encoded = false;
    }
    if (!encoded)
        throw InputError(path + ": the format " + format + " can't hold an image of type " +
                         cv::typeToString(image.type()));
    addMetadata(bytes, metadata, image.channels() == 1);
    return bytes;
}

std::ifstream openText(const std::string& path)
{
    const std::string mark = "\xEF\xBB\xBF";
    std::ifstream file(path.c_str(), std::ios::binary);
    size_t read = 0;
    while (read < mark.size() && file.peek() == (unsigned char)mark[read]) // a folder fails here
    {
        file.get();
        read++;
    }
    if (read < mark.size())
        for (; read > 0; read--)
            file.unget();
    return file;
}

cv::Mat readSegments(const std::string& path)
{
    std::ifstream file = openText(path);
    if (!file)
        throw UsageError("lines file " + path + " can't be read");
    cv::Mat segments(0, 4, CV_32F);
    std::string line;
    for (int number = 1; std::getline(file, line); number++)
    {
        line.resize(std::min(line.find('#'), line.size()));
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream stream(line);
        const std::vector<std::string> fields((std::istream_iterator<std::string>(stream)),
                                              std::istream_iterator<std::string>());
        if (fields.empty())
            continue;
        const std::string place = cv::format("line %d of %s", number, path.c_str());
        if (fields.size() != 4)
            throw UsageError(place + ": four numbers x1 y1 x2 y2 are expected");
        cv::Mat row(1, 4, CV_32F);
        for (int i = 0; i < 4; i++)
        {
            const double value = parseNumber(fields[size_t(i)], place);
            if (!(std::abs(value) <= FLT_MAX))
                throw UsageError(place + ": '" + fields[size_t(i)] + "' is too large for a pixel");
            row.at<float>(i) = float(value);
        }
        segments.push_back(row);
    }
    return segments;
}

std::string fileName(const std::string& path)
{
    return path.substr(path.find_last_of('/') + 1);
}

std::string stem(const std::string& path)
{
    const std::string name = fileName(path);
    return name.substr(0, name.find_last_of('.'));
}

std::string extension(const std::string& path)
{
    const std::string name = fileName(path);
    const size_t dot = name.find_last_of('.');
    std::string result = dot == std::string::npos ? "" : name.substr(dot);
    std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return result;
}

bool isStorageFormat(const std::string& extension)
{
    return extension == ".yml" || extension == ".yaml" || extension == ".xml" || extension == ".json";
}

bool isVideo(const std::string& path)
{
    // Those of cameras beside the usual ones: the containers MP4 (.360, .insv, .lrv) and MPEG-TS, and bare streams.
    static const std::set<std::string> known = {".mp4", ".avi",   ".mov",  ".mkv", ".m4v",  ".mpg",  ".mpeg", ".webm",
                                                ".wmv", ".mjpeg", ".3gp",  ".3g2", ".360",  ".insv", ".lrv",  ".ts",
                                                ".mts", ".m2ts",  ".h264", ".264", ".h265", ".265",  ".hevc", ".flv"};
    return known.count(extension(path)) > 0;
}

} // namespace rsackermann_samples
