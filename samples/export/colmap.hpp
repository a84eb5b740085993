// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_EXPORT_COLMAP_HPP
#define RSACKERMANN_SAMPLES_EXPORT_COLMAP_HPP

#include "frames.hpp"

namespace rsackermann_samples {

//! cameras.txt of COLMAP for the corrected images.
std::string colmapCameras(const cv::rsackermann::RollingShutterCamera& camera);

//! The file of a frame's mask.
std::string colmapMask(const std::string& folder, const MotionFrame& frame);

//! Writes cameras.txt and, for each frame, a mask, which is 0 where the corrected image shows nothing.
void writeColmap(const std::string& folder, const cv::rsackermann::RollingShutterCamera& camera,
                 const std::vector<MotionFrame>& frames);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_EXPORT_COLMAP_HPP
