// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_IMAGE_ENDS_HPP
#define RSACKERMANN_SAMPLES_IMAGE_ENDS_HPP

#include "opencv2/core.hpp"
#include <vector>

namespace rsackermann_samples {

//! Whether the bytes are those of a PNG or JPEG image without its end; false for every other format.
bool isCutShort(const std::vector<uchar>& bytes);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_IMAGE_ENDS_HPP
