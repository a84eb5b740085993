// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DEPTH_FILL_UNKNOWN_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DEPTH_FILL_UNKNOWN_HPP

#include "../shutter_geometry.hpp"

namespace cv { namespace rsackermann {

/** Fills the unknown values of an image of inverse depths with those of the scene, without seams.

What is known around shifts the scene's depths: next to known pixels by as much as they differ from the scene, in the
middle of a hole of some hundred pixels not at all (doc/theory.md, "Warp").
@param ofRaw whether it is that of the raw camera.
@param matrix camera matrix of the global-shutter camera.
@param scale of the scene's values in the image.
@param image read and written; NaN: unknown. */
void fillUnknown(const ShutterGeometry& shutter, bool ofRaw, const Matx33d& matrix, double scale, Mat1f& image);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DEPTH_FILL_UNKNOWN_HPP
