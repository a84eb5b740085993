// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_FILES_HPP
#define RSACKERMANN_SAMPLES_FILES_HPP

#include "opencv2/core.hpp"
#include <string>
#include <vector>

namespace rsackermann_samples {

/** A file that appears complete or not at all: it is written under another name in the same folder and renamed at the end. */
class AtomicFile
{
public:
    //! Makes the file's folder where it is missing.
    explicit AtomicFile(const std::string& path);
    //! Removes what was written unless commit() was called.
    ~AtomicFile();

    //! The name to write to; it has the extension of the final name.
    const std::string& temporaryName() const { return temporary_; }
    //! Gives the file its final name.
    void commit();

private:
    AtomicFile(const AtomicFile&);
    AtomicFile& operator=(const AtomicFile&);

    std::string path_, temporary_;
    bool committed_;
};

//! Reads an image as it is stored (depth, channels, sensor rows); throws InputError where it is missing, damaged or cut short.
cv::Mat readImage(const std::string& path);

//! Writes an image of the format of the path's extension, without loss of depth or channels; throws InputError.
void writeImage(const std::string& path, const cv::Mat& image);

//! Copies a file byte by byte.
void copyFile(const std::string& from, const std::string& to);

//! Line segments from a text file with four numbers x1 y1 x2 y2 a line (N x 4, CV_32F); throws UsageError.
cv::Mat readSegments(const std::string& path);

//! The path's name without folders.
std::string fileName(const std::string& path);
//! The path's name without folders and without its extension.
std::string stem(const std::string& path);
//! The extension with its dot, in lower case; empty where there is none.
std::string extension(const std::string& path);
//! Whether both paths lead to the same existing file.
bool isSameFile(const std::string& a, const std::string& b);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_FILES_HPP
