// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_VIDEO_ENDS_HPP
#define RSACKERMANN_SAMPLES_VIDEO_ENDS_HPP

#include "frame_index.hpp"
#include "opencv2/videoio.hpp"
#include <string>

namespace rsackermann_samples {

/** Whether a video's file ends before the container (AVI, MP4 and MOV, Matroska and WebM) says that it does; false for
other formats.

The number of frames that OpenCV announces isn't reliable: if the container has none it is a product of duration and
rate, and wrong if the rate varies or the sound is longer than the pictures. */
bool isVideoCutShort(const std::string& path);

//! How many frames there should be; 0 or less: unknown.
double announcedFrames(const FrameIndex& index, const cv::VideoCapture& capture);

//! Throws InputError if a video of which so many frames could be read is cut short.
void checkEnd(const std::string& path, const FrameIndex& index, double announced, int frames);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_VIDEO_ENDS_HPP
