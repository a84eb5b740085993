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
@param reports receives the reports on the frames.
@param progress is called with the share of the video that is done.
Throws InputError, cv::Exception or, if a signal asks the program to end, Interrupted: then no video is there, and of
the maps those that are done. If the video turns out to be cut short the results of its frames are there. */
void correctVideo(const std::string& input, const Targets& targets, const Job& job, FrameCorrector& corrector,
                  std::vector<FrameReport>& reports, const std::function<void(double)>& progress);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_VIDEO_TASK_HPP
