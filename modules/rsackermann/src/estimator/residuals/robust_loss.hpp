// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_ESTIMATOR_RESIDUALS_ROBUST_LOSS_HPP
#define OPENCV_RSACKERMANN_SRC_ESTIMATOR_RESIDUALS_ROBUST_LOSS_HPP

namespace cv { namespace rsackermann {

/** Geman-McClure loss w r^2 s^2 / (s^2 + r^2) of a residual r with the scale s and the weight w: w r^2 for small
residuals, at most w s^2 for large ones (doc/theory.md, "Estimation").
*/
struct RobustLoss
{
    double scale2;
    double weight; // below 1 if segments err together

    explicit RobustLoss(double scale, double weight_ = 1) : scale2(scale * scale), weight(weight_) {}
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_ESTIMATOR_RESIDUALS_ROBUST_LOSS_HPP
