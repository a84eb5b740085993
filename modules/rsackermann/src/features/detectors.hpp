// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FEATURES_DETECTORS_HPP
#define OPENCV_RSACKERMANN_SRC_FEATURES_DETECTORS_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

//! Throws cv::Exception with the name of the argument unless it is one of SegmentDetector.
void checkDetector(int detector, const char* name);

// Each of OpenCV's takes a continuous CV_8UC1 image of its own with at least MIN_DETECTOR_SIZE rows and columns.

//! The detectors' neighbourhoods don't fit into smaller images, which they don't all check.
const int MIN_DETECTOR_SIZE = 16;

//! @param scale by which the detector shrinks the image.
void detectLSD(const Mat& gray, double scale, std::vector<Vec4f>& segments);
void detectFLD(const Mat& gray, double minLength, std::vector<Vec4f>& segments);
void detectEDLines(const Mat& gray, double minLength, std::vector<Vec4f>& segments);

/** Finds edges that cross rows and edges that cross columns in an image that has been made smaller, and fits them to
the image itself.
@param gray CV_8UC1. @param smaller the same, halved until it is smaller by scale.
@param isForMany whether many images are used together: then the edges aren't looked for at their ends. */
void detectVerticals(const Mat& gray, const Mat& smaller, int scale, double minLength, bool isForMany,
                     std::vector<Vec4f>& segments);

//! Standard deviation of the noise of an image, from its second differences in both directions, grey levels: at least
//! that of rounding.
double imageNoise(const Mat& gray);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_DETECTORS_HPP
