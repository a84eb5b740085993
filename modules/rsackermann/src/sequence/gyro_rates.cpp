// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../motion/contradiction.hpp"
#include "gyro_rates.hpp"

namespace cv { namespace rsackermann {

typedef Vec<double, GyroRates::UNKNOWNS> GyroUnknowns; // of GyroAlignment
typedef Matx<double, GyroRates::UNKNOWNS, GyroRates::UNKNOWNS> UnknownsMatrix;

static const double TURN_RATE_NOISE = 1 * CV_PI / 180;         // rad/s about each axis, of turns of points at worst
static const size_t DELAY_FRAMES = 2 * size_t(ASSUMED_FRAMES); // that show such a delay
static const double EXPLAINED = 0.5; // share of the turns' loss that a true gyro leaves at most

RowSpan::RowSpan(const RollingShutterCamera& camera)
{
    const double unit = camera.secondsPerUnitTime(), first = unit * camera.rowTime(Point2d(0, 0)),
                 last = unit * camera.rowTime(Point2d(camera.imageSize.width - 1, camera.imageSize.height - 1));
    from = std::min(first, last);
    to = std::max(first, last);
}

TurnOfPoints::TurnOfPoints(const RollingShutterCamera& camera, const std::vector<TrackedBearing>& bearings,
                           const double* values, const NeighbourTurns& turns, double seconds, double neighbour,
                           double yawSigma, double lastingSigma)
    : begin(seconds + std::min(neighbour, 0.)), end(seconds + std::max(neighbour, 0.)), rows(0, 0)
{
    const double unit = camera.secondsPerUnitTime(), interval = std::abs(neighbour);
    const bool isEarlier = neighbour < 0;
    double count = 0, sum = 0, squares = 0;
    for (const TrackedBearing& s : bearings)
        if ((s.pitch == FLOW_PITCH_BEFORE) == isEarlier)
        {
            const double after = s.timeNow * unit;
            count++;
            sum += after;
            squares += after * after;
        }
    // As if they were spread evenly.
    const double mean = sum / count, half = std::sqrt(3 * std::max(squares / count - mean * mean, 0.)),
                 yawRate = values[SEQUENCE_YAW_RATE] + values[FLOW_YAW_CHANGE] * neighbour / 2;
    rows = RowSpan(mean - half, mean + half);
    const Matx33d toCamera = (tiltOf(values) * camera.uprightRotation).t();
    const auto rateOf = [&](const RowTurn& turn) { return -(turn.angle + turn.change * mean) / neighbour; };
    rate = toCamera * Vec3d(-rateOf(turns.pitch), yawRate + rateOf(turns.yaw), rateOf(turns.roll));
    const Vec3d sigmas(turns.pitch.sigma / interval, std::hypot(yawSigma, turns.yaw.sigma / interval),
                       turns.roll.sigma / interval);
    for (int i = 0; i < 3; i++)
    {
        variance[i] = 0;
        for (int j = 0; j < 3; j++)
            variance[i] += std::pow(toCamera(i, j) * sigmas[j], 2);
        lasting[i] = toCamera(i, 1) * lastingSigma;
    }
}

void CameraRates::about(const Matx33d& rotation, InstantRate& x, InstantRate& y, InstantRate& z) const
{
    const Vec3d turned = rotation * value, squares = rotation.mul(rotation) * sigma.mul(sigma);
    InstantRate* const rates[3] = {&x, &y, &z};
    for (int i = 0; i < 3; i++)
    {
        rates[i]->value = turned[i];
        rates[i]->sigma = std::sqrt(squares[i]);
    }
}

GyroRates::GyroRates()
{
    setSigmas(GyroSigmas());
    reset();
}

void GyroRates::setSigmas(const GyroSigmas& s)
{
    prior = GyroUnknowns(s.delay, s.axes, s.axes, s.axes, s.bias, s.bias, s.bias, s.scale);
    if (turns.empty())
        covariance = UnknownsMatrix::diag(prior.mul(prior));
}

void GyroRates::reset()
{
    turns.clear();
    found = GyroAlignment();
    start = 0;
    covariance = UnknownsMatrix::diag(prior.mul(prior));
    lasting = GyroUnknowns();
    noise = Vec3d::all(TURN_RATE_NOISE);
    meanTurn = Vec3d();
    count = 0;
    left = unexplained = Vec3d();
    unexplainedFrames = 0;
    contraryBegin = contraryEnd = std::numeric_limits<double>::quiet_NaN();
}

bool GyroRates::expected(const TurnOfPoints& turn, double delay, Vec3d& rate) const
{
    return samples.meanRate(turn.begin + delay, turn.end + delay, turn.rows.from, turn.rows.to, rate);
}

bool GyroRates::expected(const TurnOfPoints& turn, double delay, Vec3d& rate, Vec3d& slope) const
{
    const double h = 1e-3;
    Vec3d before, after;
    if (!expected(turn, delay - h, before) || !expected(turn, delay + h, after))
        return false;
    rate = (before + after) * 0.5;
    slope = (after - before) * (1 / (2 * h));
    return true;
}

void GyroRates::add(const TurnOfPoints& turn)
{
    // The first frame of a sequence has shown the turn to the second.
    const bool isAgain = !turns.empty() && std::abs(turn.begin - turns.back().begin) < (turn.end - turn.begin) / 2;
    if (isAgain)
        turns.back() = turn;
    else
    {
        judge(turn);
        turns.push_back(turn);
    }
    while (std::abs(turn.end - turns.front().end) > RATE_MEMORY)
        turns.pop_front();
    align();
    Vec3d rate;
    unexplainedFrames = contradicts() || !expected(turn, found.delay, rate) ? unexplainedFrames + 1 : 0;
    if (unexplainedFrames < DELAY_FRAMES)
        return;
    unexplainedFrames = 0;
    if (findDelay())
        align();
}

// Of a rate about the i-th axis of the camera, by the unknowns. @param slope of the gyro's rate g by time.
static GyroUnknowns derivatives(const Vec3d& g, const Vec3d& slope, int i)
{
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    GyroUnknowns J;
    J[0] = slope[i];
    J[1 + j] = g[l];
    J[1 + l] = -g[j];
    J[4 + i] = 1;
    J[7] = i < 2 ? g[i] : 0; // a roll is the same for any focal length
    return J;
}

// Before it is used: a bias that is fitted explains a few turns whatever the gyro says. What isn't known yet of bias,
// axes and clock, or of the turn, isn't the gyro's fault, nor its merit.
void GyroRates::judge(const TurnOfPoints& turn)
{
    Vec3d g, slope;
    contraryBegin = contraryEnd = std::numeric_limits<double>::quiet_NaN();
    if (!expected(turn, found.delay, g, slope))
        return;
    const double large = 2 * TURN_RATE_NOISE; // what is left beyond may be wrong points
    const double kept = turns.empty() ? 1 : std::exp(-std::abs(turn.end - turns.back().end) / RATE_MEMORY);
    const Vec3d with = turn.rate - found.toCamera(g, 1), without = turn.rate - meanTurn * (count / (count + 1));
    bool isUnlikely = false;
    double leaves = 0, turned = 0; // squares
    for (int k = 0; k < 3; k++)
    {
        const GyroUnknowns J = derivatives(g, slope, k);
        const double vague = CONTRADICTION * CONTRADICTION * turn.variance[k] + J.dot(covariance * J),
                     beyond = std::max(0., with[k] * with[k] - vague),
                     beyondMean = std::max(0., without[k] * without[k] - vague);
        isUnlikely |= beyond > CONTRADICTION * CONTRADICTION * noise[k] * noise[k];
        turned += turn.rate[k] * turn.rate[k];
        leaves += beyond;
        left[k] = kept * left[k] + large * large * std::log1p(beyond / (large * large));
        unexplained[k] = kept * unexplained[k] + large * large * std::log1p(beyondMean / (large * large));
    }
    // A gyro that sticks for a moment is right on average.
    if (isUnlikely && leaves > EXPLAINED * turned)
    {
        contraryBegin = turn.begin;
        contraryEnd = turn.end;
    }
    meanTurn = (meanTurn * (kept * count) + turn.rate) * (1 / (kept * count + 1));
    count = kept * count + 1;
}

// Gauss-Newton from what was found before, with Cauchy's loss.
void GyroRates::align()
{
    // Each frame goes on from the one before.
    const int iterations = turns.size() < DELAY_FRAMES ? 3 : 1;
    for (int iteration = 0; iteration < iterations; iteration++)
    {
        UnknownsMatrix information = UnknownsMatrix::zeros();
        GyroUnknowns gradient, byLasting;
        const GyroUnknowns now(found.delay - start, found.turn[0], found.turn[1], found.turn[2], found.bias[0],
                               found.bias[1], found.bias[2], found.scale - 1);
        for (int i = 0; i < UNKNOWNS; i++)
        {
            information(i, i) = 1 / (prior[i] * prior[i]);
            gradient[i] = now[i] * information(i, i);
        }
        Vec3d squares = Vec3d::all(ASSUMED_FRAMES * TURN_RATE_NOISE * TURN_RATE_NOISE);
        double weights = 0;
        for (size_t k = 0; k < turns.size(); k++)
        {
            Vec3d g, slope;
            if (!expected(turns[k], found.delay, g, slope))
                continue;
            const double kept = std::exp(-std::abs(turns[k].end - turns.back().end) / RATE_MEMORY);
            const Vec3d r = turns[k].rate - found.toCamera(g, 1);
            double squared = 0;
            for (int i = 0; i < 3; i++)
                squared += r[i] * r[i] / (noise[i] * noise[i]);
            const double weight = kept / (1 + squared / 9);
            for (int i = 0; i < 3; i++)
            {
                const GyroUnknowns J = derivatives(g, slope, i);
                const double w = weight / (noise[i] * noise[i]);
                information = information + J * J.t() * w;
                gradient -= J * (w * r[i]);
                byLasting += J * (w * turns[k].lasting[i]);
                squares[i] += weight * r[i] * r[i];
            }
            weights += weight;
        }
        covariance = information.inv(DECOMP_CHOLESKY);
        lasting = covariance * byLasting;
        const GyroUnknowns step = covariance * gradient;
        found.delay -= step[0];
        found.scale -= step[7];
        for (int i = 0; i < 3; i++)
        {
            found.turn[i] -= step[1 + i];
            found.bias[i] -= step[4 + i];
            noise[i] = std::sqrt(squares[i] / (ASSUMED_FRAMES + weights));
        }
    }
}

GyroUnknowns GyroRates::alignmentSigma() const
{
    GyroUnknowns sigma;
    for (int i = 0; i < UNKNOWNS; i++)
        sigma[i] = std::sqrt(covariance(i, i));
    return sigma;
}

// How much of the turns about the axes a gyro leaves with some delay, but for a bias that there may be; 1 if it is
// wrong.
double GyroRates::shareLeft(double delay) const
{
    const size_t first = turns.size() - std::min(turns.size(), 5 * DELAY_FRAMES);
    Vec3d sums[2], squares[2]; // of the turns, and of what the gyro leaves
    double n = 0;
    for (size_t k = first; k < turns.size(); k++)
    {
        Vec3d g;
        if (!expected(turns[k], delay, g))
            continue;
        const Vec3d values[2] = {turns[k].rate, turns[k].rate - g};
        for (int i = 0; i < 2; i++)
        {
            sums[i] += values[i];
            squares[i] += values[i].mul(values[i]);
        }
        n++;
    }
    double sum = 0;
    int axes = 0; // that turn
    for (int i = 0; i < 3 && n >= DELAY_FRAMES; i++)
    {
        const double all = squares[0][i] - sums[0][i] * sums[0][i] / n,
                     left_ = squares[1][i] - sums[1][i] * sums[1][i] / n;
        if (std::abs(sums[1][i]) > 3 * prior[4 + i] * n)
            return 1;
        if (!(all > TURN_RATE_NOISE * TURN_RATE_NOISE * n))
            continue;
        sum += left_ / all;
        axes++;
    }
    return axes > 1 ? sum / axes : 1;
}

// Of clocks that have nothing to do with one another: the delay that explains the turns best, if one does. By chance
// some delay fits one axis, but hardly two.
bool GyroRates::findDelay()
{
    const double farthest = 2, step = 0.004; // seconds
    double best = EXPLAINED / 2, delay = 0;
    for (double d = -farthest; d <= farthest; d += step)
    {
        const double share = shareLeft(d);
        if (share < best)
        {
            best = share;
            delay = d;
        }
    }
    if (best == EXPLAINED / 2)
        return false;
    found = GyroAlignment();
    found.delay = start = delay;
    noise = Vec3d::all(TURN_RATE_NOISE);
    left = best * unexplained;
    return true;
}

static double sumOf(const Vec3d& v)
{
    return v[0] + v[1] + v[2];
}

// Whether the turns alone, without what is known of the scale beforehand, show one that this excludes: half of a turn
// explains most of its square.
bool GyroRates::contradictsScale() const
{
    const double ofPrior = 1 / (prior[7] * prior[7]), information = 1 / covariance(7, 7), shown = information - ofPrior;
    if (!(shown > 1e-6 * ofPrior)) // next to what is exact nothing shows
        return false;
    const double seen = (found.scale - 1) * information / shown;
    const double sigma = std::hypot(1 / std::sqrt(shown), lasting[7] * information / shown);
    return std::abs(seen) > CONTRADICTION * std::hypot(prior[7], sigma);
}

bool GyroRates::contradicts() const
{
    if (contradictsScale())
        return true;
    // About each axis, that it may leave in any case
    const double small = std::pow(TURN_RATE_NOISE / CONTRADICTION, 2) * count;
    // An axis with the wrong sign is lost in the sum of the others.
    for (int k = 0; k < 3; k++)
        if (left[k] > unexplained[k] + small)
            return true;
    return sumOf(left) > EXPLAINED * sumOf(unexplained) + 3 * small;
}

bool GyroRates::isWrong() const
{
    return contradicts() && turns.size() > DELAY_FRAMES &&
           (contradictsScale() || sumOf(left) > 3 * TURN_RATE_NOISE * TURN_RATE_NOISE * count);
}

// The instants of the gyro's clock that may be that of an image, with their probabilities: of shaking, a clock that
// isn't known leaves what lasts. Empty if samples are missing.
std::vector<GyroRates::Instant> GyroRates::instantsOf(double seconds, const RowSpan& rows) const
{
    const double farthest = 3, step = 0.004; // sigmas; seconds, of shaking at 40 Hz a sixth
    const double sigma = std::sqrt(covariance(0, 0));
    const int side = cvCeil(std::min(std::max(farthest * sigma / step, 2.), 50.)); // of any sigma
    const double expected = seconds + found.delay;
    std::vector<Instant> instants;
    if (!samples.covers(expected + rows.from, expected + rows.to))
        return instants;
    double sum = 0;
    for (int i = -side; i <= side; i++)
    {
        const double z = farthest * i / side, time = expected + z * sigma, probability = std::exp(-z * z / 2);
        if (!samples.covers(time + rows.from, time + rows.to))
            continue;
        instants.push_back({time, probability});
        sum += probability;
    }
    for (Instant& instant : instants)
        instant.probability /= sum;
    return instants;
}

bool GyroRates::at(double seconds, const RowSpan& rows, CameraRates& rates) const
{
    const std::vector<Instant> instants = instantsOf(seconds, rows);
    if (instants.empty() || (seconds >= contraryBegin && seconds <= contraryEnd))
        return false;
    Vec3d mean, squares;
    for (const Instant& instant : instants)
    {
        Vec3d g;
        if (!samples.rowRate(instant.time, rows.from, rows.to, g))
            return false;
        mean += instant.probability * g;
        squares += instant.probability * g.mul(g);
    }
    rates.value = found.toCamera(mean, 1);
    // Least squares through a random walk.
    const double ofSamples = 1.2 * samples.angleNoise() / std::max(rows.to - rows.from, 1e-3);
    for (int i = 0; i < 3; i++)
    {
        const GyroUnknowns J = derivatives(mean, Vec3d(), i);
        const double ofClock = std::max(squares[i] - mean[i] * mean[i], 0.);
        const double ofAlignment = (J.t() * covariance * J)(0) + std::pow(J.dot(lasting), 2);
        rates.sigma[i] = std::sqrt(ofClock + ofAlignment + noise[i] * noise[i] / 4 + ofSamples);
    }
    return true;
}

Mat GyroRates::curve(double seconds, const CameraRates& rates, double first, double last, const Matx33d& rotation) const
{
    const int pieces = 16; // of 2 ms or so: what a gyro shows is slower
    const std::vector<Instant> instants = instantsOf(seconds, RowSpan(std::min(first, last), std::max(first, last)));
    if (instants.empty())
        return Mat();
    Mat vectors(pieces + 1, 3, CV_64F);
    for (int i = 0; i <= pieces; i++)
    {
        const double later = first + (last - first) * i / pieces;
        Vec3d mean;
        for (const Instant& instant : instants)
        {
            Vec3d angle;
            if (!samples.turn(instant.time + std::min(later, 0.), instant.time + std::max(later, 0.), angle))
                return Mat();
            mean += (later < 0 ? -instant.probability : instant.probability) * angle;
        }
        const Vec3d turned = found.toCamera(mean, later) - rates.value * later, vector = rotation * turned;
        std::copy(vector.val, vector.val + 3, vectors.ptr<double>(i));
    }
    return vectors;
}

}} // namespace cv::rsackermann
