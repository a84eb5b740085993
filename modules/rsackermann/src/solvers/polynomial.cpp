// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "polynomial.hpp"

namespace cv { namespace rsackermann {

static double evaluate(const double* c, int degree, double x)
{
    double value = c[degree];
    for (int i = degree - 1; i >= 0; i--)
        value = value * x + c[i];
    return value;
}

// In ascending order; of the two forms of a root the one without cancellation.
static int quadraticRoots(const double* c, double low, double high, double* roots)
{
    const double discriminant = c[1] * c[1] - 4 * c[0] * c[2];
    if (!(discriminant >= 0))
        return 0;
    const double q = -(c[1] + (c[1] < 0 ? -1 : 1) * std::sqrt(discriminant)) / 2;
    double first = q / c[2], second = c[0] / q; // not finite if there is no such root
    if (first > second)
        std::swap(first, second);
    int count = 0;
    if (first >= low && first <= high)
        roots[count++] = first;
    if (second >= low && second <= high)
        roots[count++] = second;
    return count;
}

// Newton steps from the chord between the ends, replaced by bisection when they leave the bracket.
static double refineBracket(const double* c, int degree, double low, double high, double valueLow, double valueHigh)
{
    // Newton steps converge quadratically, so that after one of 1e-8 double precision is reached.
    const double lastStep = 1e-10;
    double x = low - valueLow * (high - low) / (valueHigh - valueLow);
    for (int i = 0; i < 60; i++)
    {
        double value = c[degree], slope = 0;
        for (int k = degree - 1; k >= 0; k--)
        {
            slope = slope * x + value;
            value = value * x + c[k];
        }
        ((value > 0) == (valueHigh > 0) ? high : low) = x;
        double next = x - value / slope;
        if (!(next >= low && next <= high))
            next = (low + high) / 2;
        if (std::abs(next - x) <= lastStep * (high - low + std::abs(x)))
            return next;
        x = next;
    }
    return x;
}

int realRoots(const double* c, int degree, double low, double high, double* roots)
{
    CV_DbgAssert(degree >= 2 && degree <= MAX_DEGREE);
    double derivatives[MAX_DEGREE + 1][MAX_DEGREE + 1]; // [k]: coefficients of the polynomial of degree k in the chain
    std::copy(c, c + degree + 1, derivatives[degree]);
    for (int k = degree; k > 2; k--)
        for (int i = 0; i < k; i++)
            derivatives[k - 1][i] = (i + 1) * derivatives[k][i + 1];

    int count = quadraticRoots(derivatives[2], low, high, roots);
    double stops[MAX_DEGREE + 2]; // the ends of the interval and, between them, the roots of the derivative
    for (int k = 3; k <= degree; k++)
    {
        stops[0] = low;
        std::copy(roots, roots + count, stops + 1);
        stops[count + 1] = high;
        const int intervals = count + 1;
        count = 0;
        double left = evaluate(derivatives[k], k, low);
        for (int i = 0; i < intervals; i++)
        {
            const double right = evaluate(derivatives[k], k, stops[i + 1]);
            if ((left < 0 && right >= 0) || (left > 0 && right <= 0))
                roots[count++] =
                    right == 0 ? stops[i + 1] : refineBracket(derivatives[k], k, stops[i], stops[i + 1], left, right);
            left = right;
        }
    }
    return count;
}

}} // namespace cv::rsackermann
