// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_DRIVE_POINT_TRACKER_HPP
#define OPENCV_RSACKERMANN_SRC_DRIVE_POINT_TRACKER_HPP

#include "opencv2/core.hpp"

namespace cv {
namespace rsackermann {

//! A point of the scene in two consecutive raw images, pixels.
struct PointPair
{
    Point2d before, now;
};

/** Tracks points from the image before to the present one.

Points are spread over the image: one for each cell of a grid, if there is one with texture in all directions. They are looked for in the
present image and followed back and forth; those that don't return are left out.
*/
class PointTracker
{
public:
    /** @param gray present image, 8 bit, which may have been made smaller by scale.
    @param pairs receives the points, in pixels of the raw images; none for the first image. */
    void track(const Mat& gray, int scale, std::vector<PointPair>& pairs);

    //! The next image belongs to another sequence.
    void reset();

private:
    void findPoints(const Mat& gray);
    void follow(int levels);

    std::vector<Mat> before, now; // pyramids
    Mat smaller[2], half, response;
    std::vector<Point2f> points, past, returned;
    std::vector<uchar> found, foundAgain;
    std::vector<float> error;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_DRIVE_POINT_TRACKER_HPP
