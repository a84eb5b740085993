// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_OPTIM_SIGMA_OF_MEDIAN_HPP
#define OPENCV_RSACKERMANN_SRC_OPTIM_SIGMA_OF_MEDIAN_HPP

namespace cv { namespace rsackermann {

//! The standard deviation of a normal distribution of mean 0 whose absolute value has this median.
inline double sigmaOfMedian(double median)
{
    const double medianOfUnitSigma = 0.6745;
    return median / medianOfUnitSigma;
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_OPTIM_SIGMA_OF_MEDIAN_HPP
