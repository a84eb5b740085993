// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "opencv2/imgproc.hpp"
#include "detectors.hpp"

namespace cv {
namespace rsackermann {

void detectLSD(const Mat& gray, std::vector<Vec4f>& segments)
{
    createLineSegmentDetector(LSD_REFINE_STD)->detect(gray, segments);
}

}} // namespace cv::rsackermann
