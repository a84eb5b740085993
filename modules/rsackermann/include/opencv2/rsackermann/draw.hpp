// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_DRAW_HPP
#define OPENCV_RSACKERMANN_DRAW_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace cv { namespace rsackermann {

//! @addtogroup rsackermann
//! @{

/** @brief Draws the estimate over the raw image, as in figure 1 of @cite purkait2018minimal : inlier segments from red
(far) to blue (near), outliers black, segments that were no candidates thin and grey, the borders between road and walls
yellow.
@param image 8-bit image with three channels (BGR) of the camera's size, drawn upon.
@param segments N x 4 matrix or N x 1 four-channel matrix with (x1, y1, x2, y2) in pixels.
@param labels N x 1 matrix CV_8U, one of #SegmentLabel for each segment.
@param camera the camera.
@param motion the motion.
@param thickness of the lines in pixels.
 */
CV_EXPORTS_W void drawMotion(InputOutputArray image, InputArray segments, InputArray labels,
                             const RollingShutterCamera& camera, const AckermannMotion& motion, int thickness = 2);

//! @}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_DRAW_HPP
