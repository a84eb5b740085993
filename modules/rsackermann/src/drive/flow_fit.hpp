// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_DRIVE_FLOW_FIT_HPP
#define OPENCV_RSACKERMANN_SRC_DRIVE_FLOW_FIT_HPP

#include "drive_state.hpp"
#include "point_tracker.hpp"

namespace cv {
namespace rsackermann {

//! What tracked points say of a drive.
struct FlowFit
{
    DriveState state;      //!< prediction and points together
    double expectedRaw;    //!< mean displacement in pixels of the points in the raw image
    double expectedLeft;   //!< the same of what the motion doesn't explain
    double explained;      //!< share of the points that agree with the motion
    double cost;

    explicit FlowFit(const DriveState& start) : state(start), expectedRaw(0), expectedLeft(0), explained(0), cost(DBL_MAX) {}
};

/** Fits motion and planes to points that were tracked from the frame before (doc/theory.md, "Drive").

A point moves from frame to frame as the exact motion moves it, with the time between the two rows that saw it. Rotations about the other
axes between the frames are free, but no part of the motion of the present image.
@param seconds between the reference rows of the frames.
@param prediction of the state at the present frame.
*/
FlowFit fitFlow(const RollingShutterCamera& camera, const std::vector<PointPair>& pairs, double seconds, const DriveState& prediction, bool isFirst);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_DRIVE_FLOW_FIT_HPP
