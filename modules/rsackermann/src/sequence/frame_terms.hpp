// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_FRAME_TERMS_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_FRAME_TERMS_HPP

#include "../factors/robust_losses.hpp"
#include "../factors/segment_residuals.hpp"
#include "../motion/contradiction.hpp"
#include "frame_fit.hpp"
#include <Eigen/Core>

namespace cv { namespace rsackermann {

// How the residuals of points and verticals are weighed; doc/theory.md, "Sequence", has the reasons.
const int STEPS = 10; //!< of a fit, at each scale of the loss
//! Of the points' loss, in sigmas: with ever less tolerance for points that disagree.
const double POINT_SCALES[] = {8, 3, 1};
const double TURN_SIGMA = 0.5 * CV_PI / 180; //!< of pitch and roll from frame to frame

//! Whether a point is seen on the car itself: it stands still where the scene moves. @param squared its residual, in
//! sigmas.
inline bool isOfOwnCar(const TrackedBearing& point, double squared)
{
    return point.isStill && squared > CONTRADICTION * CONTRADICTION;
}

//! Those that aren't seen on the car itself. @param values FLOW_VALUES of them.
std::vector<TrackedBearing> withoutOwnCar(const RollingShutterCamera& camera,
                                          const std::vector<TrackedBearing>& bearings, const double* values);

/** Those above a part of the car that is seen at the lower border, below the horizon, where most of the points stand
still. @param cost of what stands still there, in place of that of its residuals. */
std::vector<TrackedBearing> aboveOwnCar(const std::vector<TrackedBearing>& bearings, double focal, double& cost);

//! The residual over the displacement as points show it; those that don't move with the scene don't count.
struct ResidualShare
{
    size_t count = 0, others = 0; //!< that move with the scene, and that don't, without what is of the car itself
    double displacement = 0, residuals = 0; //!< sums of what the shutter makes, pixels

    //! @param residual pixels.
    void add(const TrackedBearing& s, double residual, double focal)
    {
        if (!(residual < CONTRADICTION * POINT_SIGMA))
        {
            others += !s.isStill; // what stands still is of the car itself
            return;
        }
        count++;
        displacement += FlowResidual::shutterPart(s) * focal * norm(s.now - s.other);
        residuals += FlowResidual::shutterPart(s) * residual;
    }

    double value() const { return displacement > 0 ? residuals / displacement : 1; }
};

/** Slant of a vertical that the motion should have made upright, and its derivatives, in sigmas.
@param plane receives the one of Scene that it is on. */
inline double slantInSigmas(const UprightSegment& c, const PreparedModel& model, double focal, double* jacobian,
                            int& plane)
{
    const double length = norm(c.u - c.v), sigma = std::hypot(PRIOR_LEAN * length, END_SIGMA / focal);
    const double r = verticalResidual(c, model, plane, jacobian);
    for (int i = 0; i < PARAMETERS && jacobian; i++)
        jacobian[i] /= sigma;
    return r / sigma;
}
inline double slantInSigmas(const UprightSegment& c, const PreparedModel& model, double focal, double* jacobian)
{
    int plane;
    return slantInSigmas(c, model, focal, jacobian, plane);
}

/** Adds the residuals of points to normal equations.
@param weights by which residuals are multiplied: symmetric.
@param dependence residuals that count as one.
@param evaluate returns the residual of a point and sets its derivatives, a row for each unknown. */
template <int UNKNOWNS, class Evaluate, class Equations>
void addPoints(const std::vector<TrackedBearing>& bearings, const std::vector<Matx22d>& weights, double scale,
               double dependence, const Evaluate& evaluate, Equations& equations)
{
    const CauchyLoss loss(scale, 1 / dependence);
    for (size_t i = 0; i < bearings.size(); i++)
    {
        Eigen::Matrix<double, UNKNOWNS, 2> J;
        const Point2d r = evaluate(bearings[i], J);
        const Eigen::Map<const Eigen::Matrix2d> weight(weights[i].val);
        const Eigen::Vector2d weighed = weight * Eigen::Vector2d(r.x, r.y);
        if (isOfOwnCar(bearings[i], r.dot(r) / (POINT_SIGMA * POINT_SIGMA)))
            equations.cost += loss.cost(CONTRADICTION * CONTRADICTION);
        else if (FlowResidual::isBehind(r))
            equations.cost += loss.cost(weighed.squaredNorm());
        else
            equations.add((J * weight).eval(), weighed, loss);
    }
}

//! The same for verticals, whose residuals are slantInSigmas().
template <int UNKNOWNS, class Evaluate, class Equations>
void addVerticals(const std::vector<UprightSegment>& verticals, const std::vector<double>& weights, double scale,
                  const Evaluate& evaluate, Equations& equations)
{
    const CauchyLoss loss(scale, 1 / DEPENDENCE);
    for (size_t i = 0; i < verticals.size(); i++)
    {
        Eigen::Matrix<double, UNKNOWNS, 1> J;
        const Eigen::Matrix<double, 1, 1> r(weights[i] * evaluate(verticals[i], J));
        equations.add((weights[i] * J).eval(), r, loss);
    }
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_FRAME_TERMS_HPP
