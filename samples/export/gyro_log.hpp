// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_EXPORT_GYRO_LOG_HPP
#define RSACKERMANN_SAMPLES_EXPORT_GYRO_LOG_HPP

#include "frames.hpp"

namespace rsackermann_samples {

/** A log of Gyroflow (.gcsv) with the rates of the frames at their times, in rad/s about the camera's axes x (to the
right), y (down) and z (ahead); 0 of frames without a motion. A frame that is there twice counts as it is there last.

Throws UsageError without the camera's line delay, InputError for frames of several videos, for fewer than two frames,
and if a time is unknown or that of another frame. */
std::string gyroLogText(const cv::rsackermann::RollingShutterCamera& camera, const std::vector<MotionFrame>& frames);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_EXPORT_GYRO_LOG_HPP
