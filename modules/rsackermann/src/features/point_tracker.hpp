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
    //! In what direction, and by how much, the texture determines the place less than across it: the covariance is
    //! that across times I + weak weak^T. 0: by as much in all directions.
    Point2d weak;

    PointPair() {}
    PointPair(const Point2d& other_, const Point2d& now_, const Point2d& weak_ = Point2d())
        : other(other_), now(now_), weak(weak_)
    {
    }
};

//! Least share of the points that are found again, and of those that agree with one motion, in frames of one scene.
const double SAME_SCENE = 0.3;

//! Where a point of the raw present image is expected in another one. Empty: at the same place.
typedef std::function<Point2d(const Point2d& now)> PointPrediction;

//! A point counts where the prediction by which most points are found finds it, or else the next one.
struct PointPredictions
{
    std::vector<PointPrediction> all = {PointPrediction()};
    double enough = 1; //!< share of points that makes the other predictions needless
};

/** Tracks points of the present image in others: the one before, the one after, and one that was kept.

Points are spread over the image: one for each cell of a grid, if there is one with texture in all directions. They are
looked for in the present image and followed from where they are expected, and back; those that don't return are left
out.
*/
class PointTracker
{
public:
    enum Other {
        NEIGHBOUR, //!< the image before or, after setNext(), the one after
        KEPT
    };

    //! @param maxPixels larger images are halved.
    explicit PointTracker(size_t maxPixels_) : maxPixels(maxPixels_), levels(0), scale(1) {}

    //! Sets the present image, 8 bit, which may have been made smaller by scale. The last one is that before it.
    void set(const Mat& gray, int scale);

    //! Sets the image after the present one, of the same scale: that takes the place of the one before.
    void setNext(const Mat& gray);

    //! @param pairs receives the points, in pixels of the raw images; none if there is no such image.
    void track(Other other, std::vector<PointPair>& pairs, const PointPredictions& predictions = PointPredictions());

    //! Keeps the image before. @return whether it had points.
    bool keepBefore();

    void forgetKept() { kept.clear(); }

    //! Number of points that the last image has.
    size_t pointCount() const { return points.size(); }

    //! Pixels to each side of a point on which its displacement rests, in images of this size.
    static double reach(const Size& imageSize, size_t maxPixels);

    //! The next image belongs to another sequence.
    void reset()
    {
        now.clear();
        forgetKept();
        points.clear();
    }

private:
    int makePyramid(const Mat& gray, std::vector<Mat>& pyramid, Mat& image);
    void findPoints(const Mat& gray);
    Point2f centreOf(const Point2f& point, Point2d& weak) const;
    struct Found
    {
        std::vector<PointPair> pairs;
        std::vector<size_t> points; // of these
    };

    void follow(const std::vector<Mat>& to, const PointPredictions& predictions, std::vector<PointPair>& pairs);
    void followAll(const std::vector<Mat>& to, const PointPredictions& predictions, std::vector<PointPair>& pairs);
    void follow(const std::vector<Mat>& to, const PointPrediction& predict, Found& result);

    size_t maxPixels;
    std::vector<Mat> before, now, kept; // pyramids, each level with its gradients
    size_t pointsBefore = 0;
    int levels, scale; // of the present one
    Mat smaller[2], half, response;
    std::vector<Point2f> points, predicted, there, returned;
    std::vector<uchar> found, foundAgain, isTaken;
    std::vector<float> error;
    std::vector<Found> tried;
    std::vector<PointPair> pairsExposed;
    Mat exposed; // another image as if with the exposure of the present one
    std::vector<Mat> exposedPyramid;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_POINT_TRACKER_HPP
