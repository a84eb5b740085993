// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_ESTIMATOR_ROBUST_LOSS_HPP
#define OPENCV_RSACKERMANN_SRC_ESTIMATOR_ROBUST_LOSS_HPP

namespace cv {
namespace rsackermann {

/** Geman-McClure loss of a squared residual: r^2 for small residuals, at most scale^2 for large ones. */
struct RobustLoss
{
    double scale2;

    explicit RobustLoss(double scale) : scale2(scale * scale) {}

    double operator()(double r2) const { return r2 * scale2 / (scale2 + r2); }

    //! Derivative of influence r * weight(r^2) by r.
    double influenceSlope(double r2) const
    {
        const double a = scale2 / (scale2 + r2);
        return a * a * (1 - 4 * r2 * a / scale2);
    }

    //! Factor by which the residual counts in the normal equations: the derivative of the loss by r^2.
    double weight(double r2) const
    {
        const double a = scale2 / (scale2 + r2);
        return a * a;
    }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_ESTIMATOR_ROBUST_LOSS_HPP
