// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_MOTION_CONTRADICTION_HPP
#define OPENCV_RSACKERMANN_SRC_MOTION_CONTRADICTION_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace cv { namespace rsackermann {

const double CONTRADICTION = 3; //!< standard deviations by which two values exclude each other

//! Whether a value that is seen and a given one exclude each other.
bool contradicts(double seen, double seenSigma, double given, double givenSigma);

//! Whether a motion that is seen without the given speed clearly goes the other way.
bool showsOtherDirection(const AckermannMotion& seen, const MotionPrior& prior);

/** Sets AckermannMotion::contradictsPrior by AckermannMotion::seenYawRate and AckermannMotion::seenSpeed, those with a
standard deviation.
@param isOtherDirection what showsOtherDirection() says of the motion that is seen. */
void compareWithGiven(const MotionPrior& prior, bool isOtherDirection, AckermannMotion& motion);

/** Corrects the comparison of a motion that was estimated with a yaw rate that nobody has given: that of a gyro or of
the frames before.
@param used the values with which it was estimated.
@param given those that are given. */
void compareAgain(const MotionPrior& used, const MotionPrior& given, AckermannMotion& motion);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_MOTION_CONTRADICTION_HPP
