// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_PAGE_PICTURE_NAMES_HPP
#define RSACKERMANN_SAMPLES_PAGE_PICTURE_NAMES_HPP

#include <string>
#include <vector>

namespace rsackermann_samples {

//! The name, without folders, of a frame's picture beside a page. @param kind raw, overlay or corrected.
std::string pictureName(size_t frame, const std::string& kind);

//! The files of a folder whose names are those of pictures: an older page may have had more of them.
std::vector<std::string> picturesIn(const std::string& folder);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_PAGE_PICTURE_NAMES_HPP
