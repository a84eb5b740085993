// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_GYRO_CLOCK_HPP
#define RSACKERMANN_SAMPLES_GYRO_CLOCK_HPP

#include "frame_corrector.hpp"
#include <functional>

namespace rsackermann_samples {

//! Gives the frames of a sequence one after another, an empty image for one that can't be read; false: at its end.
typedef std::function<bool(cv::Mat& image, FrameFacts& facts)> FrameSource;

//! Whether frames must show how far the clock of the job's gyro is ahead of theirs.
bool needsGyroClock(const Job& job);

//! Seconds by which it is, as the first frames of a sequence show; 0: they don't. With it even the first one is
//! corrected by the gyro.
double gyroDelay(const Job& job, const FrameSource& read);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_GYRO_CLOCK_HPP
