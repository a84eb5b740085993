// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_EXPORT_ST_MAP_HPP
#define RSACKERMANN_SAMPLES_EXPORT_ST_MAP_HPP

#include "frames.hpp"

namespace rsackermann_samples {

/** An STMap of a pair of CV_32FC1 maps: for each pixel the place that it is taken from, as shares of the source's width
from the left and of its height from the bottom, the sides being those of the outer pixels.

@param depth CV_16U: shares as parts of 65535, which hold no place outside of the image; CV_32F.
@return image in OpenCV's order of channels: red and green hold the shares, blue is full where there is a place in the
image.
*/
cv::Mat stMap(const cv::Mat& columns, const cv::Mat& rows, const cv::Size& source, int depth);

//! A frame's file. @param direction rectify or distort. @param format png or exr.
std::string stMapFile(const std::string& folder, const MotionFrame& frame, const std::string& direction,
                      const std::string& format);

//! Writes the files of both directions for each frame.
void writeStMaps(const std::string& folder, const std::string& format,
                 const cv::rsackermann::RollingShutterCamera& camera, const std::vector<MotionFrame>& frames);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_EXPORT_ST_MAP_HPP
