// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "polynomial.hpp"

namespace cv {
namespace rsackermann {

static double evaluate(const double* c, int degree, double x)
{
    double value = c[degree];
    for (int i = degree - 1; i >= 0; i--)
        value = value * x + c[i];
    return value;
}

// Newton steps, replaced by bisection where they leave the bracket.
static double refineBracket(const double* c, const double* derivative, int degree, double low, double high, bool risesToHigh)
{
    double x = (low + high) / 2;
    for (int i = 0; i < 60; i++)
    {
        const double value = evaluate(c, degree, x);
        ((value > 0) == risesToHigh ? high : low) = x;
        const double slope = evaluate(derivative, degree - 1, x);
        double next = x - value / slope;
        if (!(next > low && next < high))
            next = (low + high) / 2;
        if (std::abs(next - x) <= 1e-12 * (std::abs(x) + 1e-3))
            return next;
        x = next;
    }
    return x;
}

int realRoots(const double* c, int degree, double low, double high, double* roots)
{
    double derivatives[MAX_DEGREE + 1][MAX_DEGREE + 1]; // [k]: coefficients of the polynomial of degree k in the chain
    std::copy(c, c + degree + 1, derivatives[degree]);
    for (int k = degree; k > 1; k--)
        for (int i = 0; i < k; i++)
            derivatives[k - 1][i] = (i + 1) * derivatives[k][i + 1];

    int count = 0;
    double stops[MAX_DEGREE + 2]; // the ends of the interval and, between them, the roots of the derivative
    for (int k = 1; k <= degree; k++)
    {
        const double constant[1] = {derivatives[k][1]};
        const double* slope = k > 1 ? derivatives[k - 1] : constant;
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
                roots[count++] = right == 0 ? stops[i + 1] : refineBracket(derivatives[k], slope, k, stops[i], stops[i + 1], right > 0);
            left = right;
        }
    }
    return count;
}

}} // namespace cv::rsackermann
