// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_MAP_DISTANCE_HPP
#define RSACKERMANN_SAMPLES_MAP_DISTANCE_HPP

#include "opencv2/core.hpp"

namespace rsackermann_samples {

//! The pixels that have a place in a pair of CV_32FC1 maps of the library, as a mask of 0 and 255.
cv::Mat placesOf(const cv::Mat& columns, const cv::Mat& rows);
//! Mean distance in pixels between two pairs of CV_32FC1 maps where the mask isn't 0 and both have a place; 0 if there
//! is no such pixel.
double meanDistance(const cv::Mat& columns1, const cv::Mat& rows1, const cv::Mat& columns2, const cv::Mat& rows2,
                    const cv::Mat& mask);
//! The maps that leave everything in its place.
void identityMaps(const cv::Size& size, cv::Mat& columns, cv::Mat& rows);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_MAP_DISTANCE_HPP
