// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "row_rates.hpp"

namespace cv { namespace rsackermann {

RateProcess::RateProcess()
    : products(Matx33d::zeros()), count(0), pairs(0), changes(0), errors(0), shown(0), shownCount(0), known(0)
{
}

// The next mean.
double RateProcess::predict() const
{
    if (!(products(0, 0) > 0))
        return 0;
    // Coefficients of 0 weigh as much as some frames do.
    const double prior = ASSUMED_FRAMES / count, least = 1e-12; // if rows show nothing
    Matx33d information = products;
    information(0, 0) += prior * products(0, 0);
    information(1, 1) += prior * products(0, 0);
    information(2, 2) += prior * products(2, 2) + least;
    return (information.inv() * response).dot(past);
}

void RateProcess::add(double rate, double change, double interval)
{
    const double kept = std::exp(-std::abs(interval) / RATE_MEMORY);
    if (known > 0)
    {
        const double difference = rate - past[0];
        changes = kept * changes + difference * difference;
        pairs = kept * pairs + 1;
    }
    if (known > 1)
    {
        const double error = rate - predict();
        products = kept * products + past * past.t();
        response = kept * response + rate * past;
        count = kept * count + 1;
        errors = kept * errors + error * error;
    }
    // In the long run rates don't change: what is left of the mean is not of turns, but of the scene.
    shown = kept * shown + change;
    shownCount = kept * shownCount + 1;
    past = Vec3d(rate, known > 0 ? past[0] : 0, change - shown / (shownCount + ASSUMED_FRAMES));
    known = std::min(known + 1, 2);
}

void RateProcess::expectChange(double square)
{
    if (pairs > 0)
        return;
    changes = square;
    pairs = 1;
}

// Of a rate that wanders, the mean of the means on both sides misses the instant by half of their difference.
InstantRate RateProcess::now() const
{
    InstantRate result;
    if (count > 0 && known > 0)
    {
        result.value = (past[0] + predict()) / 2;
        result.sigma = std::sqrt(changes / pairs + errors / count) / 2;
    }
    return result;
}

InstantRate RateProcess::now(double next, double share) const
{
    InstantRate result;
    if (known > 0)
    {
        const double change = next - past[0];
        result.value = past[0] + share * change;
        result.sigma = std::sqrt((changes + change * change) / (pairs + 1)) / 2;
    }
    return result;
}

void RowRates::update(const SequenceFit& fit, double before, double after)
{
    isMeasured = false;
    curve.release();
    // Turns are counted from a frame to one that was taken later.
    const bool backward = before < 0;
    const double earlier = std::abs(before), later = std::abs(after), share = earlier / (earlier + later);
    const auto follow = [&](RateProcess& process, int ofBefore, int ofAfter) {
        const double next = -fit.values[ofAfter] / (backward ? earlier : later),
                     previous = fit.values[ofBefore] / (backward ? later : earlier);
        process.add(backward ? next : previous, fit.values[changeOf(backward ? ofAfter : ofBefore)], before);
        return after != 0 ? process.now(backward ? previous : next, share) : process.now();
    };
    pitchNow = follow(pitch, FLOW_PITCH_BEFORE, FLOW_PITCH_AFTER);
    rollNow = follow(roll, FLOW_ROLL_BEFORE, FLOW_ROLL_AFTER);

    yaw.add(fit.values[SEQUENCE_YAW_RATE] - fit.values[FLOW_YAW_CHANGE] * before / 2, 0, before);
    // The fit has met the next frame, too: of the mean of both sides it is half the variance.
    yawSigma = yaw.wandering() * (after != 0 ? std::sqrt(0.5) : 1);
}

void RowRates::interrupt()
{
    pitch.interrupt();
    roll.interrupt();
    yaw.interrupt();
    pitchNow = rollNow = InstantRate();
    curve.release();
    yawSigma = 0;
    isMeasured = false;
}

// Means that don't depend on each other differ by twice their variance, and shaking is taken to be alike about all
// axes.
void RowRates::begin(const SequenceFit& fit, double after)
{
    interrupt();
    const double ofPitch = fit.values[FLOW_PITCH_AFTER] / after, ofRoll = fit.values[FLOW_ROLL_AFTER] / after;
    yaw.expectChange(ofPitch * ofPitch + ofRoll * ofRoll);
    yawSigma = yaw.wandering();
}

void RowRates::set(const MeasuredTurns& measured)
{
    pitchNow = measured.pitch;
    rollNow = measured.roll;
    yawNow = measured.yaw;
    curve = measured.curve;
    yawSigma = 0;
    isMeasured = true;
}

// The other values are those of the interval, whatever the instant's yaw rate.
void RowRates::toState(SequenceState& state) const
{
    if (!isMeasured)
        return;
    state.value[SEQUENCE_YAW_RATE] = yawNow.value;
    const double share = yawNow.sigma / std::sqrt(state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE));
    for (int i = 0; i < SEQUENCE_VALUES; i++)
    {
        state.covariance(SEQUENCE_YAW_RATE, i) *= share;
        state.covariance(i, SEQUENCE_YAW_RATE) *= share;
    }
}

void RowRates::toMotion(double unit, AckermannMotion& motion) const
{
    motion.pitchRate = pitchNow.value * unit;
    motion.rollRate = rollNow.value * unit;
    motion.pitchRateSigma = pitchNow.sigma * unit;
    motion.rollRateSigma = rollNow.sigma * unit;
    motion.rotationCurve = curve;
    const double sigma = yawSigma * unit / 2;
    motion.covariance(0, 0) += sigma * sigma;
}

}} // namespace cv::rsackermann
