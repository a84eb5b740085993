// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_LOG_USE_HPP
#define RSACKERMANN_SAMPLES_LOG_USE_HPP

#include "drive_log.hpp"
#include "gyro_file.hpp"
#include "inputs.hpp"
#include "opencv2/rsackermann/motion.hpp"

namespace rsackermann_samples {

//! The prior of a frame from its facts; values that they leave open are those of the other prior.
cv::rsackermann::MotionPrior priorOf(const FrameFacts& facts,
                                     const cv::rsackermann::MotionPrior& other = cv::rsackermann::MotionPrior());

/** Only videos know the time of their frames: a log has to name the images that it is about.
Throws UsageError if it names none of them, or two inputs by the same name without its folders, or one twice, and warns
if some are missing, and of samples whose times seem to be in another unit. */
void checkLog(const DriveLog& log, const InputList& inputs, const std::string& program);

//! Throws UsageError if a gyro is that of several videos each of which begins at 0: it can't be of more than one.
void checkGyro(const GyroRecording& gyro, const DriveLog& log, const InputList& inputs);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_LOG_USE_HPP
