// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_IMAGE_TIMES_HPP
#define RSACKERMANN_SAMPLES_IMAGE_TIMES_HPP

#include "drive_log.hpp"
#include "inputs.hpp"

namespace rsackermann_samples {

/** Times of the images of a sequence whose rows a log lacks: evenly between those of the nearest images with times
before and after, and as far apart beyond the first and the last one. NaN: of other inputs, and where those times are
of no sequence. */
std::vector<double> missingTimes(const std::vector<Input>& inputs, const DriveLog& log);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_IMAGE_TIMES_HPP
