// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CALIBRATION_DRIVE_FIT_HPP
#define OPENCV_RSACKERMANN_SRC_CALIBRATION_DRIVE_FIT_HPP

#include "drive_turns.hpp"
#include "mount_solver.hpp"

namespace cv { namespace rsackermann {

//! What a drive is calibrated by.
struct Drive
{
    const RollingShutterCamera& camera; //!< with a line delay, which may be where the search starts
    bool lineDelayIsGiven;
    const std::vector<CalibrationFrame>& frames;
    const GyroSamples& gyro;
    Suspension suspension;
    double intervalSigma; //!< relative, of the times between frames
};

struct DriveFit
{
    MountFit mount;
    GyroOfDrive gyro;
    double focalRatio;                    //!< focal length over the camera's one
    double focalSigma;                    //!< relative
    double focalByGyro, focalByGyroSigma; //!< what the gyro alone shows of focalRatio; 1, 0 without one
};

//! Whether a value is much better known than before.
bool isObserved(const MountVector& sigma, const MountVector& before, MountValue which);

//! The same of the line delay: by bends or shaking, and only as well as the times are known.
bool isLineDelayObserved(const MountFit& fit, const MountVector& before, double intervalSigma);

/** Fits all frames of a drive together (doc/theory.md, "Self-calibration").
@param before standard deviations before; those of the result, if there are too few frames. */
DriveFit fitDrive(const Drive& drive, const MountVector& before);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CALIBRATION_DRIVE_FIT_HPP
