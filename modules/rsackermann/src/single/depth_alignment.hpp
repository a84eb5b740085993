// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_DEPTH_ALIGNMENT_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_DEPTH_ALIGNMENT_HPP

#include "opencv2/rsackermann/depth_map.hpp"
#include "opencv2/rsackermann/estimator.hpp"

namespace cv { namespace rsackermann {

//! Twice the logarithm of a ratio of evidences that is "not worth more than a bare mention" [kass1995bayes].
const double BARE_MENTION = 2;
//! Sigmas, as one of 160 goes beyond by chance.
const double LEAST_IN_COMMON = 2.5;

/** Finds scale and shift of a relative depth of the raw camera, and the motion that goes with it (doc/theory.md,
"Relative depth"). One in metres stays as it is, as does the motion but for what is expected; it has to leave no more of
the verticals than the planes do.

@param segments N x 4, CV_64F.
@param motion the motion without the depth, of any status but #MOTION_NOT_OBSERVABLE. Unless the depth is refused, its
status, yaw rate, corrections of gravity, their covariance, the road and what is expected of the correction become those
with the depth.
@param depth checked; receives scale and shift.
@return false if the depth is refused: metres are those of another unit, the image contradicts it, or nothing shows that
it belongs to the image, it isn't expected to help, or it is in metres and the speed isn't. */
bool alignDepth(const RollingShutterCamera& camera, const AckermannEstimator::Params& params, const MotionPrior& prior,
                const Mat& segments, AckermannMotion& motion, DepthMap& depth);

//! Sets the variance of alpha; its correlations stay as they are.
void setAlphaVariance(double variance, AckermannMotion& motion);

/** Sets AckermannMotion::expectedRaw and AckermannMotion::expectedResidual, to first order
(doc/theory.md, "Relative depth").
@param depth where it isn't known next to a pixel, the planes count.
@param scale, shift the scaled inverse depth without its sign is scale * RelativeDepth::medianAround() + shift.
@param covariance of alpha, scale and shift.
@param seen as DisplacementField has it.
@param byPlanes the motion without the depth, with what is expected of it. */
void expectWithDepth(const RollingShutterCamera& camera, const DepthMap& depth, double scale, double shift,
                     const Matx33d& covariance, const std::vector<Point2d>& seen, const AckermannMotion& byPlanes,
                     AckermannMotion& motion);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_DEPTH_ALIGNMENT_HPP
