// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_POINTS_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_POINTS_HPP

#include "opencv2/rsackermann/warp.hpp"

namespace cv { namespace rsackermann {

//! A point and whether it has a place at all.
struct Place
{
    Point2d point;
    bool exists = false;
};

/** Raw pixels to pixels of the global-shutter camera.
@param params of the maps, with whose pixels the points that have a place agree.
@param matrix camera matrix of the global-shutter camera.
@param raw the pixels.
@param depths in metres along the optical axis, or empty; if not positive the planes are used.
@param places receives as many places as there are pixels.
*/
void correctPoints(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params, const Matx33d& matrix,
                   const AckermannMotion& motion, const std::vector<Point2d>& raw, const std::vector<double>& depths,
                   std::vector<Place>& places);

//! The inverse of correctPoints().
void distortPoints(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params, const Matx33d& matrix,
                   const AckermannMotion& motion, const std::vector<Point2d>& pixels, const std::vector<double>& depths,
                   std::vector<Place>& places);

//! The largest rectangle of pixels of a CV_8U mask that aren't 0; empty if there is none.
Rect largestRectangle(const Mat& mask);

//! See WarpMapGenerator::optimalNewCameraMatrix; fallback is returned if a border of the raw image has no place.
Matx33d optimalMatrix(const RollingShutterCamera& camera, const AckermannMotion& motion, double alpha,
                      const Size& newSize, const Matx33d& fallback);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_POINTS_HPP
