// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_GYRO_FILE_HPP
#define RSACKERMANN_SAMPLES_GYRO_FILE_HPP

#include "opencv2/core.hpp"
#include "options.hpp"
#include <string>

namespace rsackermann_samples {

//! What a gyro on the camera has measured.
struct GyroRecording
{
    cv::Mat times;     //!< seconds, N x 1, CV_64F
    cv::Mat rates;     //!< rad/s about the camera's axes x (to the right), y (down) and z (ahead), N x 3, CV_64F
    bool isClockKnown; //!< it is that of the frames, by --gyro_delay

    GyroRecording() : isClockKnown(false) {}
};

/** Reads a CSV file with the columns time_s, yaw_rate_deg_s (positive to the right), pitch_rate_deg_s (down) and
roll_rate_deg_s (clockwise), or a log of Gyroflow (.gcsv), known by its first line.

Throws UsageError with line and column for whatever isn't understood, and warns with them of samples that saturate, of
gaps and of times that seem not to be in seconds.
@param program name in front of warnings. */
GyroRecording readGyro(const std::string& path, const std::string& program);

//! The options of a program that reads a gyro.
extern const char* const GYRO_KEYS;
//! The recording of --gyro, on the clock of the frames by --gyro_delay; empty without it. @param program as above.
GyroRecording readGyroOptions(const Options& options, const std::string& program);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_GYRO_FILE_HPP
