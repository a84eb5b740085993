// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FEATURES_SEGMENT_FINDER_HPP
#define OPENCV_RSACKERMANN_SRC_FEATURES_SEGMENT_FINDER_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

/** Finds line segments as detectSegments() does, with buffers that serve the next image, too.

Time counts here: nearly all that a correction takes is detection.
-# Large images are halved until they have MAX_PIXELS or less. Straight lines can still be seen then.
-# Unless that is the image itself and LSD searches it, it is cut into strips, of which threads work off one each. Lines
that are nearly vertical, which the estimation is about, are seldom cut. The strips depend on the size of the image, not
on the number of threads.
-# DETECTOR_VERTICALS has strips of its own, and fits its edges to the image itself.
-# The ends of the others are then refined in the image itself. Those of LSD in it are nearly as exact: they lean by
about a hundredth too little, which is nothing for one image and something for a calibration from many.
*/
class SegmentFinder
{
public:
    //! @param isForMany_ whether many images are used together: then ends are refined that are nearly as exact already,
    //! and without what else is at the ends.
    explicit SegmentFinder(bool isForMany_ = false) : isForMany(isForMany_), scale(1) {}

    //! Arguments as in detectSegments().
    void find(InputArray image, int detector, double minLength, OutputArray segments);

    //! Prepares an image that checkImage() accepts and whose segments are known: for reduced().
    void prepare(InputArray image);

    //! The last image in 8 bit grey, smaller by reduction(); the next image or the end of the caller's one invalidates
    //! it.
    const Mat& reduced() const { return small; }

    //! Forgets the image, which belongs to the caller.
    void release() { gray = small = Mat(); }

    int reduction() const { return scale; }

private:
    enum { MAX_PIXELS = 800000, STRIP_WIDTH = 480, OVERLAP = 48 };

    const Mat& toGray(const Mat& image);
    const Mat& shrink(const Mat& image);
    void findInStrips(const Mat& image, int count, int detector, double minLength, double detectorScale);
    void findAndRefine(int detector, double minLength);
    void keepLong(double minLength);

    bool isForMany;
    Mat gray8U, gray16U, half[2];
    Mat gray, small; // headers of one of these, or of the image
    int scale;
    std::vector<Mat> strips;
    std::vector<std::vector<Vec4f>> foundInStrips;
    std::vector<Vec4f> found;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_SEGMENT_FINDER_HPP
