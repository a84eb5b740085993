// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "video_ends.hpp"
#include "files.hpp"

#include "opencv2/core.hpp"
#include <cstdint>
#include <cstring>
#include <fstream>

namespace rsackermann_samples {

namespace {

// Reads a file here and there.
class Bytes
{
public:
    explicit Bytes(const std::string& path)
        : file_(path.c_str(), std::ios::binary | std::ios::ate),
          size_(uint64_t(std::max(std::streamoff(file_.tellg()), std::streamoff(0))))
    {
    }

    uint64_t size() const { return size_; }

    // False at the end of the file.
    bool read(uint64_t at, uchar* bytes, size_t count)
    {
        file_.clear();
        file_.seekg(std::streamoff(at));
        return bool(file_.read(reinterpret_cast<char*>(bytes), std::streamsize(count)));
    }

private:
    std::ifstream file_;
    const uint64_t size_;
};

uint64_t bigEndian(const uchar* bytes, int count)
{
    uint64_t value = 0;
    for (int i = 0; i < count; i++)
        value = value << 8 | bytes[i];
    return value;
}

// AVI: chunks RIFF with a size each.
bool isRiffCutShort(Bytes& file)
{
    uchar head[8];
    for (uint64_t at = 0; file.read(at, head, 8) && std::memcmp(head, "RIFF", 4) == 0;)
    {
        const uint64_t size = uint64_t(head[7]) << 24 | uint64_t(head[6]) << 16 | uint64_t(head[5]) << 8 | head[4];
        at += 8 + size;
        if (at > file.size())
            return true;
        at += size % 2;
    }
    return false;
}

// MP4 and MOV: boxes of size and name; a size of 1 is followed by the real one, 0 is up to the end of the file.
bool isBoxCutShort(Bytes& file)
{
    uchar head[16];
    for (uint64_t at = 0; at < file.size();)
    {
        if (!file.read(at, head, 8))
            return true;
        uint64_t size = bigEndian(head, 4);
        if (size == 0)
            return false;
        if (size == 1)
        {
            if (!file.read(at, head, 16))
                return true;
            size = bigEndian(head + 8, 8);
        }
        if (size < 8) // no box: something was appended
            return false;
        if (size > file.size() - at)
            return true;
        at += size;
    }
    return false;
}

// A number of EBML, whose first byte tells its length by the zeros it begins with.
bool readEbmlNumber(Bytes& file, uint64_t& at, bool withoutMark, uint64_t& value, bool& unknown)
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

// Matroska and WebM: elements of a name and a size, which may be unknown in a live recording.
bool isEbmlCutShort(Bytes& file)
{
    for (uint64_t at = 0; at < file.size();)
    {
        uint64_t id = 0, size = 0;
        bool unknown = false;
        if (!readEbmlNumber(file, at, false, id, unknown) || !readEbmlNumber(file, at, true, size, unknown))
            return true;
        if (unknown)
            return false;
        if (size > file.size() - at)
            return true;
        at += size;
    }
    return false;
}

} // namespace

bool isVideoCutShort(const std::string& path)
{
    Bytes file(path);
    uchar head[8];
    if (!file.read(0, head, 8))
        return false;
    if (std::memcmp(head, "RIFF", 4) == 0)
        return isRiffCutShort(file);
    if (bigEndian(head, 4) == 0x1A45DFA3)
        return isEbmlCutShort(file);
    for (const char* box : {"ftyp", "moov", "mdat", "free", "wide", "skip"})
        if (std::memcmp(head + 4, box, 4) == 0)
            return isBoxCutShort(file);
    return false;
}

bool countsFrames(const std::string& path)
{
    const std::string format = extension(path);
    return format == ".avi" || format == ".mp4" || format == ".m4v" || format == ".mov";
}

} // namespace rsackermann_samples
