// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "files.hpp"
#include "image_ends.hpp"
#include "options.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/imgcodecs.hpp"
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <unistd.h>

namespace rsackermann_samples {

AtomicFile::AtomicFile(const std::string& path) : path_(path), committed_(false)
{
    const std::string name = fileName(path), folder = path.substr(0, path.size() - name.size());
    if (!folder.empty() && !cv::utils::fs::createDirectories(folder))
        throw InputError("the folder " + folder + " can't be made");
    temporary_ = folder + cv::format(".%d-", int(getpid())) + name;
}

AtomicFile::~AtomicFile()
{
    if (!committed_)
        std::remove(temporary_.c_str());
}

void AtomicFile::commit()
{
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0)
        throw InputError(path_ + " can't be written");
    committed_ = true;
}

cv::Mat readImage(const std::string& path)
{
    if (!cv::utils::fs::exists(path))
        throw InputError("there is no such file");
    std::ifstream file(path.c_str(), std::ios::binary);
    const std::vector<uchar> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (bytes.empty())
        throw InputError("the file can't be read or is empty");
    // Some decoders fill up what is missing and say nothing.
    if (isCutShort(bytes))
        throw InputError("the image is cut short");
    // The sensor's rows count, hence no turning after the Exif orientation.
    const cv::Mat image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    if (image.empty())
        throw InputError("the image can't be decoded");
    return image;
}

void writeImage(const std::string& path, const cv::Mat& image)
{
    std::vector<uchar> bytes;
    bool encoded = false;
    try
    {
        encoded = cv::imencode(extension(path), image, bytes);
        // Not every format has 16 bits or an alpha channel, and encoders drop them in silence.
        if (encoded && (image.depth() != CV_8U || image.channels() == 4))
            encoded = cv::imdecode(bytes, cv::IMREAD_UNCHANGED).type() == image.type();
    }
    catch (const cv::Exception&)
    {
        encoded = false;
    }
    if (!encoded)
        throw InputError(path + ": the format " + extension(path) + " can't hold an image of type " + cv::typeToString(image.type()));
    AtomicFile file(path);
    std::ofstream stream(file.temporaryName().c_str(), std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    stream.close();
    if (!stream)
        throw InputError(path + " can't be written");
    file.commit();
}

void copyFile(const std::string& from, const std::string& to)
{
    AtomicFile file(to);
    std::ifstream source(from.c_str(), std::ios::binary);
    std::ofstream target(file.temporaryName().c_str(), std::ios::binary);
    target << source.rdbuf();
    target.close();
    if (!source || !target)
        throw InputError(to + " can't be written");
    file.commit();
}

cv::Mat readSegments(const std::string& path)
{
    std::ifstream file(path.c_str());
    if (!file)
        throw UsageError("lines file " + path + " can't be read");
    cv::Mat segments(0, 4, CV_32F);
    std::string line;
    for (int number = 1; std::getline(file, line); number++)
    {
        line = line.substr(0, line.find('#'));
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream stream(line);
        const std::vector<std::string> fields((std::istream_iterator<std::string>(stream)), std::istream_iterator<std::string>());
        if (fields.empty())
            continue;
        const std::string place = cv::format("line %d of %s", number, path.c_str());
        if (fields.size() != 4)
            throw UsageError(place + ": four numbers x1 y1 x2 y2 are expected");
        cv::Mat row(1, 4, CV_32F);
        for (int i = 0; i < 4; i++)
            row.at<float>(i) = float(parseNumber(fields[size_t(i)], place));
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

bool isSameFile(const std::string& a, const std::string& b)
{
    return cv::utils::fs::exists(a) && cv::utils::fs::exists(b) && cv::utils::fs::canonical(a) == cv::utils::fs::canonical(b);
}

} // namespace rsackermann_samples
