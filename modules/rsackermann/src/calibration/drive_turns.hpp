// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CALIBRATION_DRIVE_TURNS_HPP
#define OPENCV_RSACKERMANN_SRC_CALIBRATION_DRIVE_TURNS_HPP

#include "calibration_frame.hpp"
#include <list>

namespace cv { namespace rsackermann {

//! What is between a gyro and a camera at the end of a drive.
struct GyroOfDrive
{
    int frames = 0; //!< whose rows it turns
    GyroAlignment alignment;
    double delaySigma = 0, scaleSigma = 0;
};

/** Gives frames the turns of their rows, with the clock, axes and bias that the points of the seconds around them show.
Frames without samples and those whose points contradict the gyro keep what they have.
@param camera whose focal length has a standard deviation, by which the gyro's scale is uncertain.
@param delayRatio the line delay over the camera's one, as far as it is known. */
GyroOfDrive alignGyro(const GyroSamples& samples, const RollingShutterCamera& camera, double delayRatio,
                      std::vector<CalibrationFrame>& frames);

/** Gives frames the turns of their rows without a gyro: a smooth curve through how the frames before and after have
turned (doc/theory.md, "Self-calibration").
@param delayRatio the line delay over the camera's one, as far as it is known.
@param frames with the values of a fit.
@return the curves, which must exist as long as the frames. */
std::list<GyroSamples> turnRowsByNeighbours(const RollingShutterCamera& camera, double delayRatio,
                                            std::vector<CalibrationFrame>& frames);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CALIBRATION_DRIVE_TURNS_HPP
