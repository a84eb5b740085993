// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "image_ends.hpp"

#include <cstring>

namespace rsackermann_samples {

namespace {

// A PNG file is a signature and chunks of length, name, data and checksum; the last one is called IEND.
bool isPngCutShort(const std::vector<uchar>& b)
{
    for (size_t at = 8; at + 12 <= b.size();)
    {
        const size_t length = size_t(b[at]) << 24 | size_t(b[at + 1]) << 16 | size_t(b[at + 2]) << 8 | b[at + 3];
        if (std::memcmp(&b[at + 4], "IEND", 4) == 0)
            return false;
        at += 12 + length;
    }
    return true;
}

// A JPEG file is a row of segments, each with a marker and, except for a few, a length; EOI (0xD9) ends the image. In
// coded data 0xFF is stuffed with a 0 or begins a restart, which have no length, either. Searching for EOI alone would
// find the one of a thumbnail.
bool isJpegCutShort(const std::vector<uchar>& b)
{
    const int EOI = 0xD9;
    for (size_t at = 2; at + 1 < b.size();)
    {
        const void* const next = std::memchr(&b[at], 0xFF, b.size() - 1 - at);
        if (!next)
            return true;
        at = size_t(static_cast<const uchar*>(next) - b.data());
        const int marker = b[at + 1];
        if (marker == 0xFF) // fill byte
        {
            at++;
            continue;
        }
        at += 2;
        if (marker == EOI)
            return false;
        if (marker == 0 || marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8))
            continue;
        if (at + 1 >= b.size())
            return true;
        at += size_t(b[at]) << 8 | b[at + 1];
    }
    return true;
}

} // namespace

bool isCutShort(const std::vector<uchar>& bytes)
{
    static const uchar png[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    if (bytes.size() >= 8 && std::memcmp(bytes.data(), png, 8) == 0)
        return isPngCutShort(bytes);
    if (bytes.size() >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF)
        return isJpegCutShort(bytes);
    return false;
}

} // namespace rsackermann_samples
