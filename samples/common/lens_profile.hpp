// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_LENS_PROFILE_HPP
#define RSACKERMANN_SAMPLES_LENS_PROFILE_HPP

#include "camera_settings.hpp"

namespace rsackermann_samples {

//! Whether a text is one of Gyroflow's lens profiles, damaged ones included.
bool isLensProfile(const std::string& text);

/** Reads one of Gyroflow's lens profiles (JSON): lens, read-out time and scan direction for images of any size of its
shape, and of its compatible_settings. Its interpolations (of zoom lenses) aren't used. Throws UsageError that names the
field. */
void readLensProfile(const std::string& text, CameraSettings& settings);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_LENS_PROFILE_HPP
