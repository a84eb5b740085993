// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_IMAGE_METADATA_HPP
#define RSACKERMANN_SAMPLES_IMAGE_METADATA_HPP

#include "opencv2/core.hpp"
#include <vector>

namespace rsackermann_samples {

//! The Exif data of a JPEG or PNG file, from the byte order mark on; empty if there are none or the format is another
//! one.
std::vector<uchar> exifOf(const std::vector<uchar>& file);

//! Puts Exif data into a JPEG or PNG file that has none. Files of other formats and empty data: nothing is done.
void addExif(std::vector<uchar>& file, const std::vector<uchar>& exif);

//! Whether a JPEG or TIFF file has the four colours of printers.
bool isCmyk(const std::vector<uchar>& file);

//! Whether it is that of a PNG or JPEG image without its end; false for every other format.
bool isCutShort(const std::vector<uchar>& file);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_IMAGE_METADATA_HPP
