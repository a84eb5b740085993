// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_EXPORT_ROW_POSES_HPP
#define RSACKERMANN_SAMPLES_EXPORT_ROW_POSES_HPP

#include "frames.hpp"

namespace rsackermann_samples {

//! Poses of the first and the last line of each frame as JSON, and of as many between as a curve of rotations needs;
//! see doc/exports.md.
std::string rowPosesText(const cv::rsackermann::RollingShutterCamera& camera, const std::vector<MotionFrame>& frames);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_EXPORT_ROW_POSES_HPP
