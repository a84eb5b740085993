// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_ATOMIC_FILE_HPP
#define RSACKERMANN_SAMPLES_ATOMIC_FILE_HPP

#include <memory>
#include <string>
#include <vector>

namespace rsackermann_samples {

//! Closes a file when it is destroyed.
class FileDescriptor
{
public:
    explicit FileDescriptor(int number = -1) : number_(number) {}
    ~FileDescriptor() { close(); }
    FileDescriptor(FileDescriptor&& other) noexcept : number_(other.number_) { other.number_ = -1; }
    FileDescriptor& operator=(FileDescriptor&& other) noexcept;
    int get() const { return number_; }
    void close();

private:
    FileDescriptor(const FileDescriptor&);
    FileDescriptor& operator=(const FileDescriptor&);

    int number_;
};

/** A file that appears complete or not at all: it is written under another name in the same folder and renamed at the
end. It has the permissions of a file that it replaces.

Until then it is locked: a temporary file without a lock was left behind by a process that was killed.
*/
class AtomicFile
{
public:
    //! Makes the file's folder if it is missing; throws InputError.
    explicit AtomicFile(const std::string& path);
    //! Removes the file unless commit() was called.
    ~AtomicFile();

    const std::string& path() const { return path_; }
    //! The name to write to; it has the extension of the final name.
    const std::string& temporaryName() const { return temporary_; }
    //! Writes bytes behind those that are there; throws InputError, for instance if the disk is full.
    void write(const void* bytes, size_t count);
    //! Gives the file its final name once all of it has reached the disk; throws InputError.
    void commit();

private:
    AtomicFile(const AtomicFile&);
    AtomicFile& operator=(const AtomicFile&);

    std::string path_, temporary_;
    FileDescriptor file_;
    int mode_; // permissions of the file that is replaced; -1: there is none
    bool committed_;
};

//! Files that appear together, at the end, in the order in which they were added; none of them if one can't be written.
class AtomicFiles
{
public:
    AtomicFile& add(const std::string& path);
    void commit();

private:
    std::vector<std::unique_ptr<AtomicFile>> files_;
};

//! Writes a file that appears complete or not at all; throws InputError.
void writeFile(const std::string& path, const std::string& content);

//! Whether a file's name without folders is one that AtomicFile gives.
bool isTemporaryName(const std::string& name);

//! Removes the temporary files in a folder that no process writes any more.
void removeLeftovers(const std::string& folder);

//! The reason why the last system call has failed.
std::string systemError();

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_ATOMIC_FILE_HPP
