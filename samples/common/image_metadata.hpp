// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_IMAGE_METADATA_HPP
#define RSACKERMANN_SAMPLES_IMAGE_METADATA_HPP

#include "opencv2/core.hpp"
#include <vector>

namespace rsackermann_samples {

//! What an image's file has beside its pixels.
struct ImageMetadata
{
    std::vector<uchar> exif;    //!< from the byte order mark on
    std::vector<uchar> profile; //!< the segments of a JPEG or the chunk of a PNG file with the colour profile (ICC)
    bool isGrey = false;        //!< so is the profile
};

//! The metadata of a JPEG or PNG file; none if the format is another one.
ImageMetadata metadataOf(const std::vector<uchar>& file);

/** Puts metadata into a JPEG or PNG file that has none: Exif data, and a profile of the same format and kind of
colours. Files of other formats: nothing is done. */
void addMetadata(std::vector<uchar>& file, const ImageMetadata& metadata, bool isGrey);

//! Whether a JPEG or TIFF file has the four colours of printers.
bool isCmyk(const std::vector<uchar>& file);

//! Whether it is that of a PNG or JPEG image without its end; false for every other format.
bool isCutShort(const std::vector<uchar>& file);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_IMAGE_METADATA_HPP
