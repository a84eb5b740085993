// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_EXPORT_CLOUD_HPP
#define RSACKERMANN_SAMPLES_EXPORT_CLOUD_HPP

#include "frames.hpp"

namespace rsackermann_samples {

/** Puts the points of a lidar into the raw images, each at the instant of the row that sees it: a CSV table with a
header, file (needed if there are several frames) and x, y and z, metres in the frame of the camera (x right, y down, z
forward) at the reference row of the frame. The scene stands still. All other columns are passed on.

Throws UsageError with the line that isn't understood, and InputError for a frame whose motion has no metres.
@return the table as text with the columns u and v, the place in the raw image; they are empty if the point is behind
the camera or the image doesn't show it.
*/
std::string cloudInRawImages(const std::string& path, const cv::rsackermann::RollingShutterCamera& camera,
                             const std::vector<MotionFrame>& frames);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_EXPORT_CLOUD_HPP
