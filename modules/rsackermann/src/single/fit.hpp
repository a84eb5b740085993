// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_FIT_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_FIT_HPP

#include "refinement.hpp"

namespace cv { namespace rsackermann {

//! The best model of a hypothesis.
struct Fit
{
    MotionHypothesis hypothesis;
    Model model;
    double cost; // robust, in units of sigma^2
    Matx<double, PARAMETERS, PARAMETERS> covariance;

    explicit Fit(const MotionHypothesis& h) : hypothesis(h), cost(DBL_MAX) {}

    //! Refines the model with all segments. @param farthest cost above which it may end early.
    void refine(const RefinementProblem& problem, double farthest = DBL_MAX);
};

//! Logarithm of the square root of the determinant of the covariance of the unknowns that are free.
double logVolume(const Fit& fit);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_FIT_HPP
