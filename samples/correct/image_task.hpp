// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_IMAGE_TASK_HPP
#define RSACKERMANN_SAMPLES_IMAGE_TASK_HPP

#include "frame_corrector.hpp"
#include "targets.hpp"

namespace rsackermann_samples {

/** Corrects the image of a file and writes its results.
@param depthFile empty: none is given.
@return its line of the report. Throws InputError or cv::Exception, and then no result is there. */
FrameReport correctImage(const std::string& input, const Targets& targets, const NextFrame& next,
                         const std::string& depthFile, FrameCorrector& corrector);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_IMAGE_TASK_HPP
