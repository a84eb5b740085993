// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "depth_file.hpp"
#include "options.hpp"

#include <regex>

namespace rsackermann_samples {

namespace {

// The header is a Python dictionary in text, between the length and the values.
std::string headerOf(const std::vector<uchar>& bytes, size_t& values)
{
    const std::string magic = "\x93NUMPY";
    const size_t fixed = magic.size() + 2;
    if (bytes.size() < fixed + 4 ||
        !std::equal(magic.begin(), magic.end(), bytes.begin(), [](char a, uchar b) { return uchar(a) == b; }))
        throw InputError("the file isn't of the format .npy");
    const bool isFirst = bytes[magic.size()] == 1; // version, with a length of two bytes
    size_t length = 0;
    for (size_t i = isFirst ? 2 : 4; i-- > 0;)
        length = length << 8 | bytes[fixed + i];
    const size_t begin = fixed + (isFirst ? 2 : 4), longest = 4096;
    if (length > longest || begin + length > bytes.size())
        throw InputError("the header of the .npy file is damaged");
    values = begin + length;
    return std::string(bytes.begin() + ptrdiff_t(begin), bytes.begin() + ptrdiff_t(values));
}

int typeOf(const std::string& header)
{
    std::smatch found;
    if (std::regex_search(header, found, std::regex("'descr': *'<(u2|f4|f8)'")))
        return found[1] == "u2" ? CV_16U : found[1] == "f4" ? CV_32F : CV_64F;
    throw InputError("the .npy file has another type than uint16, float32 or float64, little-endian");
}

cv::Size sizeOf(const std::string& header)
{
    std::smatch found;
    if (!std::regex_search(header, found, std::regex("'shape': *\\(([0-9]{1,5}), *([0-9]{1,5}),?\\)")))
        throw InputError("the .npy file doesn't have two dimensions of up to 99999");
    if (header.find("'fortran_order': False") == std::string::npos)
        throw InputError("the .npy file has its columns first; rows first are expected");
    return cv::Size(std::stoi(found[2]), std::stoi(found[1]));
}

} // namespace

cv::Mat decodeNpy(const std::vector<uchar>& bytes)
{
    size_t values = 0;
    const std::string header = headerOf(bytes, values);
    const int type = typeOf(header);
    const cv::Size size = sizeOf(header);
    if (size.empty() || bytes.size() - values < size_t(size.width) * size_t(size.height) * CV_ELEM_SIZE(type))
        throw InputError("the .npy file is empty or cut short");
    return cv::Mat(size, type, const_cast<uchar*>(bytes.data() + values)).clone();
}

} // namespace rsackermann_samples
