// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_DRIVE_FLOW_RESIDUAL_HPP
#define OPENCV_RSACKERMANN_SRC_DRIVE_FLOW_RESIDUAL_HPP

#include "../compensation.hpp"
#include "drive_state.hpp"
#include "point_tracker.hpp"

namespace cv {
namespace rsackermann {

//! A tracked point as upright bearings with z = 1, and the row times at which it was seen, from the present reference row.
struct Sight
{
    Point2d before, now;
    double timeBefore, timeNow;
};

//! @param seconds between the reference rows of the two frames.
std::vector<Sight> makeSights(const RollingShutterCamera& camera, const std::vector<PointPair>& pairs, double seconds);

//! What a drive is described by, and turns about the other axes between the two frames, which are no part of the present image's motion.
enum { FLOW_PITCH = DRIVE_VALUES, FLOW_ROLL, FLOW_VALUES };

/** By how much a point was elsewhere in the image before than the motion says (doc/theory.md, "Drive").

The motion between the two rows is exact; the derivatives are those of the displacement to first order.
*/
class FlowResidual
{
public:
    explicit FlowResidual(const RollingShutterCamera& camera);

    /** @param values FLOW_VALUES of them.
    @param jacobian receives, unless it is null, the derivatives of x and then those of y.
    @return pixels. */
    Point2d evaluate(const Sight& sight, const double* values, double (*jacobian)[FLOW_VALUES]) const;

    //! Part of a point's displacement between the frames that the shutter makes in the present image.
    static double shutterPart(const Sight& s) { return std::abs(s.timeNow / (s.timeNow - s.timeBefore)); }

private:
    Heading heading;
    double unit, focal;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_DRIVE_FLOW_RESIDUAL_HPP
