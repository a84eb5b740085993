// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_MAP_FILE_HPP
#define RSACKERMANN_SAMPLES_MAP_FILE_HPP

#include "opencv2/core.hpp"
#include "output/atomic_file.hpp"

namespace rsackermann_samples {

/** Writes maps for cv::remap in the format of cv::FileStorage that the name's extension stands for (.yml, .xml or
.json, each also with .gz), with the nodes map1 and map2; throws InputError. */
void writeMaps(AtomicFile& file, const cv::Mat& map1, const cv::Mat& map2);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_MAP_FILE_HPP
