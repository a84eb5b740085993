// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_YAW_SWEEP_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_YAW_SWEEP_HPP

#include "refinement.hpp"

namespace cv { namespace rsackermann {

//! Logarithm of Laplace's approximation of the contribution of a fit, all unknowns of the hypothesis but the yaw rate
//! being those of the fit (doc/theory.md, "Posterior").
double logEvidence(const RefinementProblem& problem, const Fit& fit);

// doc/theory.md, "Posterior", has the reasons.
const double FIRST_STEP = 1; //!< in sigmas
const double STEP_GROWTH = 1.25;
const double SMALL_SHARE = 0.01; //!< of the highest density: the shape of a peak with less doesn't matter

/** Goes from a motion to both sides, in steps of the yaw rate that grow, until densities are negligible
(doc/theory.md, "Posterior").
@param sigma standard deviation of the yaw rate.
@param scale of its prior.
@param add takes the motion at the last offset from the middle, that offset, the next one, and the width of the range
that this stands for. It makes the motion that at the next offset, and returns the logarithm of its density; -DBL_MAX:
no farther on that side. The middle itself, at the offset 0, is always added. */
template <class Motion, class Add>
void sweepYaw(Motion middle, double sigma, double scale, double farthest, Add add)
{
    const double first = std::min(FIRST_STEP * sigma, 0.5 * scale);
    double highest = add(middle, 0., 0., first);
    for (int side = -1; side <= 1; side += 2)
    {
        Motion last = middle;
        double before = 0;
        for (double step = first, offset = first; offset < farthest; step *= STEP_GROWTH, offset += step)
        {
            const double density = add(last, before, side * offset, (1 + STEP_GROWTH) / 2 * step);
            before = side * offset;
            highest = std::max(highest, density);
            if (density < highest + std::log(NEGLIGIBLE))
                break;
        }
    }
}

//! The motions of a valley of the posterior: the best at each of several yaw rates (doc/theory.md, "Posterior").
class YawSweep
{
public:
    /** Goes from a minimum to both sides, until motions are improbable or in another valley.
    @param valleys those that are known already. */
    YawSweep(const RefinementProblem& problem, const Fit& minimum, const std::vector<YawSweep>& valleys);

    //! Whether a motion lies on it.
    bool contains(const Fit& fit) const;

    std::vector<Fit> fits;
    std::vector<double> logMasses; //!< of their densities, times the range of yaw rates that each stands for

private:
    double add(const RefinementProblem& problem, double width, Fit& fit);

    double highest = -DBL_MAX; // logarithm of a density
};

//! Whether a motion is in one of some valleys.
bool contain(const std::vector<YawSweep>& valleys, const Fit& fit);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_YAW_SWEEP_HPP
