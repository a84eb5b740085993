// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_IMAGE_FILE_HPP
#define RSACKERMANN_SAMPLES_IMAGE_FILE_HPP

#include "files.hpp"
#include "atomic_file.hpp"

namespace rsackermann_samples {

//! Writes an image, with metadata that the formats keep which addMetadata() knows; throws InputError.
inline void writeImage(AtomicFile& file, const cv::Mat& image, const ImageMetadata& metadata)
{
    const std::vector<uchar> bytes = encodeImage(file.path(), image, metadata);
    file.write(bytes.data(), bytes.size());
}

//! Writes an image that appears complete or not at all, in the format of the path's extension; throws InputError.
inline void writeImage(const std::string& path, const cv::Mat& image)
{
    const std::vector<uchar> bytes = encodeImage(path, image);
    writeFile(path, std::string(bytes.begin(), bytes.end()));
}

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_IMAGE_FILE_HPP
