// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_TERMS_HPP
#define OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_TERMS_HPP

#include "../estimator/residuals/vertical_residual.hpp"
#include "drive_fit.hpp"

namespace cv { namespace rsackermann {

// How the residuals of points and verticals are weighed; doc/theory.md, "Drive", has the reasons.
const double AGREES = 4;           //!< sigmas by which a point of the scene may miss its planes
const double POINT_DEPENDENCE = 5; //!< neighbouring points err together
const double END_SIGMA = 0.5;      //!< pixels, of a vertical's slant in the image
const double SLANT_SCALE = 2;      //!< of the robust loss, in sigmas
const double SLANT_DEPENDENCE = 5; //!< verticals of one facade err together
//! 1/m by which the inverse depth of a part of the scene differs from that of its plane: a metre or two of ten
const double DEVIATION_SIGMA = 0.03;
const double YAW_CHANGE_SIGMA = 3 * CV_PI / 180; //!< rad/s^2, as cars steer usually: two frames hardly tell it
const double TURN_SIGMA = 0.5 * CV_PI / 180;     //!< of pitch and roll from frame to frame

// Cauchy's loss of a squared residual, and its weight.
inline double cauchyLoss(double squared, double scale)
{
    return scale * scale * std::log1p(squared / (scale * scale));
}
inline double cauchyWeight(double squared, double scale)
{
    return 1 / (1 + squared / (scale * scale));
}

//! Whether a point is seen on the car itself: it stands still where the scene moves. @param squared its residual, in
//! sigmas.
inline bool isOfOwnCar(const Sight& sight, double squared)
{
    return sight.isStill && squared > AGREES * AGREES;
}

/** Slant of a vertical that the motion should have made upright, and its derivatives, in sigmas.
@param plane receives the one of Scene that it is on. */
inline double slantInSigmas(const UprightSegment& c, const PreparedModel& model, double focal, double* jacobian,
                            int& plane)
{
    const double length = norm(c.u - c.v), sigma = std::hypot(USUAL_LEAN * length, END_SIGMA / focal);
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

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_DRIVE_DRIVE_TERMS_HPP
