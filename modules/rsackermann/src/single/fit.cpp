// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "fit.hpp"
#include <Eigen/Cholesky>

namespace cv { namespace rsackermann {

void Fit::refine(const RefinementProblem& problem, double farthest)
{
    const int iterations = 30;
    cost = rsackermann::refine(problem, hypothesis, ALL_SEGMENTS, iterations, model, &covariance, farthest);
}

double logVolume(const Fit& fit)
{
    int free[PARAMETERS], n = 0;
    for (int i = 0; i < PARAMETERS; i++)
        if (fit.covariance(i, i) > 0)
            free[n++] = i;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, PARAMETERS, PARAMETERS> correlation(n, n);
    double sum = 0;
    for (int i = 0; i < n; i++)
    {
        const double variance = fit.covariance(free[i], free[i]);
        sum += 0.5 * std::log(variance);
        for (int j = 0; j < n; j++)
            correlation(i, j) =
                fit.covariance(free[i], free[j]) / std::sqrt(variance * fit.covariance(free[j], free[j]));
    }
    return sum + 0.5 * std::log(std::max(correlation.ldlt().vectorD().prod(), 1e-30));
}

}} // namespace cv::rsackermann
