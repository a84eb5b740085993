// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_NPY_FILE_HPP
#define RSACKERMANN_SAMPLES_NPY_FILE_HPP

#include "opencv2/core.hpp"
#include <vector>

namespace rsackermann_samples {

//! A matrix of two dimensions from the bytes of a .npy file: numbers of 16 bits without a sign (CV_16U), or floats of
//! 32 or 64 bits (CV_32F, CV_64F), rows first. Throws InputError for others and for damaged files.
cv::Mat decodeNpy(const std::vector<uchar>& bytes);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_NPY_FILE_HPP
