// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_MOTION_MODEL_HPP
#define OPENCV_RSACKERMANN_SRC_MOTION_MODEL_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace cv { namespace rsackermann {

//! The unknowns of the refinement and their places in Jacobians and covariances.
enum Parameter {
    P_ALPHA,
    P_B,
    P_D,
    P_LAMBDA,
    P_ROLL, // corrections of gravity, radians
    P_PITCH,
    P_STREET, // azimuth of the street if there is no translation to show it
    PARAMETERS
};

//! A motion while it is being estimated: AckermannMotion without the values that verticals don't determine.
struct Model
{
    Vec<double, PARAMETERS> value;
    int direction = 0; // sign of the scaled inverse depths; 0 if there is no translation

    double operator[](Parameter p) const { return value[p]; }
    double& operator[](Parameter p) { return value[p]; }
};

//! Which unknowns are free: a motion model and the number of walls.
struct MotionHypothesis
{
    int motion; // a MotionModel
    int walls;  // 0, 1 or 2

    MotionHypothesis(int motion_, int walls_) : motion(motion_), walls(walls_) {}

    bool turns() const { return motion == MODEL_1LA || motion == MODEL_4LA; }
    bool translates() const { return motion == MODEL_3LA || motion == MODEL_4LA; }
    //! Segments of a minimal sample, too.
    int unknowns() const { return (turns() ? 1 : 0) + (translates() ? 1 + walls : 0); }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_MOTION_MODEL_HPP
