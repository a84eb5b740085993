// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "atomic_file.hpp"
#include "files.hpp"
#include "options.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rsackermann_samples {

namespace {

const char* const PREFIX = ".rsackermann-";

// All of a compound extension, since cv::FileStorage takes the format from it.
std::string extensionsOf(const std::string& name)
{
    const std::string last = extension(name);
    return last == ".gz" ? extension(name.substr(0, name.size() - last.size())) + last : last;
}

// Whether a name still belongs to an open file.
bool isNameOf(const std::string& path, int file)
{
    struct stat a, b;
    return lstat(path.c_str(), &a) == 0 && fstat(file, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

// Permissions of a file; -1: there is none.
int modeOf(const std::string& path)
{
    struct stat status;
    return stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) ? int(status.st_mode & 0777) : -1;
}

// A new file with a lock; nothing if its name was taken or someone has taken it for a leftover before it was locked.
FileDescriptor createLocked(const std::string& path, mode_t mode)
{
    FileDescriptor file(open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode));
    // File systems without locks never have leftovers removed.
    if (file.get() >= 0 && flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    {
        errno = 0;
        return FileDescriptor();
    }
    return file.get() >= 0 && isNameOf(path, file.get()) ? std::move(file) : FileDescriptor();
}

} // namespace

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept
{
    std::swap(number_, other.number_);
    return *this;
}

void FileDescriptor::close()
{
    if (number_ >= 0)
        ::close(number_);
    number_ = -1;
}

AtomicFile::AtomicFile(const std::string& path) : path_(path), mode_(modeOf(path)), committed_(false)
{
    static std::atomic<unsigned> counter(0);
    const std::string name = fileName(path), folder = path.substr(0, path.size() - name.size());
    if (!folder.empty() && !cv::utils::fs::createDirectories(folder))
        throw InputError("the folder " + folder + " can't be made");
    // Some folders exist in which no file can be made, and say ENOENT (/proc).
    const int mostAttempts = 10000;
    for (int i = 0; i < mostAttempts; i++)
    {
        temporary_ = folder + PREFIX + cv::format("%d-%u", int(getpid()), counter++) + extensionsOf(name);
        errno = 0;
        // Others mustn't read meanwhile what they mustn't read at the end, and it has to be written.
        file_ = createLocked(temporary_, mode_ < 0 ? 0666 : mode_t(mode_) | S_IRUSR | S_IWUSR);
        const bool isWorthAnother = errno == EEXIST || errno == 0 || errno == ENOENT;
        if (file_.get() >= 0 || !isWorthAnother || !cv::utils::fs::exists(folder.empty() ? "." : folder))
            break;
    }
    if (file_.get() < 0)
        throw InputError(path_ + " can't be written: " + systemError());
}

AtomicFile::~AtomicFile()
{
    if (!committed_)
        std::remove(temporary_.c_str());
}

void AtomicFile::write(const void* bytes, size_t count)
{
    const char* next = static_cast<const char*>(bytes);
    while (count > 0)
    {
        const ssize_t n = ::write(file_.get(), next, count);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            throw InputError(path_ + " can't be written: " + systemError());
        next += n;
        count -= size_t(n);
    }
}

void AtomicFile::commit()
{
    if (mode_ >= 0) // some file systems have none, and say that they can't be changed
        (void)!fchmod(file_.get(), mode_t(mode_));
    // Data that have not reached the disk can be lost after the program has said that all is done.
    if (fsync(file_.get()) != 0 && errno != EINVAL && errno != EROFS)
        throw InputError(path_ + " can't be written: " + systemError());
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0)
        throw InputError(path_ + " can't be written: " + systemError());
    committed_ = true;
    file_.close();
}

AtomicFile& AtomicFiles::add(const std::string& path)
{
    files_.emplace_back(new AtomicFile(path));
    return *files_.back();
}

// Names that are replaced are kept as links until all files have theirs.
void AtomicFiles::commit()
{
    std::vector<std::pair<std::string, std::string>> done; // name, and the link to what it was; empty: it was none
    try
    {
        for (const std::unique_ptr<AtomicFile>& file : files_)
        {
            const std::string kept = file->temporaryName() + ".kept";
            const bool isKept = link(file->path().c_str(), kept.c_str()) == 0;
            const bool isNew = !isKept && errno == ENOENT;
            if (isKept || isNew)
                done.push_back(std::make_pair(file->path(), isKept ? kept : ""));
            file->commit();
        }
    }
    catch (const InputError&)
    {
        for (const std::pair<std::string, std::string>& name : done)
        {
            if (name.second.empty())
                std::remove(name.first.c_str());
            else
                std::rename(name.second.c_str(), name.first.c_str());
            std::remove(name.second.c_str()); // still there if both were names of one file
        }
        files_.clear();
        throw;
    }
    for (const std::pair<std::string, std::string>& name : done)
        if (!name.second.empty())
            std::remove(name.second.c_str());
}

void writeFile(const std::string& path, const std::string& content)
{
    AtomicFile file(path);
    file.write(content.data(), content.size());
    file.commit();
}

bool isTemporaryName(const std::string& name)
{
    return name.compare(0, std::strlen(PREFIX), PREFIX) == 0;
}

void removeLeftovers(const std::string& folder)
{
    DIR* dir = opendir(folder.c_str());
    if (!dir)
        return;
    while (const dirent* entry = readdir(dir))
    {
        const std::string path = folder + "/" + entry->d_name;
        if (!isTemporaryName(entry->d_name))
            continue;
        const FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
        if (file.get() >= 0 && flock(file.get(), LOCK_EX | LOCK_NB) == 0 && isNameOf(path, file.get()))
            std::remove(path.c_str());
    }
    closedir(dir);
}

std::string systemError()
{
    return std::strerror(errno);
}

} // namespace rsackermann_samples
