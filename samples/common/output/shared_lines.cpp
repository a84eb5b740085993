// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "shared_lines.hpp"
#include "files.hpp"
#include "options.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rsackermann_samples {

namespace {

off_t lengthOf(int file)
{
    struct stat status;
    return fstat(file, &status) == 0 ? status.st_size : 0;
}

// The length without a last line that has no end.
off_t lengthOfWholeLines(int file)
{
    off_t length = lengthOf(file);
    char buffer[4096];
    while (length > 0)
    {
        const off_t begin = std::max(off_t(0), length - off_t(sizeof buffer));
        const ssize_t count = pread(file, buffer, size_t(length - begin), begin);
        if (count <= 0)
            return length;
        for (ssize_t i = count; i > 0; i--)
            if (buffer[i - 1] == '\n')
                return begin + off_t(i);
        length = begin;
    }
    return length;
}

bool writeAll(int file, const std::string& text)
{
    for (size_t done = 0; done < text.size();)
    {
        const ssize_t n = write(file, text.data() + done, text.size() - done);
        if (n < 0 && errno != EINTR)
            return false;
        done += n > 0 ? size_t(n) : 0;
    }
    return true;
}

std::string contentOf(int file, off_t length)
{
    std::string content(size_t(length), '\0');
    const ssize_t n = content.empty() ? 0 : pread(file, &content[0], content.size(), 0);
    content.resize(n > 0 ? size_t(n) : 0);
    return content;
}

} // namespace

// A link stays one when its file is replaced.
SharedLines::SharedLines(const std::string& path)
    : path_(cv::utils::fs::exists(path) ? cv::utils::fs::canonical(path) : path)
{
    if (!isPipe(path_))
        return;
    // For writing alone: otherwise a pipe waits for no reader, and the lines of one that nobody reads yet are lost.
    stream_ = FileDescriptor(open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
    if (stream_.get() < 0)
        throw InputError(path_ + " can't be written: " + systemError());
}

FileDescriptor SharedLines::openLocked() const
{
    const size_t slash = path_.find_last_of('/');
    if (slash != std::string::npos && !cv::utils::fs::createDirectories(path_.substr(0, slash + 1)))
        throw InputError("the folder " + path_.substr(0, slash) + " can't be made");
    while (true)
    {
        FileDescriptor file(open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
        if (file.get() < 0)
            throw InputError(path_ + " can't be written: " + systemError());
        while (flock(file.get(), LOCK_EX) != 0 && errno == EINTR)
            ;
        // While this process waited for the lock another one may have put a new file there.
        struct stat opened, present;
        if (stat(path_.c_str(), &present) == 0 && fstat(file.get(), &opened) == 0 && opened.st_dev == present.st_dev &&
            opened.st_ino == present.st_ino)
            return file;
    }
}

void SharedLines::filter(const std::function<bool(const std::string& line)>& keep)
{
    if (stream_.get() >= 0)
        return;
    const FileDescriptor file = openLocked();
    const std::string content = contentOf(file.get(), lengthOfWholeLines(file.get()));
    std::string kept;
    for (size_t begin = 0, end; begin < content.size() && (end = content.find('\n', begin)) != std::string::npos;
         begin = end + 1)
        if (keep(content.substr(begin, end - begin)))
            kept.append(content, begin, end + 1 - begin);
    if (off_t(kept.size()) != lengthOf(file.get()))
        writeFile(path_, kept);
}

void SharedLines::append(const std::vector<std::string>& lines)
{
    std::string text;
    for (const std::string& line : lines)
        text += line + '\n';
    if (stream_.get() >= 0)
    {
        if (!writeAll(stream_.get(), text))
            throw InputError(path_ + " can't be written: " + systemError());
        return;
    }
    const FileDescriptor file = openLocked();
    const off_t length = lengthOfWholeLines(file.get());
    if (length != lengthOf(file.get()) && ftruncate(file.get(), length) != 0)
        throw InputError(path_ + " can't be written: " + systemError());
    if (writeAll(file.get(), text))
        return;
    const std::string reason = systemError();
    if (ftruncate(file.get(), length) != 0)
        throw InputError(path_ + " can't be written, and a part of a line can't be removed: " + systemError());
    throw InputError(path_ + " can't be written: " + reason);
}

} // namespace rsackermann_samples
