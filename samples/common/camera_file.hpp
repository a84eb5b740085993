// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_CAMERA_FILE_HPP
#define RSACKERMANN_SAMPLES_CAMERA_FILE_HPP

#include "camera_settings.hpp"

namespace rsackermann_samples {

/** Reads a camera file.

Known are OpenCV's calibration files (YAML, XML or JSON of cv::FileStorage), camera_info files of ROS, camchain files
of Kalibr (the first camera, cam0) and lens profiles of Gyroflow. All but the latter may have these keys besides:
line_delay or readout (seconds), scan, reference, roll, pitch, heading (degrees), camera_height (metres), and the
standard deviations roll_sigma, pitch_sigma, heading_sigma (degrees), line_delay_sigma (seconds) and focal_sigma
(pixels). Throws UsageError that names the fault.
*/
void readCameraFile(const std::string& path, CameraSettings& settings);

//! The text of a camera file that readCameraFile() reads, of OpenCV.
//! @param format an extension that isStorageFormat() knows.
std::string cameraText(const CameraSettings& settings, const std::string& format = ".yml");

//! Writes a camera file that readCameraFile() reads, of OpenCV, in the format of the path's extension.
void writeCameraFile(const std::string& path, const CameraSettings& settings);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_CAMERA_FILE_HPP
