// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_ROBUST_LOSSES_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_ROBUST_LOSSES_HPP

#include <cmath>

// Robust losses of the square r2 of a residual in sigmas (doc/theory.md, "Estimation"): w r2 for small residuals, less
// for large ones. The slope is the derivative by r2, with which a residual counts in normal equations. The weight w is
// below 1 if residuals err together.

namespace cv { namespace rsackermann {

const double DEPENDENCE = 5;  //!< residuals that count as one: points of one object, verticals of one facade
const double SLANT_SCALE = 2; //!< sigmas, of the loss of slants

//! w r2 s^2 / (s^2 + r2) of Geman and McClure, at most w s^2. @tparam T double or a vector of numbers.
template <class T>
struct GemanMcClureLoss
{
    T scale2, weight;

    explicit GemanMcClureLoss(double scale, double weight_ = 1) : scale2(scale * scale), weight(weight_) {}
    template <class U>
    explicit GemanMcClureLoss(const GemanMcClureLoss<U>& other) : scale2(other.scale2), weight(other.weight)
    {
    }

    //! 1 for small residuals, 0 for large ones.
    T fading(const T& r2) const { return scale2 / (scale2 + r2); }
    T cost(const T& r2) const { return weight * r2 * fading(r2); }
    T slope(const T& r2) const { return weight * fading(r2) * fading(r2); }
};
typedef GemanMcClureLoss<double> RobustLoss;

//! w s^2 log(1 + r2 / s^2) of Cauchy, which never stops growing: many that are far away still have a say.
struct CauchyLoss
{
    double scale2, weight;

    explicit CauchyLoss(double scale, double weight_ = 1) : scale2(scale * scale), weight(weight_) {}

    double cost(double r2) const { return weight * scale2 * std::log1p(r2 / scale2); }
    double slope(double r2) const { return weight / (1 + r2 / scale2); }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_ROBUST_LOSSES_HPP
