// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FEATURES_FRAME_FEATURES_HPP
#define OPENCV_RSACKERMANN_SRC_FEATURES_FRAME_FEATURES_HPP

#include "../motion/sequence_values.hpp"
#include "point_tracker.hpp"
#include "upright_segment.hpp"

namespace cv { namespace rsackermann {

const size_t LEAST_POINTS = 20;

//! A tracked point as upright bearings with z = 1, and the row times at which it was seen, from the present reference
//! row.
struct TrackedBearing
{
    Point2d other, now;
    double timeOther, timeNow;
    int pitch, roll; // the turns of the other frame, among FLOW_VALUES
    bool isStill;    // at the same place of both images, to POINT_SIGMA
    Point2d weak;    // of PointPair, in the axes of the bearings
};

/** Adds the bearings of points; none without a line delay.
@param seconds from the other frame's reference row to the present one; negative if the other frame comes after. */
void addBearings(const RollingShutterCamera& camera, const std::vector<PointPair>& pairs, double seconds,
                 std::vector<TrackedBearing>& bearings);

//! Where points are expected in an image that was taken some seconds before the present one.
struct FramePrediction
{
    typedef std::function<Point2d(const Point2d& now, double seconds)> Function;

    Function known;     //!< by the frames before; empty if there are none
    Function knownKept; //!< by those up to the frame that is kept, see FrameFeatures::LOST
    Function usual;     //!< of any scene, in which the car may as well stand; empty: nothing is usual
    //! By the motion that most of the points in another image show, and how many; empty if they show none.
    struct Shown
    {
        Function function;
        double agreeing;
    };
    std::function<Shown(const std::vector<TrackedBearing>& bearings)> shown;

    //! @param known that of the scene, or empty.
    PointPredictions at(double seconds, const Function& known) const;
};

//! A frame in 8 bit grey, smaller by scale; empty: points aren't tracked in it.
struct GrayFrame
{
    Mat gray;
    int scale;
    double seconds; // time of its reference row

    GrayFrame() : scale(1), seconds(0) {}
    GrayFrame(const Mat& gray_, int scale_, double seconds_) : gray(gray_), scale(scale_), seconds(seconds_) {}
};

//! What a frame of a sequence shows: points that are seen in its neighbours as well, and candidates for verticals.
class FrameFeatures
{
public:
    //! What the frame before is good for: a frame may be damaged, or the first one of another scene. The next one shows
    //! which.
    enum Link {
        FOLLOWS,
        LOST,       //!< hardly any of its points are found: the frame before it is kept
        STILL_LOST, //!< nor are they in that one, or there is none
        BRIDGED     //!< they are found in that one, and in no other
    };

    std::vector<TrackedBearing> bearings,
        fineBearings; // those of the fit, and of the inverse-depth offset if there is time for more
    std::vector<UprightSegment> verticals, others; // of selectCandidates()

    FrameFeatures() : tracker(COARSE_PIXELS), fineTracker(4 * COARSE_PIXELS) {}

    /** Tracks points in the frame before, if that belongs to the same scene, and in the one after.
    @param passed seconds since the frame before.
    @param next empty if it isn't known. */
    Link track(const RollingShutterCamera& camera, const GrayFrame& frame, double passed,
               const FramePrediction& predict, const GrayFrame& next = GrayFrame());

    //! Points that somebody else has tracked in the frame before: images of other frames don't count any more.
    void setPoints(const RollingShutterCamera& camera, const std::vector<PointPair>& tracked, double passed);

    //! Whether there is so much to track that next to nothing of it in the frame before means another scene, or that
    //! there is no such frame.
    bool isFirstOfScene() const;

    //! Whether there is a frame to go back to.
    bool isKept() const { return std::isfinite(keptSeconds); }

    //! The frame before was taken so many seconds earlier than it seemed; negative: later.
    void putBack(const RollingShutterCamera& camera, double passed, double seconds);

    //! Leaves out what is seen in the frame that was taken some seconds before; negative: after.
    void leaveOut(double seconds);

    //! The next frame belongs to another sequence.
    void reset();

private:
    bool find(const RollingShutterCamera& camera, PointTracker& points, PointTracker::Other other, double seconds,
              const FramePrediction::Function& known, const FramePrediction& predict,
              std::vector<TrackedBearing>& found);
    FramePrediction::Shown show(const RollingShutterCamera& camera, double seconds,
                                const FramePrediction& predict) const;
    bool findMore(const RollingShutterCamera& camera, PointTracker& points, PointTracker::Other other, double seconds,
                  const FramePrediction& predict);
    Link bridge(const RollingShutterCamera& camera, const GrayFrame& frame, double passed,
                const FramePrediction& predict);

    PointTracker tracker, fineTracker;
    double keptSeconds = std::numeric_limits<double>::quiet_NaN(); // time of the frame that is kept, if it is finite
    std::vector<PointPair> pairs;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FEATURES_FRAME_FEATURES_HPP
