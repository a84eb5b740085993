// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// What the tests take from the file of that name of the test framework of OpenCV 4, which OpenCV 5 can't compile.

#include "opencv2/ts.hpp"

namespace cvtest {

double norm(InputArray a, int type, InputArray mask)
{
    return cv::norm(a, type, mask);
}

double norm(InputArray a_, InputArray b_, int type, InputArray mask)
{
    const Mat a = a_.getMat(), b = b_.getMat();
    // A vector is a row in OpenCV 5, and was a column.
    if (a.size != b.size && a.total() == b.total())
        return cv::norm(a.reshape(0, 1), b.reshape(0, 1), type, mask);
    return cv::norm(a, b, type, mask);
}

Scalar mean(const Mat& a, const Mat& mask)
{
    return cv::mean(a, mask);
}

void dilate(const Mat& a, Mat& b, const Mat& kernel, Point anchor, int border, const Scalar& value)
{
    cv::dilate(a, b, kernel, anchor, 1, border == 0 ? int(cv::BORDER_CONSTANT) : border, value);
}

} // namespace cvtest
