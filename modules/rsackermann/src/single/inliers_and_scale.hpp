// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_INLIERS_AND_SCALE_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_INLIERS_AND_SCALE_HPP

#include "../motion/compensation.hpp"
#include "../features/upright_segment.hpp"

namespace cv { namespace rsackermann {

//! How large the residuals of verticals that agree with a model may be.
struct Agreement
{
    double focal;     // pixels
    double threshold; // pixels
    double lean;      // radians, of verticals of the scene
};

/** Labels the segments that agree with a model, and counts them.
@param labels of all segments; the verticals' are at least SEGMENT_OUTLIER. */
void labelInliers(const std::vector<UprightSegment>& verticals, const Model& model, const Heading& heading,
                  const Agreement& agreement, AckermannMotion& motion, Mat& labels);

/** Sets the motion of an image, its covariance and whether roll and yaw rate can be distinguished.
@param G slope of the road's scaled inverse depth. */
void setModel(const Model& model, double G, const Matx<double, PARAMETERS, PARAMETERS>& covariance,
              AckermannMotion& motion);

//! Leaves of two walls the one that the image shows, if it shows one alone: what is given of "the left or only wall" is
//! of that one, not of one that nobody sees.
void keepSeenWalls(const RollingShutterCamera& camera, AckermannMotion& motion);

/** Sets the standard deviation of the speed of a motion with a length: what the motion of its walls, the line delay and
the distance of a wall leave open.
@param wallLogSigma of the logarithm of the distance. */
void setSpeedSigma(const RollingShutterCamera& camera, double wallLogSigma, AckermannMotion& motion);

/** Gives a motion the length that a given wall or speed determines, whichever is known better.
@return false if neither is given. */
bool setGivenScale(const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
                   const MotionPrior& prior, AckermannMotion& motion);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_INLIERS_AND_SCALE_HPP
