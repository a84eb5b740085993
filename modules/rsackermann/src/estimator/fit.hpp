// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_ESTIMATOR_FIT_HPP
#define OPENCV_RSACKERMANN_SRC_ESTIMATOR_FIT_HPP

#include "refinement.hpp"

namespace cv { namespace rsackermann {

//! A motion hypothesis with its best model.
struct Fit
{
    MotionHypothesis hypothesis;
    Model model;
    double cost;      // robust, in units of sigma^2
    double criterion; // Bayesian information criterion (doc/theory.md, "Estimation"); the lower the better
    Matx<double, PARAMETERS, PARAMETERS> covariance;
    double inflation; // by which the segments' part of the covariance exceeds the inverse of their normal equations

    explicit Fit(const MotionHypothesis& s) : hypothesis(s), cost(DBL_MAX), criterion(DBL_MAX), inflation(1) {}
};

//! Refines a start on all segments.
Fit refineFrom(const RefinementProblem& problem, const Model& start, const MotionHypothesis& hypothesis);

//! Refines a fit again, after the noise or its model has changed.
void refineAgain(const RefinementProblem& problem, Fit& fit);

inline bool isCheaper(const Fit& a, const Fit& b)
{
    return a.cost < b.cost;
}

//! Azimuth of the walls; only if there is translation.
inline double azimuthOf(const Model& model)
{
    return std::atan2(model[P_D], model[P_B]);
}

//! The model with its walls turned about the vertical axis.
Model turned(const Model& model, double angle);

//! Mean square deviation of a fit's motion, with its covariance, from another model.
Matx<double, PARAMETERS, PARAMETERS> covarianceAround(const Fit& fit, const Model& model);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_ESTIMATOR_FIT_HPP
