// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_ESTIMATOR_MOTION_MIXTURE_HPP
#define OPENCV_RSACKERMANN_SRC_ESTIMATOR_MOTION_MIXTURE_HPP

#include "posterior.hpp"

namespace cv { namespace rsackermann {

//! Possible motions with their probabilities.
class MotionMixture
{
public:
    MotionMixture(const DisplacementField& field_, const UsualDrive& usual_) : field(field_), usual(usual_) {}

    //! Of the motions that are added from now on.
    void setRoadContact(const RoadContact& found) { contact = found; }

    //! @param hypothesis whose unknowns the model has; the others are 0.
    void add(const Fit& fit, const MotionHypothesis& hypothesis, double logWeight);

    /** The average that minimises the expected displacement: the geometric median of the displacement fields, which is
    that of the most probable motions if they have more than half of the probability, and between all of them otherwise.
  */
    Posterior best() const;

private:
    struct Component
    {
        Model model;
        MotionHypothesis hypothesis;
        Matx<double, PARAMETERS, PARAMETERS> covariance;
        double logWeight, G;
        DisplacementField::Values displacement;
        DisplacementField::Variances variance;
    };

    std::vector<double> weights() const;
    void average(const std::vector<double>& weight, Posterior& result) const;

    const DisplacementField& field;
    const UsualDrive& usual;
    RoadContact contact;
    std::vector<Component> components;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_ESTIMATOR_MOTION_MIXTURE_HPP
