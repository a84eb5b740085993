// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_ROW_RATES_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_ROW_RATES_HPP

#include "frame_fit.hpp"

namespace cv { namespace rsackermann {

//! Seconds in which a camera shakes alike, and the bias and the delay of a gyro stay.
const double RATE_MEMORY = 10;

//! A rate at one instant, or its mean, with its standard deviation, per second; 0: not known.
struct InstantRate
{
    double value, sigma;
    double growth = 0; //!< of the rate, per second squared

    explicit InstantRate(double value_ = 0, double sigma_ = 0) : value(value_), sigma(sigma_) {}
};

//! For which what is assumed of a whole drive counts beside what its frames show.
const double ASSUMED_FRAMES = 4;

/** The rate of a turn at the present frame, by its means over the intervals between frames and by how the rows show it
to change (doc/theory.md, "Rates of rows").

Means follow each other as those of a damped oscillator that noise drives, a suspension that swings or an arm that
shakes: an autoregression of second order, whose coefficients are those of the sequence. What rows show counts as far as
the means confirm it. Both by least squares with a fading memory.
*/
class RateProcess
{
public:
    RateProcess();

    /** Adds the mean rate over the interval that ends at the present frame, with its error.
    @param change by how much faster the present frame turns than the one before, as its rows show.
    @param interval seconds, of any sign. */
    void add(const InstantRate& mean, double change, double interval);

    //! The square of a change over an interval in seconds that is expected while none is known.
    void expectChange(double square, double interval);

    //! The next mean doesn't follow the last one.
    void interrupt() { known = 0; }

    /** The mean rate while the present frame is read, between the last mean and the next one.
    @param read half of the time in which it is read, over the interval. */
    InstantRate now(double read) const;

    /** The same if the next mean is measured, too.
    @param change by how much faster the present frame turns than the next one.
    @param share of the difference to the last mean that has passed. */
    InstantRate now(double next, double change, double share, double read) const;

    //! How fast the rate at the present frame grows: evenly from the last mean to the next one.
    double growth(double next, double share) const;

    //! By how much the rate at the present frame is above the last mean, as rows show.
    InstantRate beyondLast() const;

    //! The same above the mean of both sides.
    InstantRate beyondMeans(double changeToNext, double share) const;

    //! What counts of that, as far as means confirm it.
    InstantRate beyond(double byRows) const;

    /** Standard deviation of the change of the rate from frame to frame.
    @param interval seconds between them, of any sign.
    @param usual that of a camera of which nothing is known. */
    double expectedChange(double interval, double usual) const;

    /** Standard deviation of the growth, per second squared, of a rate that grows evenly over an interval in seconds
    and turns as much as this one does, which wanders.
    @param usual that of a camera of which nothing is known; it counts as some frames do. */
    double expectedGrowth(double interval, double usual) const;

    //! Standard deviation of the rate at the present frame about 0, if nothing but changes is known.
    //! @param change that rows show.
    double aboutNothing(double change, double read) const;

    //! Standard deviation of the rate at the present frame about the true last mean, over an interval in seconds, with
    //! what rows show.
    double aboutLast(double interval, double read) const;

    //! The same about the mean of both sides.
    double aboutMeans(double read) const;

private:
    double predict() const;
    double trust() const;
    double variance(double square, double unknown, double ifShown, double part) const;
    double meanShown() const;
    double meanSquare() const;
    double differenceAfter(double interval) const;

    Matx22d products;               // of the two means before
    Vec2d response;                 // their products with the mean that follows
    double count, pairs;            // of the means with two before, and with one; those that are forgotten count less
    double changes, seconds;        // squares of the differences of neighbouring means, and their intervals
    double errors;                  // squares of those of predictions
    double shown, shownCount;       // sum of the changes that rows have shown, and their number
    double shownSquares, confirmed; // of these changes, and their products with those of the means
    Vec2d past;                     // the last mean and the one before
    double noise;                   // variance of the last mean's error
    double change;                  // that rows have shown last, without its mean
    double lastInterval;            // seconds
    int known;                      // of the last two means
};

//! Standard deviations of an instant about means between frames.
struct AboutFit
{
    double yawRate, speed;
};

//! How a gyro has measured that the rows of a frame turn.
struct MeasuredTurns
{
    InstantRate pitch, roll, yaw;
    Mat curve; //!< AckermannMotion::rotationCurve: what rates don't tell
};

//! How fast a camera turns while an image is read, from the turns between the frames of a sequence.
class RowRates
{
public:
    /** @param steering (rad/s)^2 per second: the mean square by which means of the yaw rate over two intervals differ,
    over the interval, until frames have shown it. */
    explicit RowRates(double steering = 0);

    //! That of usual cars.
    static double usualSteering(const AckermannEstimator::Params& params);

    /** Standard deviations of yaw rate and speed at a frame about those of its fit, with what the frames before have
    shown.
    @param before,after seconds from the frame before and to the one after; 0: there is none.
    @param readOut seconds in which a frame is read. */
    AboutFit aboutFit(double before, double after, double readOut) const;

    /** Goes on to a frame.
    @param before seconds from the frame before; negative if that was taken later.
    @param after seconds to the frame after; 0: no points are seen in it.
    @param readOut seconds in which a frame is read. */
    void update(const SequenceFit& fit, double before, double after, double readOut);

    //! A frame without turns.
    void interrupt();

    /** A frame with turns to the next one only: how fast a camera pitches and rolls lets expect how it shakes.
    @param after seconds to the next frame.
    @param readOut seconds in which a frame is read. */
    void begin(const SequenceFit& fit, double after, double readOut);

    //! Sets by how much the rates of pitch and roll change from frame to frame.
    void expectChanges(double interval, FitNuisances& nuisances) const;

    //! Of the present frame, by a gyro.
    void set(const MeasuredTurns& measured);

    /** Turns yaw rate and speed of a fit into those of the instant, by what rows show or a gyro has measured.
    @param given those of the instant, which the state has met with the additional variances of aboutFit(). */
    void toInstant(const MotionPrior& given, SequenceState& state) const;

    //! Sets the rates of roll and pitch of a motion, and how its rows turn beyond these.
    void toMotion(const RollingShutterCamera& camera, AckermannMotion& motion) const;

private:
    Mat curveOf(const RollingShutterCamera& camera) const;
    void setSigmas(const AboutFit& about);

    double steering;
    RateProcess pitch, roll, yaw, speed;
    InstantRate pitchNow, rollNow, yawNow;
    InstantRate yawBeyond, speedBeyond; // than those of the fit
    Mat curve;                          // by a gyro
    bool isMeasured = false;            // yawNow and the curve
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_ROW_RATES_HPP
