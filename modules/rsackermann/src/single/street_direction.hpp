// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_STREET_DIRECTION_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_STREET_DIRECTION_HPP

#include "refinement.hpp"

namespace cv { namespace rsackermann {

/** Searches the direction of the street with which most of the other segments agree, and turns the walls of the model
there.
@return whether that is another model: false if there are too few segments, or if it was there already.
*/
bool startFromStreetDirection(const RefinementProblem& problem, const MotionHypothesis& hypothesis, Model& model);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_STREET_DIRECTION_HPP
