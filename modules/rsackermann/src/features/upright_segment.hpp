// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FEATURES_UPRIGHT_SEGMENT_HPP
#define OPENCV_RSACKERMANN_SRC_FEATURES_UPRIGHT_SEGMENT_HPP

#include "../motion/limits.hpp"

namespace cv { namespace rsackermann {

const double PRIOR_LEAN = 0.3 * CV_PI / 180; //!< radians, of verticals of real streets
const double END_SIGMA = 0.5;                //!< pixels, of a vertical's slant, until the noise is measured

//! A segment of the image in the upright frame.
struct UprightSegment
{
    Vec3d u, v;          // upright bearings of the ends, with z = 1
    double timeU, timeV; // row times of the ends
    double length;       // pixels
    double sagitta;      // pixels by which the lens bends the image of the straight line between the ends
    int index;           // among the segments of the caller
};

/** Sorts the segments into those that may be images of vertical lines and the others.

Segments that are too short, behind the camera, outside of the image or with coordinates that aren't finite are left
out.
@param segments N x 4, CV_64F.
@param verticals candidates for images of vertical lines, from left to right.
@param others the rest in the order of segments: candidates for lines along the street or across it.
*/
void selectCandidates(const Mat& segments, const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
                      std::vector<UprightSegment>& verticals, std::vector<UprightSegment>& others);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_UPRIGHT_SEGMENT_HPP
