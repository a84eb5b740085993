// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "map_file.hpp"
#include "files.hpp"
#include "options.hpp"

#include <zlib.h>

namespace rsackermann_samples {

namespace {

// The text as a file of gzip, in pieces.
void writeCompressed(AtomicFile& file, const std::string& text)
{
    const int gzip = 16, fast = 1; // more effort makes the file smaller by 2 %
    z_stream stream = {};
    std::vector<Bytef> buffer(1 << 18);
    if (deflateInit2(&stream, fast, Z_DEFLATED, MAX_WBITS + gzip, MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY) != Z_OK)
        throw InputError(file.path() + " can't be compressed");
    const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, deflateEnd);
    const size_t piece = 1 << 20;
    for (size_t at = 0, state = Z_OK; state != Z_STREAM_END; at += piece)
    {
        const size_t count = std::min(piece, text.size() - at);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data() + at));
        stream.avail_in = uInt(count);
        do
        {
            stream.next_out = buffer.data();
            stream.avail_out = uInt(buffer.size());
            state = size_t(deflate(&stream, at + count == text.size() ? Z_FINISH : Z_NO_FLUSH));
            file.write(buffer.data(), buffer.size() - stream.avail_out);
        }
        while (stream.avail_out == 0);
    }
}

} // namespace

void writeMaps(AtomicFile& file, const cv::Mat& map1, const cv::Mat& map2)
{
    std::string name = file.path();
    // cv::FileStorage doesn't read .GZ.
    const bool compressed = name.size() > 3 && name.compare(name.size() - 3, 3, ".gz") == 0;
    if (compressed)
        name.erase(name.size() - 3);
    if (!isStorageFormat(extension(name)))
        throw InputError(file.path() + ": the extension is none of .yml, .yaml, .xml and .json, with or without .gz");
    // In memory, as cv::FileStorage doesn't report a full disk. Base64 takes a quarter of the time of decimal numbers
    // and two thirds of their room, and it is exact.
    cv::FileStorage fs(name, cv::FileStorage::WRITE_BASE64 | cv::FileStorage::MEMORY);
    fs << "map1" << map1 << "map2" << map2;
    const std::string text = fs.releaseAndGetString();
    if (compressed)
        writeCompressed(file, text);
    else
        file.write(text.data(), text.size());
}

} // namespace rsackermann_samples
