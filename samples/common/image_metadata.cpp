// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "image_metadata.hpp"

#include <algorithm>
#include <cstring>
#include <zlib.h>

namespace rsackermann_samples {

namespace {

// Of segments of a JPEG file.
const char EXIF_HEAD[] = {'E', 'x', 'i', 'f', 0, 0};
const char PROFILE_HEAD[] = {'I', 'C', 'C', '_', 'P', 'R', 'O', 'F', 'I', 'L', 'E', 0};

bool beginsWith(const std::vector<uchar>& file, const char* magic, size_t size)
{
    return file.size() >= size && std::memcmp(file.data(), magic, size) == 0;
}

bool isJpeg(const std::vector<uchar>& file)
{
    return beginsWith(file, "\xFF\xD8\xFF", 3);
}

bool isPng(const std::vector<uchar>& file)
{
    return beginsWith(file, "\x89PNG\r\n\x1A\n", 8);
}

size_t bigEndian(const uchar* bytes, int count)
{
    size_t value = 0;
    for (int i = 0; i < count; i++)
        value = value << 8 | bytes[i];
    return value;
}

void appendBigEndian(std::vector<uchar>& bytes, size_t value, int count)
{
    for (int i = count - 1; i >= 0; i--)
        bytes.push_back(uchar(value >> 8 * i));
}

// A part of a file: a segment of JPEG, without marker and length, or a chunk of PNG, without length, type and checksum.
struct Part
{
    size_t type, begin, size;
};

// The segments in front of the coded data.
std::vector<Part> segmentsOf(const std::vector<uchar>& file)
{
    std::vector<Part> parts;
    const int SOS = 0xDA;
    for (size_t at = 2; at + 4 <= file.size() && file[at] == 0xFF;)
    {
        if (file[at + 1] == 0xFF) // fill byte
        {
            at++;
            continue;
        }
        const size_t length = bigEndian(&file[at + 2], 2);
        if (length < 2 || at + 2 + length > file.size())
            break;
        parts.push_back({file[at + 1], at + 4, length - 2});
        if (file[at + 1] == SOS)
            break;
        at += 2 + length;
    }
    return parts;
}

std::vector<Part> chunksOf(const std::vector<uchar>& file)
{
    std::vector<Part> parts;
    for (size_t at = 8; at + 12 <= file.size();)
    {
        const size_t length = bigEndian(&file[at], 4);
        if (length > file.size() - at - 12)
            break;
        parts.push_back({bigEndian(&file[at + 4], 4), at + 8, length});
        at += 12 + length;
    }
    return parts;
}

const size_t EXIF_CHUNK = 'e' << 24 | 'X' << 16 | 'I' << 8 | 'f', END_CHUNK = 'I' << 24 | 'E' << 16 | 'N' << 8 | 'D',
             PROFILE_CHUNK = 'i' << 24 | 'C' << 16 | 'C' << 8 | 'P', APP1 = 0xE1, APP2 = 0xE2;

std::vector<uchar> bytesOf(const std::vector<uchar>& file, size_t begin, size_t size)
{
    return std::vector<uchar>(file.begin() + std::ptrdiff_t(begin), file.begin() + std::ptrdiff_t(begin + size));
}

void append(std::vector<uchar>& bytes, const std::vector<uchar>& more)
{
    bytes.insert(bytes.end(), more.begin(), more.end());
}

bool hasHead(const std::vector<uchar>& file, const Part& part, const char* head, size_t size)
{
    return part.size > size && std::memcmp(&file[part.begin], head, size) == 0;
}

std::vector<uchar> exifSegment(const std::vector<uchar>& exif)
{
    const size_t largest = 0xFFFF - 2 - sizeof EXIF_HEAD;
    if (exif.empty() || exif.size() > largest)
        return std::vector<uchar>();
    std::vector<uchar> segment = {0xFF, uchar(APP1)};
    appendBigEndian(segment, 2 + sizeof EXIF_HEAD + exif.size(), 2);
    segment.insert(segment.end(), EXIF_HEAD, EXIF_HEAD + sizeof EXIF_HEAD);
    append(segment, exif);
    return segment;
}

std::vector<uchar> exifChunk(const std::vector<uchar>& exif)
{
    std::vector<uchar> chunk;
    if (exif.empty())
        return chunk;
    appendBigEndian(chunk, exif.size(), 4);
    appendBigEndian(chunk, EXIF_CHUNK, 4);
    append(chunk, exif);
    appendBigEndian(chunk, crc32(0, &chunk[4], uInt(chunk.size() - 4)), 4);
    return chunk;
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

// A number of a TIFF file in its byte order; 0 beyond the end.
size_t tiffNumber(const std::vector<uchar>& file, size_t at, int count)
{
    if (at + size_t(count) > file.size())
        return 0;
    if (file[0] == 'M')
        return bigEndian(&file[at], count);
    size_t value = 0;
    for (int i = count - 1; i >= 0; i--)
        value = value << 8 | file[at + size_t(i)];
    return value;
}

bool isCmykTiff(const std::vector<uchar>& file)
{
    const size_t PHOTOMETRIC = 262, SEPARATED = 5, begin = tiffNumber(file, 4, 4), entries = tiffNumber(file, begin, 2);
    for (size_t i = 0; i < entries; i++)
        if (tiffNumber(file, begin + 2 + 12 * i, 2) == PHOTOMETRIC)
            return tiffNumber(file, begin + 2 + 12 * i + 8, 2) == SEPARATED;
    return false;
}

} // namespace

ImageMetadata metadataOf(const std::vector<uchar>& file)
{
    ImageMetadata metadata;
    if (isJpeg(file))
    {
        for (const Part& part : segmentsOf(file))
            if (part.type == APP1 && metadata.exif.empty() && hasHead(file, part, EXIF_HEAD, sizeof EXIF_HEAD))
                metadata.exif = bytesOf(file, part.begin + sizeof EXIF_HEAD, part.size - sizeof EXIF_HEAD);
            else if (part.type == APP2 && hasHead(file, part, PROFILE_HEAD, sizeof PROFILE_HEAD))
                append(metadata.profile, bytesOf(file, part.begin - 4, part.size + 4)); // a profile may have several
    }
    else if (isPng(file))
    {
        for (const Part& part : chunksOf(file))
            if (part.type == EXIF_CHUNK && metadata.exif.empty())
                metadata.exif = bytesOf(file, part.begin, part.size);
            else if (part.type == PROFILE_CHUNK && metadata.profile.empty())
                metadata.profile = bytesOf(file, part.begin - 8, part.size + 12);
    }
    return metadata;
}

void addMetadata(std::vector<uchar>& file, const ImageMetadata& metadata, bool isGrey)
{
    const size_t header = 13; // bytes of the first chunk of PNG, behind which others may stand
    const size_t place = isJpeg(file) ? 2 : 8 + 12 + header;
    if (!isJpeg(file) && !isPng(file))
        return;
    std::vector<uchar> parts = isJpeg(file) ? exifSegment(metadata.exif) : exifChunk(metadata.exif);
    const bool isSegment = !metadata.profile.empty() && metadata.profile[0] == 0xFF; // a chunk isn't that long
    if (isSegment == isJpeg(file) && isGrey == metadata.isGrey)
        append(parts, metadata.profile);
    file.insert(file.begin() + std::ptrdiff_t(place), parts.begin(), parts.end());
}

bool isCmyk(const std::vector<uchar>& file)
{
    if (isJpeg(file))
        for (const Part& part : segmentsOf(file))
        {
            // The segments SOF begin with the precision, rows, columns and the number of colours; DHT, JPG and DAC are
            // among them.
            const bool isFrame =
                part.type >= 0xC0 && part.type <= 0xCF && part.type != 0xC4 && part.type != 0xC8 && part.type != 0xCC;
            if (isFrame && part.size >= 6)
                return file[part.begin + 5] == 4;
        }
    return (beginsWith(file, "II*\0", 4) || beginsWith(file, "MM\0*", 4)) && isCmykTiff(file);
}

bool isCutShort(const std::vector<uchar>& file)
{
    if (!isPng(file))
        return isJpeg(file) && isJpegCutShort(file);
    const std::vector<Part> chunks = chunksOf(file);
    return std::none_of(chunks.begin(), chunks.end(), [](const Part& chunk) { return chunk.type == END_CHUNK; });
}

} // namespace rsackermann_samples
