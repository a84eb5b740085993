// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_EXPORT_TRACKS_HPP
#define RSACKERMANN_SAMPLES_EXPORT_TRACKS_HPP

#include "frames.hpp"

namespace rsackermann_samples {

/** Corrects the points of 2-D tracks, a CSV table with a header: file (needed if there are several frames), x and y of
a point in the raw image, and maybe depth (metres; empty: unknown). All other columns are passed on.

Throws UsageError with the line that isn't understood.
@return the table as text. x and y are the place in the corrected image; they are empty if there is none.
*/
std::string correctTracks(const std::string& path, const cv::rsackermann::RollingShutterCamera& camera,
                          const std::vector<MotionFrame>& frames);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_EXPORT_TRACKS_HPP
