// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_OPTIM_HAC_COVARIANCE_HPP
#define OPENCV_RSACKERMANN_SRC_OPTIM_HAC_COVARIANCE_HPP

#include "opencv2/core.hpp"
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

namespace cv { namespace rsackermann {

const int LEAST_WAVES = 4; //!< oscillations that show how a series scatters
//! Hz; a car's body swings at 1 to 1.5 Hz, and below a sixth of that its spectrum is flat to 5 %.
const double SLOW = 0.2;

/** Covariance of the sum of a stationary series as it really scatters, whatever connects neighbours: that of its
slowest oscillations, the cosines of half a period and more over the series [lazarus2018har] (doc/theory.md,
"Self-calibration").
@param values in equal steps, which may lack some; more than LEAST_WAVES of them.
@param seconds their number times the step.
@param memories seconds after which each value that wanders has come back; what a series is too short for to show counts
as well. */
template <class V>
Eigen::Matrix<double, V::RowsAtCompileTime, V::RowsAtCompileTime> hacCovariance(const std::vector<V>& values,
                                                                                double seconds, const V& memories)
{
    CV_Assert(values.size() > size_t(LEAST_WAVES));
    const int n = int(values.size()), waves = std::min(std::max(LEAST_WAVES, int(seconds * 2 * SLOW)), n - 1);
    Eigen::Matrix<double, V::RowsAtCompileTime, V::RowsAtCompileTime> sum;
    sum.setZero();
    for (int j = 1; j <= waves; j++)
    {
        V wave = V::Zero();
        for (int k = 0; k < n; k++)
            wave += std::cos(CV_PI * j * (k + 0.5) / n) * values[k];
        // The part of what wanders is smaller by as much as at rest.
        const V atRest = (1 + (CV_PI * j / seconds * memories).array().square()).sqrt() * wave.array();
        sum += 2 * atRest * atRest.transpose();
    }
    // So few of them leave the variance itself uncertain: that of Student's t distribution.
    return sum / (waves - 2);
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_OPTIM_HAC_COVARIANCE_HPP
