// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "detectors.hpp"

namespace cv { namespace rsackermann {

#ifdef HAVE_OPENCV_XIMGPROC
void detectFLD(const Mat& gray, double minLength, std::vector<Vec4f>& segments)
{
    // Distance of pixels to their segment, thresholds and aperture of Canny are the defaults of FastLineDetector.
    const int length = std::max(1, cvFloor(minLength));
    ximgproc::createFastLineDetector(length, 1.414213562f, 50, 50, 3, false)->detect(gray, segments);
}
#else
void detectFLD(const Mat&, double, std::vector<Vec4f>&)
{
    CV_Error(Error::StsNotImplemented, "DETECTOR_FLD needs the module ximgproc, without which this library was built");
}
#endif

}} // namespace cv::rsackermann
