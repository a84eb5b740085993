// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_CAMERA_OF_REPORT_HPP
#define RSACKERMANN_SAMPLES_CAMERA_OF_REPORT_HPP

#include "opencv2/rsackermann/camera.hpp"
#include <nlohmann/json.hpp>
#include <string>

namespace rsackermann_samples {

//! What maps, points and poses need of a camera, but for size, roll and pitch: lines of reports have these themselves.
nlohmann::ordered_json cameraForReport(const cv::rsackermann::RollingShutterCamera& camera);

//! The camera of such a node, level; throws InputError, or an exception of JSON.
cv::rsackermann::RollingShutterCamera cameraOfReport(const nlohmann::json& node, const cv::Size& size,
                                                     const std::string& source);

//! The name of the first value in which two cameras differ, of those in a report; empty if there is none.
std::string differenceOf(const cv::rsackermann::RollingShutterCamera& a,
                         const cv::rsackermann::RollingShutterCamera& b);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_CAMERA_OF_REPORT_HPP
