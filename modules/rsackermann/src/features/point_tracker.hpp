// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FEATURES_POINT_TRACKER_HPP
#define OPENCV_RSACKERMANN_SRC_FEATURES_POINT_TRACKER_HPP

#include "opencv2/core.hpp"
#include <functional>

namespace cv { namespace rsackermann {

//! For the motion: points are still located to a tenth of a pixel of the result. For the inverse-depth offset, which
//! more points show better, twice as fine if there is time.
const size_t COARSE_PIXELS = 300000;

const double POINT_SIGMA = 1.5; //!< pixels, residuals of points of the scene, which are off its planes

//! A point of the scene in the present raw image and in another one, pixels.
struct PointPair
{
    Point2d other, now;
};

//! Least share of the points that are found again, and of those that agree with one motion, in frames of one scene.
const double SAME_SCENE = 0.3;

//! Where a point of the raw present image is expected in another one. Empty: at the same place.
typedef std::function<Point2d(const Point2d& now)> PointPrediction;

//! Of which the one counts from which most points are found.
struct PointPredictions
{
    std::vector<PointPrediction> all = {PointPrediction()};
    double enough = 1; //!< share of points that makes those after it needless
};

/** Tracks points of the present image in the one before and, if it is there, in the one after.

Points are spread over the image: one for each cell of a grid, if there is one with texture in all directions. They are
looked for in the present image and followed from where they are expected, and back; those that don't return are left
out.
*/
class PointTracker
{
public:
    //! @param maxPixels larger images are halved.
    explicit PointTracker(size_t maxPixels_) : maxPixels(maxPixels_), levels(0), scale(1) {}

    /** @param gray present image, 8 bit, which may have been made smaller by scale.
    @param pairs receives the points, in pixels of the raw images; none for the first image. */
    void track(const Mat& gray, int scale, std::vector<PointPair>& pairs,
               const PointPredictions& predictions = PointPredictions());

    //! The same for the image after the one that track() had last.
    void trackNext(const Mat& gray, std::vector<PointPair>& pairs,
                   const PointPredictions& predictions = PointPredictions());

    //! Number of points that the last image has.
    size_t pointCount() const { return points.size(); }

    //! Pixels to each side of a point on which its displacement rests, in images of this size.
    static double reach(const Size& imageSize, size_t maxPixels);

    //! The next image belongs to another sequence.
    void reset() { now.clear(); }

private:
    int makePyramid(const Mat& gray, std::vector<Mat>& pyramid, Mat& image);
    void findPoints(const Mat& gray);
    Point2f centreOf(const Point2f& point) const;
    void follow(const std::vector<Mat>& to, const PointPredictions& predictions, std::vector<PointPair>& pairs);
    void followAll(const std::vector<Mat>& to, const PointPredictions& predictions, std::vector<PointPair>& pairs);
    void follow(const std::vector<Mat>& to, const PointPrediction& predict, std::vector<PointPair>& pairs);

    size_t maxPixels;
    std::vector<Mat> before, now; // pyramids, each level with its gradients
    int levels, scale;            // of the present one
    Mat smaller[2], half, response;
    std::vector<Point2f> points, predicted, there, returned;
    std::vector<uchar> found, foundAgain;
    std::vector<float> error;
    std::vector<PointPair> tried;
    Mat exposed; // another image as if with the exposure of the present one
    std::vector<Mat> exposedPyramid;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_POINT_TRACKER_HPP
