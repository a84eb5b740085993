// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_FILES_HPP
#define RSACKERMANN_SAMPLES_FILES_HPP

#include "image_metadata.hpp"
#include "opencv2/core.hpp"
#include "options.hpp"
#include <fstream>
#include <string>
#include <vector>

namespace rsackermann_samples {

/** Reads an image of 8 or 16 bits as it is stored (depth, channels, sensor rows). Throws InputError if it is missing,
damaged, cut short, larger than cv::remap takes or of another kind.
@param metadata receives what the file has besides, see metadataOf(). */
cv::Mat readImage(const std::string& path, ImageMetadata* metadata = nullptr);

/** The bytes of an image file, without loss of depth or channels; throws InputError.
@param path its extension stands for the format.
@param metadata which the formats keep that addMetadata() knows. */
std::vector<uchar> encodeImage(const std::string& path, const cv::Mat& image,
                               const ImageMetadata& metadata = ImageMetadata());

//! Whether a name is that of a pipe or a device: it can't be read at any place, and more than once, as files can.
bool isPipe(const std::string& path);
//! What is wrong with it.
extern const char* const PIPE;

//! The bytes of a file; throws InputError.
std::vector<uchar> readBytes(const std::string& path);

//! What read(path) returns; the message of an InputError begins with the path.
template <class Read>
auto namingFile(const std::string& path, const Read& read) -> decltype(read(path))
{
    try
    {
        return read(path);
    }
    catch (const InputError& e)
    {
        throw InputError(path + ": " + e.what());
    }
}

/** Opens a text behind the mark of UTF-8 that some editors put before it.
@return a stream that has failed if the file is missing, a folder or can't be read. */
std::ifstream openText(const std::string& path);

//! Line segments from a text file with four numbers x1 y1 x2 y2 a line (N x 4, CV_32F); throws UsageError.
cv::Mat readSegments(const std::string& path);

//! The path's name without folders.
std::string fileName(const std::string& path);
//! The path's name without folders and without its extension.
std::string stem(const std::string& path);
//! The extension with its dot, in lower case; empty if there is none.
std::string extension(const std::string& path);
//! Whether an extension, in lower case, is that of a format of cv::FileStorage.
bool isStorageFormat(const std::string& extension);
//! Whether a file is a video, by the extension of its name.
bool isVideo(const std::string& path);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_FILES_HPP
