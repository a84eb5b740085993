// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_SCENE_FIT_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_SCENE_FIT_HPP

#include "frame_fit.hpp"
#include "opencv2/rsackermann/depth_map.hpp"

namespace cv { namespace rsackermann {

/** Finds by how much the scene deviates from the planes of a motion: the residuals of the points (doc/theory.md,
"Inverse-depth offset").
@param bearings points, those of the fit or others.
@param values of the fit, FLOW_VALUES of them.
@param motion that of the fit; receives the offset. It stays without one if there are too few points. */
void fitOffset(const RollingShutterCamera& camera, const std::vector<TrackedBearing>& bearings, const double* values,
               AckermannMotion& motion);

//! What points show if a depth takes the place of the planes.
struct DepthFit
{
    size_t points = 0;   //!< whose depth is known
    double yawRate;      //!< rad/s, mean between the frames
    double scale, shift; //!< inverse depths without their sign are scale * RelativeDepth::valueAt() + shift
    Matx33d covariance;  //!< of the yaw rate, and scale and shift
    double residual;     //!< SequenceFit::residual with the values that maps take
};

/** Finds scale and shift of a depth of the raw camera, together with the turns between the frames, by the displacements
of points (doc/theory.md, "Relative depth"). The scale of a #DEPTH_METRIC is known as well as the way of the motion is,
and it has no shift.
@param bearings points, those of the fit.
@param planes the fit without the depth.
@param motion that of the fit; its offset doesn't matter.
@param depth receives scale and shift, one in metres the scale with which the motion's way shows what the points do.
@return whether planes and offset don't explain the points better than the depth does; otherwise it stays as it is. */
bool fitDepth(const RollingShutterCamera& camera, const std::vector<TrackedBearing>& bearings,
              const SequenceFit& planes, const AckermannMotion& motion, DepthMap& depth, DepthFit& found);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_SCENE_FIT_HPP
