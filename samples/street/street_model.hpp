// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_STREET_MODEL_HPP
#define RSACKERMANN_SAMPLES_STREET_MODEL_HPP

#include "opencv2/rsackermann.hpp"
#include "street_renderer.hpp"

namespace rsackermann_samples {

//! The same camera in the library's terms.
cv::rsackermann::RollingShutterCamera libraryCamera(const street::StreetCamera& camera);
//! The same motion and walls in the library's terms.
cv::rsackermann::AckermannMotion libraryMotion(const street::StreetCamera& camera, const street::StreetScene& scene);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_STREET_MODEL_HPP
