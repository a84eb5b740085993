// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CALIBRATION_MOUNT_SOLVER_HPP
#define OPENCV_RSACKERMANN_SRC_CALIBRATION_MOUNT_SOLVER_HPP

#include "calibration_frame.hpp"
#include "../optim/hac_covariance.hpp"

namespace cv { namespace rsackermann {

//! How suspension and road tilt a car.
struct Suspension
{
    double sigma;  //!< radians
    double memory; //!< seconds
};

//! The mount as the frames show it.
struct MountFit
{
    MountVector value, sigma; //!< and their standard deviations
    double turningSigma;      //!< standard deviation of MOUNT_DELAY without the evidence of the passing scene
    double weightsSigma;      //!< that of MOUNT_DELAY by the weights
};

/** Explains all frames of a drive by one mount and one line delay (doc/theory.md, "Self-calibration").
@param frames more than LEAST_WAVES of them, as they follow each other; the result of each is left in its value.
@param sigma of the mount's values before, which are 0. */
MountFit fitMount(const RollingShutterCamera& camera, std::vector<CalibrationFrame>& frames, const MountVector& sigma,
                  const Suspension& suspension);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CALIBRATION_MOUNT_SOLVER_HPP
