// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_CONTRADICTED_VALUES_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_CONTRADICTED_VALUES_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace cv { namespace rsackermann {

//! Whether anything is given.
bool isGiven(const MotionPrior& prior);

/** Given values that frames have contradicted. A frame that shows too little to contradict a value once more doesn't
confirm it: it isn't used until a frame excludes that it errs as it did. */
class ContradictedValues
{
public:
    /** Compares what is given with AckermannMotion::seenYawRate and AckermannMotion::seenSpeed of a frame, those with a
    standard deviation; sets AckermannMotion::contradictsPrior.
    @param isOtherDirection whether the frame shows another direction than that of the given speed.
    @return the given values that are usable. */
    MotionPrior usable(const MotionPrior& prior, bool isOtherDirection, AckermannMotion& motion);

private:
    double yawRateError = 0; // seen less given where that was contradicted; 0: it is used
    double speedError = 0;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_CONTRADICTED_VALUES_HPP
