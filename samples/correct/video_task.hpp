// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_VIDEO_TASK_HPP
#define RSACKERMANN_SAMPLES_VIDEO_TASK_HPP

#include "frame_corrector.hpp"
#include "targets.hpp"
#include <functional>

namespace rsackermann_samples {

/** Corrects the frames of a video and writes the results as videos, in the format of their names' extensions.
@param log what is known of the frames besides.
@param progress is called with the share of the video that is done.
@param lines receives the lines for the report, one a frame.
Throws InputError or cv::Exception. Where the video turns out to be cut short the results of its frames are there. */
void correctVideo(const std::string& input, const Targets& targets, const DriveLog& log, FrameCorrector& corrector, std::vector<std::string>& lines,
                  const std::function<void(double)>& progress);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_VIDEO_TASK_HPP
