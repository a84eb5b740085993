// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_SHARED_LINES_HPP
#define RSACKERMANN_SAMPLES_SHARED_LINES_HPP

#include "atomic_file.hpp"
#include <functional>

namespace rsackermann_samples {

/** A text file to which several processes append lines.

Lines that are appended together stay together, and they are there for others, and after the process is killed, when
append() returns. A last line without its end was left by a process that was killed while it wrote; it is removed. A
pipe or a device just gets the lines.
*/
class SharedLines
{
public:
    explicit SharedLines(const std::string& path);

    /** Keeps some of the lines, makes the file if it is missing; throws InputError.
    @param keep is asked of each line, in order; may throw, and then the file stays as it is. */
    void filter(const std::function<bool(const std::string& line)>& keep);

    //! Appends lines; throws InputError, and then none of them is there.
    void append(const std::vector<std::string>& lines);

private:
    FileDescriptor openLocked() const;

    std::string path_;
    FileDescriptor stream_; // a pipe or a device, open from the beginning: to a reader closing it is the end
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_SHARED_LINES_HPP
