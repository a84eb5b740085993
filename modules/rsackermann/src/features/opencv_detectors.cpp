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

#ifdef HAVE_OPENCV_XIMGPROC

void detectFLD(const Mat& gray, double minLength, std::vector<Vec4f>& segments)
{
    // Distance of pixels to their segment, thresholds and aperture of Canny are the defaults of FastLineDetector.
    const int length = std::max(1, cvFloor(minLength));
    ximgproc::createFastLineDetector(length, 1.414213562f, 50, 50, 3, false)->detect(gray, segments);
}

static size_t longestChain(const std::vector<std::vector<Point>>& chains)
{
    size_t longest = 0;
    for (size_t i = 0; i < chains.size(); i++)
        longest = std::max(longest, chains[i].size());
    return longest;
}

void detectEDLines(const Mat& gray, double minLength, std::vector<Vec4f>& segments)
{
    const Ptr<ximgproc::EdgeDrawing> detector = ximgproc::createEdgeDrawing();
    ximgproc::EdgeDrawing::Params params;
    params.MinLineLength = std::max(1, cvFloor(minLength));
    detector->setParams(params);

    // EdgeDrawing::detectLines writes past the end of its buffers if a chain of edge pixels is longer than that; a
    // wider image has longer buffers.
    const size_t buffersPerSide = 8;
    Mat image = gray;
    for (;;)
    {
        detector->detectEdges(image);
        const size_t longest = longestChain(detector->getSegments());
        const size_t sides = image.rows + image.cols;
        if (longest <= buffersPerSide * sides)
            break;
        Mat wider;
        copyMakeBorder(image, wider, 0, 0, 0, int(longest / buffersPerSide + 1 - sides), BORDER_REPLICATE);
        image = wider;
    }
    detector->detectLines(segments);
}

#else

void detectFLD(const Mat&, double, std::vector<Vec4f>&)
{
    CV_Error(Error::StsNotImplemented, "DETECTOR_FLD needs the module ximgproc, without which this library was built");
}

void detectEDLines(const Mat&, double, std::vector<Vec4f>&)
{
    CV_Error(Error::StsNotImplemented,
             "DETECTOR_EDLINES needs the module ximgproc, without which this library was built");
}

#endif

}} // namespace cv::rsackermann
