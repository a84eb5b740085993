// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_FLOW_RESIDUAL_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_FLOW_RESIDUAL_HPP

#include "../motion/compensation.hpp"
#include "../features/frame_features.hpp"

namespace cv { namespace rsackermann {

/** By how much a point is elsewhere in another image than the motion says (doc/theory.md, "Sequence").

The motion between the two rows is exact; the derivatives by the values are those of the displacement to first order.
*/
class FlowResidual
{
public:
    //! FLOW_VALUES of them, and what all points have in common.
    struct Values
    {
        Values(const double* values); // implicit: a single point needs no more than a pointer
        double operator[](int i) const { return u[i]; }

        const double* u;     //!< must exist as long as this object
        double cosine, sine; //!< of the street's direction
        Matx33d tilt;
    };

    explicit FlowResidual(const RollingShutterCamera& camera)
        : FlowResidual(camera.heading, camera.secondsPerUnitTime(), camera.cameraMatrix(0, 0))
    {
    }
    //! @param unit seconds per unit of row time.
    FlowResidual(double heading_, double unit_, double focal_) : heading(heading_), unit(unit_), focal(focal_) {}

    /** @param jacobian receives, unless it is null, 2 x FLOW_VALUES derivatives: those of x and then those of y.
    @return pixels. */
    Point2d evaluate(const TrackedBearing& point, const Values& values, double* jacobian) const;

    //! How a point is seen from the present image, in the upright frame of the values.
    struct View
    {
        Point2d other, now;  // bearings
        Vec3d ray;           // turned into the orientation of the reference row
        Vec3d place;         // of the camera
        int plane;           // 0 left wall, 1 right wall, 2 road
        double inverseDepth; // scaled, to the scale of the ray: the point is at ray + inverseDepth place
        double behind; // the same of the nearer wall if the plane is the road, and of the road otherwise: negative
                       // above the horizon
    };
    View predict(const TrackedBearing& point, const Values& values) const;

    /** The residual of a view, with whatever inverse depth it has.
    @param byInverseDepth receives, unless it is null, the derivative; 0 of a point that would be behind. */
    Point2d residualOf(const TrackedBearing& point, const Values& values, const View& view,
                       Point2d* byInverseDepth = 0) const;

    //! Whether a residual stands for a point that would be behind the camera, or might.
    static bool isBehind(const Point2d& residual) { return !(residual.dot(residual) < 1e6); }

    //! Part of a point's displacement between the frames that the shutter makes in the present image.
    static double shutterPart(const TrackedBearing& s) { return std::abs(s.timeNow / (s.timeNow - s.timeOther)); }

private:
    double halfSquare(const TrackedBearing& point) const;

    Heading heading;
    double unit, focal;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_FLOW_RESIDUAL_HPP
