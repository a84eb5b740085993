// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "container_bytes.hpp"

#include <algorithm>
#include <cstring>

namespace rsackermann_samples {

Bytes::Bytes(const std::string& path)
    : file_(path.c_str(), std::ios::binary | std::ios::ate),
      size_(uint64_t(std::max(std::streamoff(file_.tellg()), std::streamoff(0))))
{
}

bool Bytes::read(uint64_t at, uchar* bytes, size_t count)
{
    if (at > size_ || count > size_ - at)
        return false;
    file_.clear();
    file_.seekg(std::streamoff(at));
    return bool(file_.read(reinterpret_cast<char*>(bytes), std::streamsize(count)));
}

uint64_t bigEndian(const uchar* bytes, int count)
{
    uint64_t value = 0;
    for (int i = 0; i < count; i++)
        value = value << 8 | bytes[i];
    return value;
}

ContainerFormat containerFormat(Bytes& file)
{
    uchar head[8];
    if (!file.read(0, head, 8))
        return CONTAINER_OTHER;
    if (std::memcmp(head, "RIFF", 4) == 0)
        return CONTAINER_RIFF;
    if (bigEndian(head, 4) == 0x1A45DFA3)
        return CONTAINER_EBML;
    for (const char* box : {"ftyp", "moov", "mdat", "free", "wide", "skip"})
        if (std::memcmp(head + 4, box, 4) == 0)
            return CONTAINER_BOX;
    return CONTAINER_OTHER;
}

// A size of 1 is followed by the real one, 0 is up to the end of the file.
bool readBox(Bytes& file, uint64_t at, ContainerPart& part)
{
    uchar head[16];
    if (!file.read(at, head, 8))
        return false;
    uint64_t size = bigEndian(head, 4), length = 8;
    part.name = bigEndian(head + 4, 4);
    part.isEndless = size == 0;
    if (size == 1)
    {
        if (!file.read(at, head, 16))
            return false;
        size = bigEndian(head + 8, 8);
        length = 16;
    }
    part.begin = at + length;
    part.end = part.isEndless ? file.size() : at + std::min(size, ~uint64_t(0) - at);
    return part.isEndless || size >= length;
}

// A number of EBML, whose first byte gives its length by the zeros it begins with.
static bool readEbmlNumber(Bytes& file, uint64_t& at, bool withoutMark, uint64_t& value, bool& unknown)
{
    uchar bytes[8];
    if (!file.read(at, bytes, 1) || bytes[0] == 0)
        return false;
    int length = 1;
    while (!(bytes[0] & (0x80 >> (length - 1))))
        length++;
    if (!file.read(at, bytes, size_t(length)))
        return false;
    at += uint64_t(length);
    const uint64_t mark = uint64_t(1) << (7 * length);
    value = bigEndian(bytes, length);
    unknown = (value & (mark - 1)) == mark - 1;
    value = withoutMark ? value & (mark - 1) : value;
    return true;
}

// The size may be unknown in a live recording.
bool readElement(Bytes& file, uint64_t at, ContainerPart& part)
{
    uint64_t size = 0;
    bool unknown = false;
    if (!readEbmlNumber(file, at, false, part.name, unknown) || !readEbmlNumber(file, at, true, size, part.isEndless))
        return false;
    part.begin = at;
    part.end = part.isEndless ? file.size() : at + size;
    return true;
}

} // namespace rsackermann_samples
