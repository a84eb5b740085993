// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SOLVERS_POLYNOMIAL_HPP
#define OPENCV_RSACKERMANN_SRC_SOLVERS_POLYNOMIAL_HPP

namespace cv { namespace rsackermann {

enum { MAX_DEGREE = 8 };

/** Real roots of a polynomial inside an interval, in ascending order.

Between neighbouring roots of the derivative a polynomial is monotone, so that every sign change is a bracket; a root
that only touches zero has none and is left out.
@param c coefficients of x^0 ... x^degree.
@param degree from 2 to MAX_DEGREE.
@param roots receives at most degree values.
@return number of roots.
*/
int realRoots(const double* c, int degree, double low, double high, double* roots);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SOLVERS_POLYNOMIAL_HPP
