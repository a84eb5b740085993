// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_FORWARD_SPLAT_HPP
#define RSACKERMANN_PERF_FORWARD_SPLAT_HPP

#include "opencv2/rsackermann.hpp"

namespace paper {

/** Corrects an image as the paper does: each pixel of the rolling-shutter image is added to the four pixels around its
place in the global-shutter image, and holes are filled from their neighbours.
@param image CV_8UC3.
@param mask receives 255 where the result has a source. */
cv::Mat correctBySplatting(const cv::rsackermann::RollingShutterCamera& camera,
                           const cv::rsackermann::AckermannMotion& motion, const cv::Mat& image, cv::Mat& mask);

} // namespace paper

#endif // RSACKERMANN_PERF_FORWARD_SPLAT_HPP
