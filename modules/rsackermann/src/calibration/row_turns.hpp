// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CALIBRATION_ROW_TURNS_HPP
#define OPENCV_RSACKERMANN_SRC_CALIBRATION_ROW_TURNS_HPP

#include "../features/upright_segment.hpp"
#include "../sequence/gyro_rates.hpp"

namespace cv { namespace rsackermann {

/** How the rows of a frame and of the one before have turned since the middle of their frames beyond a steady yaw rate,
by a gyro or by the frames around them (doc/theory.md, "Self-calibration"): the longer the read-out, the more. */
class RowTurns
{
public:
    //! Unknown ones.
    RowTurns() : samples(0), givenUnit(0), startUnit(0), interval(0), middle(0), isGyro(false) {}

    /** @param samples_ must exist as long as this object.
    @param isGyro_ whether they are measured. If not, they don't show the line delay: curves that are smoother than the
    truth would make it too long.
    @param bearings of the points: at their mean row the clocks agree, whatever the line delay.
    @param unit of the row time in seconds, with which the clocks were compared.
    @param seconds time of the frame.
    @param interval_ since the frame before. */
    RowTurns(const GyroSamples& samples_, const GyroAlignment& alignment_, bool isGyro_,
             const RollingShutterCamera& camera, double unit, const std::vector<TrackedBearing>& bearings,
             double seconds, double interval_);

    bool known() const { return samples != 0; }
    bool showDelay() const { return known() && isGyro; }

    //! A point as it would be seen without them. @param unit seconds per unit of row time.
    TrackedBearing removedFrom(const TrackedBearing& point, double unit) const;
    UprightSegment removedFrom(const UprightSegment& vertical, double unit) const; //!< the same

    //! By how much the rows at a time after the middle one turn otherwise than steadily. @param after seconds.
    Vec3d unsteadyTurn(double after) const;
    //! The gyro's clock is later by that.
    void delayBy(double seconds);
    //! Of the turns about each axis only a share counts from now on.
    void take(const Vec3d& share_) { share = share_; }

private:
    struct Instant
    {
        double seconds; // of the gyro's clock
        Vec3d angle;    // about the gyro's axes
    };
    Instant at(double seconds) const
    {
        return {seconds, samples->angleAt(std::min(std::max(seconds, covered[0]), covered[1]))};
    }
    Vec3d turned(const Instant& begin, const Instant& end) const;
    Vec3d steadyTurn(double after) const;
    Point2d atMiddle(const Point2d& p, const Instant& middleOfFrame, double after) const;

    const GyroSamples* samples;
    GyroAlignment alignment;
    Matx33d toUpright;
    double givenUnit, startUnit, interval;
    double middle;                 // row time
    Instant now = {}, before = {}; // the middles of both frames
    Vec2d covered;                 // by samples; rows of longer line delays, which are tried, turn no further
    bool isGyro;
    Vec3d share = Vec3d::all(1);
    Vec3d ofFrame; // turn from the middle of the frame before, about the upright axes
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CALIBRATION_ROW_TURNS_HPP
