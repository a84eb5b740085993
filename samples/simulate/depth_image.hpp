// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_SIMULATE_DEPTH_IMAGE_HPP
#define RSACKERMANN_SAMPLES_SIMULATE_DEPTH_IMAGE_HPP

#include "opencv2/core.hpp"

namespace rsackermann_samples {

//! Depth in metres (CV_32FC1, 0: none) in 1/256 m (CV_16UC1). What is farther away than 16 bits reach is as unknown as
//! the sky.
inline cv::Mat depthImage(const cv::Mat& metres)
{
    const double unitsPerMetre = 256, farthest = 255;
    cv::Mat image;
    cv::Mat(metres * unitsPerMetre).convertTo(image, CV_16U);
    image.setTo(0, metres > farthest);
    return image;
}

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_SIMULATE_DEPTH_IMAGE_HPP
