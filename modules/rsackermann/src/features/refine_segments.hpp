// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FEATURES_REFINE_SEGMENTS_HPP
#define OPENCV_RSACKERMANN_SRC_FEATURES_REFINE_SEGMENTS_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

/** Moves segments onto the edges that they are images of, to a fraction of a pixel.

Across each segment the place of the edge is measured at many points, and a line is fitted to the places. The ends move
along the normal of the segment only. A segment along which there is no edge stays as it is.
@param gray CV_8UC1.
@param steps the further away the ends are, the more it takes.
@param usesEnds whether the edge is looked for up to the ends. Edges that begin there make short segments lean by some
hundredths of a degree, all of a wall to the same side; without the ends what is left of short ones errs more.
@param segments (x1, y1, x2, y2) within some pixels of the edges.
*/
void refineSegments(const Mat& gray, int steps, bool usesEnds, std::vector<Vec4f>& segments);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_REFINE_SEGMENTS_HPP
