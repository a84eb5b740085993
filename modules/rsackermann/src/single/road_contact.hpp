// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_ROAD_CONTACT_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_ROAD_CONTACT_HPP

#include "refinement.hpp"

namespace cv { namespace rsackermann {

/** How far away walls are in heights of the camera, from wall segments that stand on the road (doc/theory.md,
"Estimation").

At the lower end of such a segment wall and road are equally near: w = G y. Other segments end above the road
and give larger ratios, each its own, so that the smallest ratio on which several segments of a wall agree is taken.
@param threshold pixels below which the residual of a segment makes it an inlier.
*/
RoadContact findRoadContact(const RefinementProblem& problem, const Model& model, double threshold);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_ROAD_CONTACT_HPP
