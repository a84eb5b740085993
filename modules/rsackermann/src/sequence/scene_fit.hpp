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
    double yawRate;     //!< rad/s, mean between the frames
    Matx33d covariance; //!< of the yaw rate, and scale and shift of the depth
    double residual;    //!< SequenceFit::residual with the values that maps take
};

/** Finds scale and shift of a #DEPTH_RELATIVE of the raw camera, together with the turns between the frames, by the
displacements of points (doc/theory.md, "Relative depth").
@param bearings points, those of the fit.
@param planes the fit without the depth.
@param motion that of the fit; its offset doesn't matter.
@param depth receives scale and shift.
@return whether planes and offset don't explain the points better than the depth does; otherwise it stays as it is. */
bool fitDepth(const RollingShutterCamera& camera, const std::vector<TrackedBearing>& bearings,
              const SequenceFit& planes, const AckermannMotion& motion, DepthMap& depth, DepthFit& found);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_SCENE_FIT_HPP
