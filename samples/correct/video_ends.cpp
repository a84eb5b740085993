// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "video_ends.hpp"
#include "container_bytes.hpp"
#include "files.hpp"

#include <cstring>

namespace rsackermann_samples {

namespace {

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

// MP4 and MOV; what is no box was appended.
bool isBoxCutShort(Bytes& file)
{
    ContainerPart box = ContainerPart();
    for (uint64_t at = 0; at < file.size(); at = box.end)
    {
        uchar head[8];
        if (!file.read(at, head, 8))
            return true;
        const bool isLong = bigEndian(head, 4) == 1;
        if (!readBox(file, at, box))
            return isLong && file.size() - at < 16;
        if (box.isEndless)
            return false;
        if (box.end > file.size())
            return true;
    }
    return false;
}

// Matroska and WebM
bool isEbmlCutShort(Bytes& file)
{
    ContainerPart element = ContainerPart();
    for (uint64_t at = 0; at < file.size(); at = element.end)
    {
        if (!readElement(file, at, element))
            return true;
        if (element.isEndless)
            return false;
        if (element.end > file.size())
            return true;
    }
    return false;
}

} // namespace

bool isVideoCutShort(const std::string& path)
{
    Bytes file(path);
    switch (containerFormat(file))
    {
    case CONTAINER_RIFF:
        return isRiffCutShort(file);
    case CONTAINER_BOX:
        return isBoxCutShort(file);
    case CONTAINER_EBML:
        return isEbmlCutShort(file);
    default:
        return false;
    }
}

double announcedFrames(const FrameIndex& index, const cv::VideoCapture& capture)
{
    return index.shown ? double(index.shown) : capture.get(cv::CAP_PROP_FRAME_COUNT);
}

void checkEnd(const std::string& path, const FrameIndex& index, double announced, int frames)
{
    // One frame may be lost where an edit list begins. Without an index only AVI counts.
    const bool isCounted = index.shown > 0 || extension(path) == ".avi";
    if (isVideoCutShort(path) || (isCounted && announced > frames + 1.))
        throw InputError(cv::format("the video is cut short: %d of %.0f frames could be read", frames, announced));
}

} // namespace rsackermann_samples
