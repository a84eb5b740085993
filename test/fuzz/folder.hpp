// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_TEST_FUZZ_FOLDER_HPP
#define RSACKERMANN_TEST_FUZZ_FOLDER_HPP

#include <string>

namespace fuzz {

//! Makes an empty temporary folder the present one, so that the fuzzer needs absolute paths; it goes when the process
//! ends.
class Folder
{
public:
    Folder();
    ~Folder();

    //! Writes a file in the folder.
    void write(const std::string& name, const std::string& content) const;
    //! Removes all files.
    void clear() const;

private:
    std::string path_;
};

} // namespace fuzz

#endif // RSACKERMANN_TEST_FUZZ_FOLDER_HPP
