// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_RELATIVE_DEPTH_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_RELATIVE_DEPTH_HPP

#include "opencv2/rsackermann/camera.hpp"
#include "opencv2/rsackermann/depth_map.hpp"
#include "opencv2/rsackermann/estimator.hpp"

namespace cv { namespace rsackermann {

/** A depth of the raw camera, relative or in metres, in the unit that its road gives it: the height of the camera.

The inverse depth of a plane road is proportional to how far a ray points below the horizon, so that a line through the
road's values is 0 at infinity (doc/theory.md, "Relative depth"). */
class RelativeDepth
{
public:
    /** @param depth checked, not empty; has to live as long as this.
        @param up rotation from the camera frame to the upright frame. */
    RelativeDepth(const DepthMap& depth, const RollingShutterCamera& camera, const Matx33d& up);

    //! Whether enough of what is below the horizon is one plane, nearer the further down.
    bool hasRoad() const;

    //! The value at infinity.
    double infinity() const { return zero; }
    //! By how much a value is larger for one more height of the camera over the depth.
    double slope() const { return slope_; }

    //! The value of a depth map nearest to a pixel, of one in metres 1/m; NaN outside of it and where it isn't known.
    static double valueAt(const DepthMap& depth, const Point2d& pixel);
    //! The median of those in a square around it; NaN if there are none. @param reach pixels to each side.
    static double medianAround(const DepthMap& depth, const Point2d& pixel, double reach);
    //! The height of the camera over the depth at a pixel along the optical axis; NaN if it isn't known.
    double at(const Point2d& pixel) const;

    //! The same on the nearer side of a segment (x1, y1, x2, y2); false if it isn't known on both sides.
    bool besideSegment(const Vec4d& segment, double& height) const;

    /** By how many standard deviations edges of the image are edges of the depth more often than lines beside them.

    Where something stands in front of something else both have an edge, if they are of the same image. */
    double edgesInCommon(const Mat& segments, double minLength) const;

    /** Whether it is in metres that are evidently another unit: the height of the camera above the road that it shows
    is three standard deviations of the prior away from the given height, or from the prior's if none is given. */
    bool isInAnotherUnit(double cameraHeight, const AckermannEstimator::Params& params) const;

private:
    enum { LEAST_PIXELS = 20 }; // of a road

    void fitRoad(const RollingShutterCamera& camera, const Matx33d& up);
    void sampleRoad(const std::vector<Point2d>& below);
    void refineRoad(const std::vector<Point2d>& below);
    bool isEdge(const Vec4d& segment, double shift, bool& edge) const;
    bool findSides(const Vec4d& segment, double shift, double& nearer, double& farther) const;
    bool median(const Vec4d& segment, double shift, double& height) const;

    const DepthMap& depth;
    double longerSide; // of the image, pixels
    double zero, slope_;
    double share; // of what is below the horizon that is road
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_RELATIVE_DEPTH_HPP
