// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_OPTIM_MEDIAN_HPP
#define OPENCV_RSACKERMANN_SRC_OPTIM_MEDIAN_HPP

#include <algorithm>
#include <iterator>

namespace cv { namespace rsackermann {

//! The upper one of two in the middle. @param begin, end values, at least one, whose order becomes another one.
template <class Iterator>
typename std::iterator_traits<Iterator>::value_type medianOf(Iterator begin, Iterator end)
{
    const Iterator middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end);
    return *middle;
}

//! The standard deviation of a normal distribution of mean 0 whose absolute value has this median.
inline double sigmaOfMedian(double median)
{
    const double medianOfUnitSigma = 0.6745;
    return median / medianOfUnitSigma;
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_OPTIM_MEDIAN_HPP
