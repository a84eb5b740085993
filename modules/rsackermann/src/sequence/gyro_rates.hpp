// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_GYRO_RATES_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_GYRO_RATES_HPP

#include "../features/frame_features.hpp"
#include "gyro_samples.hpp"
#include "row_rates.hpp"
#include "opencv2/rsackermann/camera.hpp"
#include <deque>

namespace cv { namespace rsackermann {

//! Times of rows from the reference row, in seconds.
struct RowSpan
{
    double from, to;

    RowSpan(double from_, double to_) : from(from_), to(to_) {}
    //! All rows of an image.
    explicit RowSpan(const RollingShutterCamera& camera);
};

//! How a camera has turned between two frames, by the points that are seen in both.
struct TurnOfPoints
{
    double begin, end; // seconds, of both reference rows
    RowSpan rows;      // on which the points are seen
    Vec3d rate;        // mean, rad/s about the axes of the camera
    Vec3d variance;    // of the rate, beside the noise that all turns have
    Vec3d lasting;     // standard deviations of the part of it that the turns of a second share

    TurnOfPoints() : begin(0), end(0), rows(0, 0) {}
    TurnOfPoints(double begin_, double end_, const RowSpan& rows_, const Vec3d& rate_)
        : begin(begin_), end(end_), rows(rows_), rate(rate_)
    {
    }

    /** As the fit of a frame has found it.
    @param values of the fit, FLOW_VALUES of them.
    @param turns to the neighbour, with the changes that rows show: a yaw that changes looks like a roll otherwise.
    @param seconds time of the frame.
    @param neighbour seconds from there to the other frame, negative if it is earlier.
    @param yawSigma standard deviation of the fit's yaw rate beside that of the turn: a camera that looks sideways
    hardly tells a turn from the way.
    @param lastingSigma that of its part that the frames before had already, and the next ones will have.
    */
    TurnOfPoints(const RollingShutterCamera& camera, const std::vector<TrackedBearing>& bearings, const double* values,
                 const NeighbourTurns& turns, double seconds, double neighbour, double yawSigma = 0,
                 double lastingSigma = 0);
};

//! What is between a gyro and the camera, as the points of a sequence show it.
struct GyroAlignment
{
    double delay = 0; //!< seconds by which the gyro's clock is ahead of the camera's
    Vec3d turn;       //!< by which the gyro's axes differ from those of the camera, radians
    Vec3d bias;       //!< rad/s that the gyro shows too little
    //! Of what images show of pitch and yaw to what the gyro does: the true focal length over the given.
    double scale = 1;

    //! As the images show it, about the axes of the camera. @param angle that the gyro has turned in some seconds.
    Vec3d toCamera(const Vec3d& angle, double seconds) const
    {
        const Vec3d turned = angle + turn.cross(angle);
        return Vec3d(scale * turned[0], scale * turned[1], turned[2]) + bias * seconds;
    }
};

//! Standard deviations of the same before the points have shown anything.
struct GyroSigmas
{
    double delay = 0.02, axes = 2 * CV_PI / 180, bias = 1 * CV_PI / 180, scale = 0.03;
};

//! Rates and their standard deviations about the axes of the camera, rad/s.
struct CameraRates
{
    Vec3d value, sigma;

    //! The same about axes that are turned. @param rotation camera frame to their frame.
    void about(const Matx33d& rotation, InstantRate& x, InstantRate& y, InstantRate& z) const;
};

/** A gyro on the camera (doc/theory.md, "Gyro").

Its bias, the direction of its axes and the delay of its clock are those that explain best how the points of the last
seconds have turned.
*/
class GyroRates
{
public:
    GyroRates();

    GyroSamples samples;

    void setSigmas(const GyroSigmas& sigmas);

    //! Another sequence, with another clock.
    void reset();

    //! Adds what the points have shown between two frames.
    void add(const TurnOfPoints& turn);

    /** The rates that turn the rows of a frame: their mean over what the clock may be.
    @return false if there are no samples, or the points contradict what they say of the turn to this frame. */
    bool at(double seconds, const RowSpan& rows, CameraRates& rates) const;

    /** How rows turn beyond these rates: rotation vectors at equal steps from one row to another.
    @param rates of the same frame.
    @param first,last seconds of the rows from the reference row.
    @param rotation camera frame to that of the vectors.
    @return of AckermannMotion::rotationCurve; empty if samples are missing. */
    Mat curve(double seconds, const CameraRates& rates, double first, double last, const Matx33d& rotation) const;

    //! Whether the gyro explains little of what the points show: then it's of no use.
    bool contradicts() const;
    //! Whether it even differs from them so much that something is wrong.
    bool isWrong() const;
    const GyroAlignment& alignment() const { return found; }
    enum { UNKNOWNS = 8 };
    //! Of a delay, a turn, a bias and a scale.
    Vec<double, UNKNOWNS> alignmentSigma() const;

private:
    bool contradictsScale() const;

    struct Instant
    {
        double time, probability;
    };

    std::vector<Instant> instantsOf(double seconds, const RowSpan& rows) const;
    bool expected(const TurnOfPoints& turn, double delay, Vec3d& rate) const;
    bool expected(const TurnOfPoints& turn, double delay, Vec3d& rate, Vec3d& slope) const;
    void judge(const TurnOfPoints& turn);
    void align();
    double shareLeft(double delay) const;
    bool findDelay();

    Vec<double, UNKNOWNS> prior; // standard deviations of delay, turn, bias and scale
    std::deque<TurnOfPoints> turns;
    double start; // the delay that is expected
    GyroAlignment found;
    Matx<double, UNKNOWNS, UNKNOWNS> covariance; // of delay, turn, bias and scale
    Vec<double, UNKNOWNS> lasting;               // by which turns that all err by lasting ones are mistaken for it
    Vec3d noise;                       // standard deviation of what the gyro leaves of the turns of points, rad/s
    double contraryBegin, contraryEnd; // seconds, of the last turn if the gyro contradicts it
    Vec3d meanTurn;                    // of the points, rad/s
    double count;                      // of the turns; those that are forgotten count less
    size_t unexplainedFrames;          // in a row, or without samples, since a delay was looked for
    Vec3d left, unexplained;           // losses of their predictions with the gyro and without it, about each axis
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_GYRO_RATES_HPP
