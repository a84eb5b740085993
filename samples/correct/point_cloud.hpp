// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_POINT_CLOUD_HPP
#define RSACKERMANN_SAMPLES_POINT_CLOUD_HPP

#include "opencv2/core.hpp"
#include <string>

namespace rsackermann_samples {

/** Points from a CSV table whose header has x, y and z (N x 3, CV_64F; nan is kept). Throws InputError with the line
that isn't understood, and if the table is one of several images: if it has a column file with other names than one. */
cv::Mat readPointCloud(const std::string& path);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_POINT_CLOUD_HPP
