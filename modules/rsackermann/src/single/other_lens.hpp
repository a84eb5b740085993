// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_OTHER_LENS_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_OTHER_LENS_HPP

#include "refinement.hpp"

namespace cv { namespace rsackermann {

/** The same image as if another lens had taken it (doc/theory.md, "Posterior").

A ray at the tangent r from the optical axis of the assumed lens is at r (1 + distortion r^2): to first order the lens
has the radial coefficient -distortion.
@param problem receives the bearings of the other lens; weigh() is left to the caller.
@param logJacobian receives the logarithm of the product, over the verticals, of d(slant through the other lens) /
d(slant).
@return false if there is no such lens: rays would cross, or be behind the camera.
*/
bool seeThroughOtherLens(double distortion, RefinementProblem& problem, double& logJacobian);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_OTHER_LENS_HPP
