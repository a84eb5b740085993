// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SCENE_INVERSE_DEPTH_OFFSET_HPP
#define OPENCV_RSACKERMANN_SRC_SCENE_INVERSE_DEPTH_OFFSET_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace cv { namespace rsackermann {

/** The control values of a uniform cubic B-spline that count at a place, and their weights (doc/theory.md,
"Inverse-depth offset"). */
struct SplineWeights
{
    enum { ALONG = 4 }; // control values along each side

    struct Axis
    {
        int first; // control value
        double weights[ALONG];

        //! The part of the area along the axis has as many cells as there are control values less 3.
        Axis(double place, double low, double length, int controls);
    };

    Axis x, y;

    //! @param place beyond the area the nearest one of it counts.
    SplineWeights(const Rect2d& area, const Size& controls, const Point2d& place)
        : x(place.x, area.x, area.width, controls.width), y(place.y, area.y, area.height, controls.height)
    {
    }
};

//! By how much the scene is nearer than its planes, from place to place: AckermannMotion::inverseDepthOffset.
class InverseDepthOffset
{
public:
    explicit InverseDepthOffset(const AckermannMotion& motion)
        : controls(motion.inverseDepthOffset), area(motion.offsetArea)
    {
    }

    bool empty() const { return controls.empty(); }

    //! Number of cells along both axes.
    Size cells() const { return empty() ? Size() : controls.size() - Size(ADDED, ADDED); }

    //! Where a direction is, counted in cells from the corner of the area, be it in the area or not.
    Point2d cellOf(const Vec3d& ray) const
    {
        return Point2d((ray[0] / ray[2] - area.x) / area.width * cells().width,
                       (ray[1] / ray[2] - area.y) / area.height * cells().height);
    }

    //! Whether so many control values can be an offset.
    static bool isPossible(const Size& size)
    {
        return std::min(size.width, size.height) > ADDED && std::max(size.width, size.height) <= MOST;
    }
    //! What is possible, in words.
    static String possibleSizes() { return format("from %d x %d to %d x %d values", ADDED + 1, ADDED + 1, MOST, MOST); }

    //! To be added to Scene::inverseDepth() in the direction of the global-shutter camera; 0 if it isn't in front.
    double at(const Vec3d& ray) const;

private:
    enum { ADDED = SplineWeights::ALONG - 1, MOST = 1024 };

    Mat controls; // CV_64F
    Rect2d area;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SCENE_INVERSE_DEPTH_OFFSET_HPP
