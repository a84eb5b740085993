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

//! Coefficients of the polynomial of that degree in x / limit through f at evenly spread x, by divided differences.
template <int DEGREE, class Function>
void interpolate(const Function& f, double limit, double c[DEGREE + 1])
{
    double x[DEGREE + 1], difference[DEGREE + 1];
    for (int i = 0; i <= DEGREE; i++)
    {
        x[i] = 2. * i / DEGREE - 1;
        difference[i] = f(limit * x[i]);
    }
    for (int k = 1; k <= DEGREE; k++)
        for (int i = DEGREE; i >= k; i--)
            difference[i] = (difference[i] - difference[i - 1]) / (x[i] - x[i - k]);
    std::fill(c, c + DEGREE + 1, 0.);
    for (int i = DEGREE; i >= 0; i--)
    {
        // c = c * (x - x[i]) + difference[i]
        for (int j = DEGREE; j > 0; j--)
            c[j] = c[j - 1] - x[i] * c[j];
        c[0] = difference[i] - x[i] * c[0];
    }
}

//! Secant steps from a root of the polynomial to that of the function.
template <class Function>
double polish(const Function& f, double limit, double root)
{
    double before = root + 1e-5 * limit, valueBefore = f(before);
    for (int i = 0; i < 8; i++)
    {
        const double value = f(root);
        if (value == valueBefore)
            return root;
        const double step = value * (root - before) / (value - valueBefore);
        before = root;
        valueBefore = value;
        root -= step;
        if (std::abs(step) < 1e-14 * limit)
            return root;
    }
    return root;
}

/** Roots between -limit and limit of a function that is nearly a polynomial of a low degree.
@param roots receives at most DEGREE values.
@return number of roots.
*/
template <int DEGREE, class Function>
int smoothRoots(const Function& f, double limit, double roots[DEGREE])
{
    double polynomial[DEGREE + 1];
    interpolate<DEGREE>(f, limit, polynomial);
    const int found = realRoots(polynomial, DEGREE, -1, 1, roots);
    int count = 0;
    for (int i = 0; i < found; i++)
    {
        const double root = polish(f, limit, roots[i] * limit);
        // Not if it isn't finite, or another one's.
        if (std::abs(root) <= limit && (count == 0 || std::abs(root - roots[count - 1]) > 1e-9 * limit))
            roots[count++] = root;
    }
    return count;
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SOLVERS_POLYNOMIAL_HPP
