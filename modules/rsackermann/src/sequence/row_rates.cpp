// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "frame_terms.hpp"
#include "row_rates.hpp"

namespace cv { namespace rsackermann {

RateProcess::RateProcess()
    : products(Matx22d::zeros()), count(0), pairs(0), changes(0), seconds(0), errors(0), shown(0), shownCount(0),
      shownSquares(0), confirmed(0), noise(0), change(0), lastInterval(0), known(0)
{
}

// The next mean.
double RateProcess::predict() const
{
    if (!(products(0, 0) > 0))
        return 0;
    // Coefficients of 0 weigh as much as some frames do, with the mean square of the rates up to the last one: where
    // shaking begins, it is the answer to hardly any.
    const double prior = ASSUMED_FRAMES * (products(0, 0) + past[0] * past[0]) / (count + 1);
    Matx22d information = products;
    information(0, 0) += prior;
    information(1, 1) += prior;
    if (known < 2) // a damped rate
        return response[0] / information(0, 0) * past[0];
    return (information.inv() * response).dot(past);
}

// The share of what rows show that is of turns, and not of a scene that differs from its planes.
double RateProcess::trust() const
{
    const double squares = count > 0 ? shownSquares * (1 + ASSUMED_FRAMES / count) : 0;
    return squares > 0 ? std::min(std::max(confirmed / squares, 0.), 1.) : 0;
}

// In the long run rates don't change: their mean change is that of the scene.
double RateProcess::meanShown() const
{
    return shown / (shownCount + ASSUMED_FRAMES);
}

void RateProcess::add(const InstantRate& mean, double shownChange, double interval)
{
    const double rate = mean.value;
    noise = mean.sigma * mean.sigma;
    lastInterval = std::abs(interval);
    const double kept = std::exp(-lastInterval / RATE_MEMORY);
    // Across missing frames means don't follow each other as they usually do.
    if (pairs > 0 && cvRound(lastInterval * pairs / seconds) > 1)
        known = 0;
    if (known > 0)
    {
        const double difference = rate - past[0];
        changes = kept * changes + difference * difference;
        seconds = kept * seconds + lastInterval;
        pairs = kept * pairs + 1;
    }
    if (known > 1)
    {
        const double error = rate - predict();
        products = kept * products + past * past.t();
        response = kept * response + rate * past;
        count = kept * count + 1;
        errors = kept * errors + error * error;
        // From the middle of both means before the last frame to that of the means around it.
        shownSquares = kept * shownSquares + change * change;
        confirmed = kept * confirmed + change * (rate - past[1]) / 2;
    }
    shown = kept * shown + shownChange;
    shownCount = kept * shownCount + 1;
    change = shownChange - meanShown();
    past = Vec2d(rate, known > 0 ? past[0] : 0);
    known = std::min(known + 1, 2);
}

double RateProcess::growth(double next, double share) const
{
    return known > 0 ? (next - past[0]) * 2 * share / lastInterval : 0;
}

// What means haven't had the time to confirm may be so.
InstantRate RateProcess::beyond(double byRows) const
{
    const double seen = trust(), open = (1 - seen) * ASSUMED_FRAMES / (count + ASSUMED_FRAMES);
    return InstantRate(seen * byRows, open * std::abs(byRows));
}

InstantRate RateProcess::beyondLast() const
{
    return beyond(change / 2);
}

InstantRate RateProcess::beyondMeans(double changeToNext, double share) const
{
    return beyond((change + share * (changeToNext - meanShown() - change)) / 2);
}

// Variances of a rate that wanders, relative to the mean square of the difference of two means: of its mean while a
// frame is read about the last mean, about that of both sides, and the same if their changes are known.
static double varianceOfLast(double read)
{
    return (1 - read + read * read / 2) / 2;
}

static double varianceOfMeans(double read)
{
    return std::pow(1 - read, 2) / 4;
}

static double shownVarianceOfLast(double read)
{
    return (std::pow(1 - read, 2) + std::pow(read, 2)) / 8;
}

static double shownVarianceOfMeans(double read)
{
    return (std::pow(1 - read, 3) + std::pow(read, 3)) / 16;
}

// By the variances of what rows don't show and of what they show, and the part of the variance of a mean's error that
// counts: means differ by their errors, too, but for those that all of them have. square: the mean square of their
// difference.
double RateProcess::variance(double square, double unknown, double ifShown, double part) const
{
    const double ofWandering = unknown + trust() * (ifShown - unknown);
    return ofWandering * (square - 2 * std::min(noise, square / 2)) + part * noise;
}

// What few differences show may be smaller than usual by chance: exp(1.5 / n) is the factor by which 95 % of Student's
// distribution with n degrees of freedom, one more than there are differences, are wider, to 4 %.
static double withChance(double square, double differences)
{
    return square * std::exp(3 / (differences + 1));
}

// Rates that change evenly differ by as much more as the interval is longer, and those of a camera that only shakes by
// twice their mean square.
double RateProcess::differenceAfter(double interval) const
{
    const double usual = changes / pairs, longer = std::max(interval * pairs / seconds, 1.),
                 evenly = usual * longer * longer;
    return count > 0 ? std::max(usual, std::min(evenly, 2 * products(0, 0) / count)) : evenly;
}

double RateProcess::aboutLast(double interval, double read) const
{
    return pairs > 0
               ? std::sqrt(variance(differenceAfter(interval), varianceOfLast(read), shownVarianceOfLast(read), 0))
               : 0;
}

double RateProcess::aboutMeans(double read) const
{
    return pairs > 0 ? std::sqrt(variance(changes / pairs, varianceOfMeans(read), shownVarianceOfMeans(read), 0)) : 0;
}

// Of means that have nothing to do with each other.
double RateProcess::meanSquare() const
{
    return pairs > 0 ? changes / pairs / 2 : 0;
}

double RateProcess::aboutNothing(double change_, double read) const
{
    const double byMeans = std::sqrt(withChance(meanSquare() + std::pow(aboutLast(0, read), 2), pairs));
    return std::hypot(byMeans, beyond(change_ / 2).sigma);
}

// A rate that wanders changes more than means of it.
double RateProcess::expectedChange(double interval, double usual) const
{
    return pairs > 0 ? std::sqrt(1.5 * std::max(differenceAfter(std::abs(interval)) - 2 * noise, 0.)) : usual;
}

// A rate that wanders with q per second turns over an interval T by sqrt(q T^3 / 3) more or less than at its end, and
// one that grows evenly by g T^2 / 2.
double RateProcess::expectedGrowth(double interval, double usual) const
{
    const double perSecond = expectedChange(interval, 0) / interval, square = 4. / 3 * perSecond * perSecond;
    return std::sqrt((count * square + ASSUMED_FRAMES * usual * usual) / (count + ASSUMED_FRAMES));
}

void RateProcess::expectChange(double square, double interval)
{
    if (pairs > 0 || !(square > 0))
        return;
    changes = square;
    seconds = interval;
    pairs = 1;
}

InstantRate RateProcess::now(double read) const
{
    InstantRate result;
    if (known > 0 && pairs > 0)
    {
        const double difference = withChance(differenceAfter(lastInterval), pairs), byMeans = (past[0] + predict()) / 2,
                     seen = trust(), missed = known > 1 && count > 0 ? errors / count : difference / 2;
        const InstantRate byRows = beyondLast();
        result.value = byMeans + seen * (past[0] - byMeans) + byRows.value;
        // Of the last mean's error half counts, or all of it where rows show the change.
        const double ofLast =
            variance(difference, varianceOfMeans(read), shownVarianceOfLast(read), 0.25 + 0.75 * seen);
        result.sigma = std::hypot(byRows.sigma, std::sqrt(ofLast + (1 - seen) * missed / 4));
    }
    return result;
}

InstantRate RateProcess::now(double next, double shownChange, double share, double read) const
{
    InstantRate result;
    if (known > 0)
    {
        const double difference = next - past[0],
                     square = withChance((changes + difference * difference) / (pairs + 1), pairs + 1);
        const InstantRate byRows = beyondMeans(shownChange, share);
        result.value = past[0] + share * difference + byRows.value;
        result.sigma = std::hypot(byRows.sigma,
                                  std::sqrt(variance(square, varianceOfMeans(read), shownVarianceOfMeans(read), 0.5)));
        result.growth = growth(next, share);
    }
    return result;
}

RowRates::RowRates(double steering_) : steering(steering_) {}

// The means of a rate that wanders over neighbouring intervals differ by 2/3 of its variance in one of them: that of
// the stationary state's process with a usual yaw rate.
double RowRates::usualSteering(const AckermannEstimator::Params& params)
{
    return 4. / 3 * params.priorYawRate * params.priorYawRate / MEMORY[SEQUENCE_YAW_RATE];
}

AboutFit RowRates::aboutFit(double before, double after, double readOut) const
{
    const double past = std::abs(before), future = std::abs(after), longer = std::max(past, future);
    RateProcess process = yaw;
    process.expectChange(steering * longer, longer);
    if (past > 0 && future > 0) // for the speed, the mean of both sides is that of the instant
        return {process.aboutMeans(readOut / (past + future)), 0};
    const double read = readOut / (2 * longer);
    return {process.aboutLast(longer, read), speed.aboutLast(longer, read)};
}

void RowRates::update(const SequenceFit& fit, double before, double after, double readOut)
{
    isMeasured = false;
    curve.release();
    // Turns are counted from a frame to one that was taken later.
    const bool backward = before < 0;
    const double past = std::abs(before), future = std::abs(after), share = past / (past + future),
                 read = readOut / (past + (after != 0 ? future : past));
    const NeighbourTurns &last = backward ? fit.after : fit.before, &next = backward ? fit.before : fit.after;
    const int sign = backward ? -1 : 1;
    const auto follow = [&](RateProcess& process, const RowTurn& ofLast, const RowTurn& ofNext) -> InstantRate {
        process.add(InstantRate(sign * ofLast.angle / past, ofLast.sigma / past), ofLast.change, before);
        if (after == 0)
            return process.now(read);
        InstantRate now = process.now(-sign * ofNext.angle / future, ofNext.change, share, read);
        now.growth *= sign;
        return now;
    };
    const double square = (std::pow(last.pitch.angle, 2) + std::pow(last.roll.angle, 2)) / (past * past);
    pitch.expectChange(square, past);
    roll.expectChange(square, past);
    pitchNow = follow(pitch, last.pitch, next.pitch);
    rollNow = follow(roll, last.roll, next.roll);

    yaw.expectChange(steering * past + square, past);
    const double ofLast =
        fit.values[SEQUENCE_YAW_RATE] - fit.values[FLOW_YAW_CHANGE] * before / 2 + last.yaw.angle / before;
    yaw.add(InstantRate(ofLast, last.yaw.sigma / past), last.yaw.change, before);
    yawBeyond = after != 0 ? yaw.beyondMeans(next.yaw.change, share) : yaw.beyondLast();
    if (after != 0)
    {
        const double ofNext =
            fit.values[SEQUENCE_YAW_RATE] + fit.values[FLOW_YAW_CHANGE] * after / 2 - next.yaw.angle / after;
        yawBeyond.growth = sign * yaw.growth(ofNext, share);
    }
    const double speedSigma = std::sqrt(fit.state.covariance(SEQUENCE_SPEED, SEQUENCE_SPEED));
    speed.add(InstantRate(fit.values[SEQUENCE_SPEED], speedSigma), 0, before);
    setSigmas(aboutFit(before, after, readOut));
}

void RowRates::setSigmas(const AboutFit& about)
{
    yawBeyond.sigma = std::hypot(yawBeyond.sigma, about.yawRate);
    speedBeyond.sigma = about.speed;
}

void RowRates::interrupt()
{
    pitch.interrupt();
    roll.interrupt();
    yaw.interrupt();
    speed.interrupt();
    pitchNow = rollNow = InstantRate();
    curve.release();
    yawBeyond = speedBeyond = InstantRate();
    isMeasured = false;
}

// Means that don't depend on each other differ by twice their variance, and shaking is taken to be alike about all
// axes.
void RowRates::begin(const SequenceFit& fit, double after, double readOut)
{
    interrupt();
    const double ofPitch = fit.after.pitch.angle / after, ofRoll = fit.after.roll.angle / after;
    const double square = ofPitch * ofPitch + ofRoll * ofRoll;
    pitch.expectChange(square, std::abs(after));
    roll.expectChange(square, std::abs(after));
    yaw.expectChange(steering * std::abs(after) + square, std::abs(after));
    yawBeyond.sigma = yaw.beyond(fit.after.yaw.change / 2).sigma;
    setSigmas(aboutFit(0, after, readOut));
    const double read = readOut / (2 * std::abs(after));
    pitchNow.sigma = pitch.aboutNothing(fit.after.pitch.change, read);
    rollNow.sigma = roll.aboutNothing(fit.after.roll.change, read);
}

void RowRates::expectChanges(double interval, FitNuisances& nuisances) const
{
    const double usual = std::sqrt(2.) * TURN_SIGMA / std::abs(interval);
    nuisances.pitchChange = pitch.expectedChange(interval, usual);
    nuisances.rollChange = roll.expectedChange(interval, usual);
    nuisances.yawGrowth = yaw.expectedGrowth(interval, std::sqrt(steering / std::abs(interval)));
}

void RowRates::set(const MeasuredTurns& measured)
{
    pitchNow = measured.pitch;
    rollNow = measured.roll;
    yawNow = measured.yaw;
    curve = measured.curve;
    yawBeyond = InstantRate();
    isMeasured = true;
}

// By the variances about the instant: between what is given and the fit, which has met it.
static void beyondFit(SequenceValue which, const InstantRate& beyond, double given, double givenSigma,
                      SequenceState& state)
{
    const double ofInstant = beyond.sigma * beyond.sigma, ofGiven = givenSigma * givenSigma;
    if (!(givenSigma > 0))
    {
        state.value[which] += beyond.value;
        state.covariance(which, which) += ofInstant;
        return;
    }
    const double share = ofInstant / (ofInstant + ofGiven);
    state.value[which] += share * (given - state.value[which]);
    state.scale(which, 1 - share);
    state.covariance(which, which) += share * ofGiven;
}

void RowRates::toInstant(const MotionPrior& given, SequenceState& state) const
{
    beyondFit(SEQUENCE_SPEED, speedBeyond, given.speed, given.speedSigma, state);
    if (!isMeasured)
    {
        beyondFit(SEQUENCE_YAW_RATE, yawBeyond, given.yawRate, given.yawRateSigma, state);
        return;
    }
    state.value[SEQUENCE_YAW_RATE] = yawNow.value;
    state.scale(SEQUENCE_YAW_RATE, yawNow.sigma / std::sqrt(state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE)));
}

// Of rates that grow evenly.
Mat RowRates::curveOf(const RollingShutterCamera& camera) const
{
    const Vec3d growth(-pitchNow.growth, yawBeyond.growth, rollNow.growth);
    if (growth == Vec3d())
        return Mat();
    const int pieces = 8; // a natural spline bends less at its ends, by a hundredth of all
    const double unit = camera.secondsPerUnitTime(), first = unit * camera.rowTime(Point2d()),
                 last = unit * camera.rowTime(Point2d(camera.imageSize) - Point2d(1, 1));
    Mat vectors(pieces + 1, 3, CV_64F);
    for (int i = 0; i <= pieces; i++)
    {
        const double t = first + (last - first) * i / pieces;
        const Vec3d v = growth * (t * t / 2);
        std::copy(v.val, v.val + 3, vectors.ptr<double>(i));
    }
    return vectors;
}

void RowRates::toMotion(const RollingShutterCamera& camera, AckermannMotion& motion) const
{
    const double unit = camera.secondsPerUnitTime();
    motion.pitchRate = pitchNow.value * unit;
    motion.rollRate = rollNow.value * unit;
    motion.pitchRateSigma = pitchNow.sigma * unit;
    motion.rollRateSigma = rollNow.sigma * unit;
    motion.rotationCurve = isMeasured ? curve : curveOf(camera);
}

}} // namespace cv::rsackermann
