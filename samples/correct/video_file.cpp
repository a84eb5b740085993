// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "video_file.hpp"
#include "files.hpp"
#include "options.hpp"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>

namespace rsackermann_samples {

namespace {

// Codecs that every build of FFmpeg has, and for AVI OpenCV itself.
const std::map<std::string, std::string>& codecs()
{
    static const std::map<std::string, std::string> codecs = {
        {".avi", "MJPG"},  {".mkv", "MJPG"}, {".mjpeg", "MJPG"}, {".mp4", "mp4v"},  {".m4v", "mp4v"}, {".mov", "mp4v"},
        {".webm", "VP80"}, {".wmv", "WMV2"}, {".mpg", "PIM1"},   {".mpeg", "PIM1"}, {".3gp", "mp4v"}, {".3g2", "mp4v"},
        {".ts", "PIM1"},   {".mts", "PIM1"}, {".m2ts", "PIM1"},  {".flv", "FLV1"}};
    return codecs;
}

void putNumber(std::fstream& file, std::streamoff at, uint32_t value)
{
    char bytes[4];
    for (int i = 0; i < 4; i++)
        bytes[i] = char(value >> 8 * i);
    file.seekp(at);
    file.write(bytes, 4);
}

// OpenCV's own writer rounds the rate to a whole number; its header has the rate as a fraction at a fixed place.
void setRateOfAvi(const std::string& path, double framesPerSecond)
{
    const std::streamoff INTERVAL = 32, NAME = 100, SCALE = 128, RATE = 132;
    const uint32_t scale = 100000;
    std::fstream file(path.c_str(), std::ios::in | std::ios::out | std::ios::binary);
    char name[4] = {};
    file.seekg(NAME);
    file.read(name, 4);
    if (std::string(name, 4) != "strh")
        throw InputError(path + " has no header as expected of an AVI");
    putNumber(file, INTERVAL, uint32_t(std::lround(1e6 / framesPerSecond)));
    putNumber(file, SCALE, scale);
    putNumber(file, RATE, uint32_t(std::lround(framesPerSecond * scale)));
}

} // namespace

VideoFile::VideoFile(const std::string& path, double framesPerSecond, const cv::Size& size)
    : path_(path), size_(size), framesPerSecond_(framesPerSecond), isOdd_(size.width % 2 || size.height % 2),
      frames_(0), file_(path)
{
    const std::map<std::string, std::string>::const_iterator it = codecs().find(extension(path));
    if (it == codecs().end())
        throw InputError(path + ": the extension is none of a video that can be written, as .mp4 and .avi are");
    const std::string& c = it->second;
    // With FFmpeg OpenCV leaves out the last column or row of an odd size, whatever the codec; its own writer doesn't.
    if (isOdd_ && it->first != ".avi")
        throw InputError(path + cv::format(": %d x %d pixels are an odd size, of which %s in %s would lose a column or "
                                           "row; MJPG in .avi keeps it",
                                           size.width, size.height, c.c_str(), it->first.c_str()));
    if (!writer_.open(file_.temporaryName(), isOdd_ ? cv::CAP_OPENCV_MJPEG : cv::CAP_ANY,
                      cv::VideoWriter::fourcc(c[0], c[1], c[2], c[3]), framesPerSecond, size))
        throw InputError(path + ": the video can't be written");
}

void VideoFile::add(const cv::Mat& frame)
{
    // A writer leaves out frames that don't fit and says nothing.
    if (frame.size() != size_)
        throw InputError(path_ + ": the size of the frames changes");
    writer_.write(frame);
    frames_++;
}

void VideoFile::close()
{
    writer_.release();
    if (isOdd_)
        setRateOfAvi(file_.temporaryName(), framesPerSecond_);
    cv::VideoCapture written(file_.temporaryName());
    int frames = 0;
    while (written.isOpened() && written.grab())
        frames++;
    const cv::Size size(int(written.get(cv::CAP_PROP_FRAME_WIDTH)), int(written.get(cv::CAP_PROP_FRAME_HEIGHT)));
    if (frames != frames_)
        throw InputError(path_ + cv::format(" can't be written: %d of %d frames can be read again", frames, frames_));
    if (size != size_)
        throw InputError(path_ + cv::format(" can't be written: of %d x %d pixels the codec keeps %d x %d", size_.width,
                                            size_.height, size.width, size.height));
}

} // namespace rsackermann_samples
