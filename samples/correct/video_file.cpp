// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "video_file.hpp"
#include "files.hpp"
#include "options.hpp"

#include <map>

namespace rsackermann_samples {

VideoFile::VideoFile(const std::string& path, double framesPerSecond, const cv::Size& size)
    : path_(path), size_(size), frames_(0), file_(path)
{
    // Codecs that every build of FFmpeg has, and for AVI OpenCV itself.
    static const std::map<std::string, std::string> codecs = {
        {".avi", "MJPG"}, {".mkv", "MJPG"},  {".mjpeg", "MJPG"}, {".mp4", "mp4v"}, {".m4v", "mp4v"},
        {".mov", "mp4v"}, {".webm", "VP80"}, {".wmv", "WMV2"},   {".mpg", "PIM1"}, {".mpeg", "PIM1"}};
    const std::map<std::string, std::string>::const_iterator it = codecs.find(extension(path));
    if (it == codecs.end())
        throw InputError(path + ": the extension is none of a video");
    const std::string& c = it->second;
    if (!writer_.open(file_.temporaryName(), cv::VideoWriter::fourcc(c[0], c[1], c[2], c[3]), framesPerSecond, size))
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
    cv::VideoCapture written(file_.temporaryName());
    int frames = 0;
    while (written.isOpened() && written.grab())
        frames++;
    if (frames != frames_)
        throw InputError(path_ + cv::format(" can't be written: %d of %d frames can be read again", frames, frames_));
}

} // namespace rsackermann_samples
