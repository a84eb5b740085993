// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_MOTION_MIXTURE_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_MOTION_MIXTURE_HPP

#include "posterior.hpp"

namespace cv { namespace rsackermann {

/** The motions that are possible with their weights, and the correction that is decided upon (doc/theory.md,
"Posterior"). */
//! What a motion counts for.
enum MotionUse {
    FOR_ALL,
    TO_DECIDE, //!< in the choice of the correction only
    TO_EXPECT  //!< in what is expected of the image only
};

class MotionMixture
{
public:
    //! @param harmAversion_ weight of the displacement by which an image is expected to become worse.
    MotionMixture(const DisplacementField& field_, const DrivingPrior& prior_, double harmAversion_)
        : field(field_), prior(prior_), harmAversion(harmAversion_), largest(-DBL_MAX)
    {
    }

    //! Of the motions that are added from now on.
    void setRoadLimit(const RoadLimit& found) { limit = found; }

    //! @param fit whose model has 0 for what isn't an unknown of its hypothesis.
    void add(const Fit& fit, double logWeight, MotionUse use = FOR_ALL);

    //! Logarithm of the sum of the weights, those to decide aside.
    double logSum() const;

    /** The correction with the least expected residual and harm.

    Of the middle of all motions but rest, a mean in which few that are far away hardly count, it is the fraction that
    minimises the expected residual plus harmAversion times the expected harm, E[max(0, residual - raw)]. */
    Posterior best() const;

private:
    struct Component
    {
        Fit fit;
        double logWeight;
        MotionUse use;
    };

    std::vector<double> probabilities() const;

    const DisplacementField& field;
    const DrivingPrior& prior;
    const double harmAversion;
    double largest;
    RoadLimit limit;
    std::vector<Component> components;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_MOTION_MIXTURE_HPP
