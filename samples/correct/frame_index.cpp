// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "frame_index.hpp"
#include "container_bytes.hpp"

#include <algorithm>
#include <functional>

namespace rsackermann_samples {

namespace {

const size_t MOST_FRAMES = 10000000; // a damaged index may announce more

typedef std::vector<ContainerPart> Parts;

Parts boxesIn(Bytes& file, uint64_t begin, uint64_t end)
{
    Parts parts;
    ContainerPart box = ContainerPart();
    for (uint64_t at = begin; at < end && readBox(file, at, box) && box.end <= end; at = box.end)
        parts.push_back(box);
    return parts;
}

uint64_t nameOf(const char* name)
{
    return bigEndian(reinterpret_cast<const uchar*>(name), 4);
}

// The boxes of that name in those that are nested like this.
Parts boxesAt(Bytes& file, const Parts& boxes, const std::vector<const char*>& path)
{
    Parts found;
    for (const ContainerPart& box : boxes)
    {
        if (box.name != nameOf(path[0]))
            continue;
        if (path.size() == 1)
        {
            found.push_back(box);
            continue;
        }
        const Parts inner =
            boxesAt(file, boxesIn(file, box.begin, box.end), std::vector<const char*>(path.begin() + 1, path.end()));
        found.insert(found.end(), inner.begin(), inner.end());
    }
    return found;
}

// Numbers of a box, one after the other; 0 behind its end.
class BoxReader
{
public:
    BoxReader(Bytes& file, const ContainerPart& box)
        : at_(0), content_(size_t(std::min(box.end, file.size()) - box.begin))
    {
        if (!content_.empty() && !file.read(box.begin, content_.data(), content_.size()))
            content_.clear();
    }

    bool isAtEnd() const { return at_ >= content_.size(); }

    uint64_t number(int bytes)
    {
        const size_t at = at_;
        at_ += size_t(bytes);
        return at_ <= content_.size() ? bigEndian(content_.data() + at, bytes) : 0;
    }

    int64_t signedNumber(int bytes)
    {
        const uint64_t value = number(bytes);
        return bytes == 4 ? int64_t(int32_t(uint32_t(value))) : int64_t(value);
    }

    void skip(int bytes) { at_ += size_t(bytes); }

private:
    size_t at_;
    std::vector<uchar> content_;
};

// Part of an edit list: which part of the track is shown.
struct Edit
{
    double duration; // seconds; 0: to the end
    double begin;    // in units of the track's time; -1: nothing is shown
};

struct Track
{
    uint32_t id;
    double unit; // seconds of one unit of the track's time
    std::vector<Edit> edits;
    std::vector<double> times; // of the frames, whole numbers: damaged ones can't overflow
};

double timeUnit(Bytes& file, const ContainerPart& header)
{
    BoxReader reader(file, header);
    const int bytes = reader.number(1) == 1 ? 8 : 4;
    reader.skip(3 + 2 * bytes);
    const uint64_t scale = reader.number(4);
    return scale > 0 ? 1. / double(scale) : 0;
}

std::vector<Edit> editsOf(Bytes& file, const Parts& lists, double unit)
{
    std::vector<Edit> edits;
    for (const ContainerPart& list : lists)
    {
        BoxReader reader(file, list);
        const int bytes = reader.number(1) == 1 ? 8 : 4;
        reader.skip(3);
        for (uint64_t left = reader.number(4); left > 0 && !reader.isAtEnd(); left--)
        {
            Edit edit;
            edit.duration = double(reader.number(bytes)) * unit;
            edit.begin = double(reader.signedNumber(bytes));
            reader.skip(4); // rate
            edits.push_back(edit);
        }
    }
    return edits;
}

// The frames that the index of the whole file lists.
bool addIndexed(Bytes& file, const Parts& trak, Track& track)
{
    for (const ContainerPart& box : boxesAt(file, trak, {"mdia", "minf", "stbl", "stts"}))
    {
        BoxReader reader(file, box);
        reader.skip(8);
        for (double time = 0; !reader.isAtEnd();)
        {
            const uint64_t count = reader.number(4), step = reader.number(4);
            if (count > MOST_FRAMES - std::min(track.times.size(), MOST_FRAMES))
                return false;
            for (uint64_t i = 0; i < count; i++, time += double(step))
                track.times.push_back(time);
        }
    }
    for (const ContainerPart& box : boxesAt(file, trak, {"mdia", "minf", "stbl", "ctts"}))
    {
        BoxReader reader(file, box);
        reader.skip(8);
        for (size_t at = 0; at < track.times.size() && !reader.isAtEnd();)
        {
            uint64_t count = reader.number(4);
            const double offset = double(reader.signedNumber(4));
            for (; count > 0 && at < track.times.size(); count--)
                track.times[at++] += offset;
        }
    }
    return true;
}

uint64_t defaultDuration(Bytes& file, const Parts& defaults, uint32_t track)
{
    for (const ContainerPart& box : defaults)
    {
        BoxReader reader(file, box);
        reader.skip(4);
        const bool isIt = reader.number(4) == track;
        reader.skip(4);
        if (isIt)
            return reader.number(4);
    }
    return 0;
}

// The frames of a fragment, whose parts without a time of their own go on after those before.
bool addFragment(Bytes& file, const Parts& parts, uint64_t duration, Track& track, double& time)
{
    for (const ContainerPart& box : boxesAt(file, parts, {"tfhd"}))
    {
        BoxReader reader(file, box);
        const uint64_t flags = reader.number(4);
        if (reader.number(4) != track.id)
            return true; // sound
        reader.skip((flags & 1 ? 8 : 0) + (flags & 2 ? 4 : 0));
        if (flags & 8)
            duration = reader.number(4);
    }
    for (const ContainerPart& box : boxesAt(file, parts, {"tfdt"}))
    {
        BoxReader reader(file, box);
        const int bytes = reader.number(1) == 1 ? 8 : 4;
        reader.skip(3);
        time = double(reader.number(bytes));
    }
    for (const ContainerPart& box : boxesAt(file, parts, {"trun"}))
    {
        BoxReader reader(file, box);
        const uint64_t flags = reader.number(4), count = reader.number(4);
        if (count > MOST_FRAMES - std::min(track.times.size(), MOST_FRAMES))
            return false;
        reader.skip((flags & 1 ? 4 : 0) + (flags & 4 ? 4 : 0));
        for (uint64_t i = 0; i < count; i++)
        {
            const uint64_t step = flags & 0x100 ? reader.number(4) : duration;
            reader.skip((flags & 0x200 ? 4 : 0) + (flags & 0x400 ? 4 : 0));
            track.times.push_back(time + (flags & 0x800 ? double(reader.signedNumber(4)) : 0));
            time += double(step);
        }
    }
    return true;
}

// The first track with pictures, as OpenCV takes it; false if there is none whose frames are known.
bool readTrack(Bytes& file, const Parts& boxes, Track& track)
{
    const Parts movies = boxesAt(file, boxes, {"moov", "mvhd"});
    for (const ContainerPart& box : boxesAt(file, boxes, {"moov", "trak"}))
    {
        const Parts trak = boxesIn(file, box.begin, box.end), handlers = boxesAt(file, trak, {"mdia", "hdlr"}),
                    headers = boxesAt(file, trak, {"mdia", "mdhd"}), names = boxesAt(file, trak, {"tkhd"});
        if (handlers.empty() || headers.empty() || names.empty() || movies.empty())
            continue;
        BoxReader handler(file, handlers[0]), name(file, names[0]);
        handler.skip(8);
        if (handler.number(4) != nameOf("vide"))
            continue;
        const int bytes = name.number(1) == 1 ? 8 : 4;
        name.skip(3 + 2 * bytes);
        track.id = uint32_t(name.number(4));
        track.unit = timeUnit(file, headers[0]);
        track.edits = editsOf(file, boxesAt(file, trak, {"edts", "elst"}), timeUnit(file, movies[0]));
        if (!addIndexed(file, trak, track))
            return false;
        const uint64_t duration = defaultDuration(file, boxesAt(file, boxes, {"moov", "mvex", "trex"}), track.id);
        double time = 0;
        for (const ContainerPart& moof : boxesAt(file, boxes, {"moof", "traf"}))
            if (!addFragment(file, boxesIn(file, moof.begin, moof.end), duration, track, time))
                return false;
        return track.unit > 0 && !track.times.empty();
    }
    return false;
}

// An edit shows the frames from its begin on. Those after the last one's end are in the list, as decoders give them.
FrameIndex shownFrames(const Track& track)
{
    std::vector<double> sorted = track.times;
    std::sort(sorted.begin(), sorted.end());
    FrameIndex index = FrameIndex();
    std::vector<Edit> edits;
    for (const Edit& edit : track.edits)
        if (edit.begin >= 0)
            edits.push_back(edit);
    if (edits.empty())
        edits.push_back(Edit{0, sorted[0]});
    double passed = 0;
    for (size_t k = 0; k < edits.size(); k++)
    {
        const Edit& edit = edits[k];
        const std::vector<double>::const_iterator first = std::lower_bound(sorted.begin(), sorted.end(), edit.begin);
        for (std::vector<double>::const_iterator it = first; it != sorted.end(); ++it)
        {
            const double time = (*it - edit.begin) * track.unit;
            const bool isShown = edit.duration <= 0 || time < edit.duration - 0.5 * track.unit;
            if (!isShown && k + 1 < edits.size())
                break;
            index.times.push_back(passed + time);
            index.shown += isShown ? 1 : 0;
        }
        if (index.times.size() > MOST_FRAMES)
            return FrameIndex();
        passed += edit.duration;
    }
    return index;
}

FrameIndex readBoxIndex(Bytes& file)
{
    Track track = Track();
    return readTrack(file, boxesIn(file, 0, file.size()), track) ? shownFrames(track) : FrameIndex();
}

void forElements(Bytes& file, uint64_t begin, uint64_t end, const std::function<void(const ContainerPart&)>& use)
{
    ContainerPart element = ContainerPart();
    for (uint64_t at = begin; at < end && readElement(file, at, element); at = element.end)
        use(element);
}

uint64_t numberOf(Bytes& file, const ContainerPart& element)
{
    uchar bytes[8];
    const uint64_t count = element.end - element.begin;
    return count <= 8 && file.read(element.begin, bytes, size_t(count)) ? bigEndian(bytes, int(count)) : 0;
}

// Matroska: blocks in clusters, whose times are relative to those of the clusters.
FrameIndex readEbmlIndex(Bytes& file)
{
    const uint64_t SEGMENT = 0x18538067, INFO = 0x1549A966, SCALE = 0x2AD7B1, TRACKS = 0x1654AE6B, ENTRY = 0xAE,
                   NUMBER = 0xD7, TYPE = 0x83, VIDEO = 1, CLUSTER = 0x1F43B675, TIME = 0xE7, BLOCK = 0xA3, GROUP = 0xA0,
                   BLOCK_OF_GROUP = 0xA1;
    uint64_t scale = 1000000, video = 0;
    bool isKnown = true;
    std::vector<double> times;
    const auto addBlock = [&](const ContainerPart& block, double time) {
        // The track's number is written as a size is: in one byte up to 126.
        uchar bytes[3];
        if (file.read(block.begin, bytes, 3) && bytes[0] == (0x80 | video))
            times.push_back(time + int16_t(uint16_t(bigEndian(bytes + 1, 2))));
    };
    const auto readCluster = [&](const ContainerPart& cluster) {
        double time = 0;
        isKnown = isKnown && !cluster.isEndless;
        forElements(file, cluster.begin, std::min(cluster.end, file.size()), [&](const ContainerPart& e) {
            if (e.name == TIME)
                time = double(numberOf(file, e));
            else if (e.name == BLOCK)
                addBlock(e, time);
            else if (e.name == GROUP)
                forElements(file, e.begin, e.end, [&](const ContainerPart& inner) {
                    if (inner.name == BLOCK_OF_GROUP)
                        addBlock(inner, time);
                });
        });
    };
    const auto readEntry = [&](const ContainerPart& entry) {
        uint64_t number = 0, type = 0;
        forElements(file, entry.begin, entry.end, [&](const ContainerPart& e) {
            number = e.name == NUMBER ? numberOf(file, e) : number;
            type = e.name == TYPE ? numberOf(file, e) : type;
        });
        video = type == VIDEO && video == 0 ? number : video;
    };
    forElements(file, 0, file.size(), [&](const ContainerPart& segment) {
        if (segment.name != SEGMENT)
            return;
        forElements(file, segment.begin, std::min(segment.end, file.size()), [&](const ContainerPart& part) {
            if (part.name == CLUSTER)
                readCluster(part);
            else if (part.name == INFO || part.name == TRACKS)
                forElements(file, part.begin, part.end, [&](const ContainerPart& e) {
                    if (part.name == INFO && e.name == SCALE)
                        scale = numberOf(file, e);
                    else if (part.name == TRACKS && e.name == ENTRY)
                        readEntry(e);
                });
        });
    });
    FrameIndex index = FrameIndex();
    if (!isKnown)
        return index;
    for (double time : times)
        index.times.push_back(time * double(scale) * 1e-9);
    std::sort(index.times.begin(), index.times.end());
    return index; // of a cut video some can't be decoded, so that no number is known
}

} // namespace

FrameIndex readFrameIndex(const std::string& path)
{
    Bytes file(path);
    FrameIndex index = FrameIndex();
    switch (containerFormat(file))
    {
    case CONTAINER_BOX:
        index = readBoxIndex(file);
        break;
    case CONTAINER_EBML:
        index = readEbmlIndex(file);
        break;
    default:
        break;
    }
    for (size_t i = index.times.size(); i-- > 0;)
        index.times[i] -= index.times[0];
    return index;
}

} // namespace rsackermann_samples
