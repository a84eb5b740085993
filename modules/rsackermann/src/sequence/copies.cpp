// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../motion/contradiction.hpp"
#include "copies.hpp"

namespace cv { namespace rsackermann {

// Shares of the points to a neighbour that stay where they are if nothing moves, and if most does.
const double NOTHING_MOVES = 0.9;
const double MOST_MOVES = 0.5;
const double GRIP = 10;       // m/s^2, of tyres
const double MOST_COPIES = 5; // of an image: 5 a second become 30

bool isStill(const std::vector<TrackedBearing>& bearings)
{
    const auto still =
        std::count_if(bearings.begin(), bearings.end(), [](const TrackedBearing& b) { return b.isStill; });
    return size_t(still) > bearings.size() / 2;
}

// Of the points to a neighbour that was taken some seconds before, or after; NaN: there are none.
static double shareStill(const std::vector<TrackedBearing>& bearings, double seconds)
{
    double count = 0, still = 0;
    for (const TrackedBearing& b : bearings)
        if ((b.pitch == FLOW_PITCH_BEFORE) == (seconds > 0))
        {
            count++;
            still += b.isStill;
        }
    return still / count;
}

bool showsCopy(const SequenceFit& fit, const std::vector<TrackedBearing>& bearings, double passed,
               const MotionPrior& prior)
{
    const double speed = fit.prediction.value[SEQUENCE_SPEED],
                 sigma = std::sqrt(fit.prediction.covariance(SEQUENCE_SPEED, SEQUENCE_SPEED));
    return fit.stands && shareStill(bearings, passed) > MOST_MOVES && std::abs(speed) > CONTRADICTION * sigma &&
           !contradicts(speed, sigma, prior.speed, prior.speedSigma);
}

bool isStillSince(const std::vector<TrackedBearing>& bearings, double seconds)
{
    return shareStill(bearings, seconds) > NOTHING_MOVES;
}

bool stopsOrStartsAtOnce(const std::vector<TrackedBearing>& bearings)
{
    const double before = shareStill(bearings, 1), after = shareStill(bearings, -1);
    return std::max(before, after) > NOTHING_MOVES && std::min(before, after) < MOST_MOVES;
}

bool mayFollowCopies(const std::vector<TrackedBearing>& bearings, double passed, double since)
{
    return std::abs(since) < (MOST_COPIES + 0.5) * std::abs(passed) && since * passed > 0 &&
           shareStill(bearings, passed) < MOST_MOVES;
}

bool movesTooSoon(const SequenceFit& fit, double seconds)
{
    const double sigma = std::sqrt(fit.state.covariance(SEQUENCE_SPEED, SEQUENCE_SPEED));
    return fit.moves &&
           std::abs(fit.state.value[SEQUENCE_SPEED]) > std::max(CONTRADICTION * sigma, GRIP * std::abs(seconds));
}

}} // namespace cv::rsackermann
