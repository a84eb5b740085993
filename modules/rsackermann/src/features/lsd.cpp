// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "detectors.hpp"

namespace cv { namespace rsackermann {

void detectLSD(const Mat& gray, double scale, std::vector<Vec4f>& segments)
{
    detectLSDSegments(gray, scale, segments);

    // The detector scales coordinates back about the corner of the image instead of the corner of its first pixel,
    // whose centre is at 0.
    const float shift = float(0.5 / scale - 0.5);
    for (size_t i = 0; i < segments.size(); i++)
        segments[i] += Vec4f::all(shift);
}

}} // namespace cv::rsackermann
