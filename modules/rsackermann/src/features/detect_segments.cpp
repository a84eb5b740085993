// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "segment_finder.hpp"

namespace cv { namespace rsackermann {

void detectSegments(InputArray image_, OutputArray segments_, int detector, double minLength)
{
    CV_INSTRUMENT_REGION();
    SegmentFinder().find(image_, detector, minLength, segments_);
}

}} // namespace cv::rsackermann
