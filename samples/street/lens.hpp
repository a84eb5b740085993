// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_LENS_HPP
#define RSACKERMANN_SAMPLES_LENS_HPP

#include "opencv2/core.hpp"
#include <vector>

namespace street {

//! Distorted normalised point of an ideal one, in the model of cv::projectPoints with 0, 4, 5 or 8 coefficients.
cv::Point2d distortPoint(const std::vector<double>& lens, const cv::Point2d& ideal);

//! Inverse of distortPoint() by Newton's method.
cv::Point2d undistortPoint(const std::vector<double>& lens, const cv::Point2d& distorted);

} // namespace street

#endif // RSACKERMANN_SAMPLES_LENS_HPP
