// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/line_delay_sigma.hpp"
#include "../motion/compensation.hpp"
#include "given_prior.hpp"
#include "driving_prior.hpp"

namespace cv { namespace rsackermann {

// doc/theory.md, "Posterior", has the reasons.
static const double YAW_FREEDOM = 2;               // of Student's t, the distribution of yaw rates
static const double REVERSE_SPEED = 1.5;           // m/s, median
static const double USUAL_SECONDS_PER_UNIT = 0.06; // of the row time, if the line delay is unknown
static const double LOG_SECONDS_SIGMA = 1;
// Times the probability of standing: who is given a motion is seldom at rest.
static const double STANDING_IF_GIVEN = 0.3;

UsualDrive::UsualDrive(const MotionPrior& prior, const RollingShutterCamera& camera,
                       const AckermannEstimator::Params& params, const MotionLimits& limits)
    : alpha(0), toldAlphaSigma(0), toldSpeed(0), toldSpeedSigma(0), heading(camera.heading),
      headingSigma(params.wallDeviationSigma), height(camera.height), standing(params.standingProbability),
      reverseRatio(REVERSE_SPEED / params.priorSpeed)
{
    const double unit = camera.secondsPerUnitTime();
    const bool knowsWall = params.wallDistance > 0;
    yawScale = unit > 0 ? params.priorYawRate * unit / 2 : 0.5 * limits.maxAlpha;
    if (unit > 0 && prior.yawRateSigma > 0)
    {
        alpha = prior.yawRate * unit / 2;
        toldAlphaSigma = rateSigma(camera, prior.yawRate, prior.yawRateSigma) * unit / 2;
    }
    double speed = params.priorSpeed, speedSigma = params.priorSpeedLogSigma;
    if (unit > 0 && prior.speedSigma > 0)
    {
        toldSpeed = prior.speed * unit;
        toldSpeedSigma = rateSigma(camera, prior.speed, prior.speedSigma) * unit;
        // Near rest a logarithm would say more than is known.
        speed = std::max(std::abs(prior.speed), prior.speedSigma);
        speedSigma = std::min(speedSigma, prior.speedSigma / speed);
    }
    speedIsKnown = toldSpeedSigma > 0 && knowsWall;
    const double wallDistance = knowsWall ? params.wallDistance : params.priorWallDistance;
    logSpeed = std::log(speed * (unit > 0 ? unit : USUAL_SECONDS_PER_UNIT) / wallDistance);
    logSpeedSigma = std::hypot(speedSigma, unit > 0 ? 0 : LOG_SECONDS_SIGMA);
    logWallSigma = knowsWall ? 0 : params.priorWallDistanceLogSigma;
    if (params.roadRatio > 0)
        ratio = params.roadRatio;
    else
        ratio = wallDistance / (height > 0 ? height : params.priorHeight);
    roadRatioIsTold = params.roadRatio > 0;
    logHeightSigma = height > 0 || roadRatioIsTold ? 0 : params.priorHeightLogSigma;
    // A camera of unknown height that looks to the side may not see the road at all.
    roadIsSeen = height > 0 || Heading(camera.heading).looksAlong();
}

int UsualDrive::evaluate(const Model& model, const MotionHypothesis& hypothesis, Jet residuals[MAX_RESIDUALS]) const
{
    int n = 0;
    if (hypothesis.turns() && !(toldAlphaSigma > 0))
    {
        const Jet a = Jet::variable(model[P_ALPHA], P_ALPHA);
        const double q = a.value / yawScale, cost = (YAW_FREEDOM + 1) * std::log1p(q * q / YAW_FREEDOM),
                     r = std::sqrt(cost);
        const double halfSlope = (YAW_FREEDOM + 1) * q / (YAW_FREEDOM + q * q) / yawScale;
        // The cost of a residual is its square; next to 0 it is quadratic.
        residuals[n++] = r > 1e-6 ? a.apply(std::copysign(r, q), std::copysign(halfSlope / r, 1.))
                                  : std::sqrt(1 + 1 / YAW_FREEDOM) / yawScale * a;
    }
    if (!hypothesis.translates())
    {
        if (headingSigma > 0)
        {
            const double angle = model[P_STREET] - heading;
            residuals[n++] =
                (1 / headingSigma) * Jet::variable(model[P_STREET], P_STREET).apply(std::sin(angle), std::cos(angle));
        }
        return n;
    }
    if (speedIsKnown)
        return n;
    const Jet speed = length(Jet::variable(model[P_B], P_B), Jet::variable(model[P_D], P_D));
    const double least = 1e-12;
    Jet logarithm = speed.apply(std::log(speed.value + least), 1 / (speed.value + least));
    double sigma = std::hypot(logSpeedSigma, logWallSigma);
    if (hypothesis.walls == 2 && logWallSigma > 0)
    {
        // Both walls are as far away as walls are: the mean of the logarithms says it, their difference is in
        // PriorTerms.
        const Jet r = Jet::variable(model[P_LAMBDA], P_LAMBDA);
        logarithm = logarithm + r.apply(0.5 * std::log(r.value), 0.5 / r.value);
        sigma = std::hypot(logSpeedSigma, logWallSigma / std::sqrt(2.));
    }
    residuals[n++] = (1 / sigma) * (logarithm - std::log(usualScaledSpeed(model.direction)));
    return n;
}

double UsualDrive::usualScaledSpeed(int direction) const
{
    const bool isUnusual = direction < 0 && !(toldSpeedSigma > 0);
    return std::exp(logSpeed) * (isUnusual ? reverseRatio : 1);
}

double UsualDrive::logYawDensity(double a) const
{
    if (toldAlphaSigma > 0)
        return -std::log(toldAlphaSigma * std::sqrt(2 * CV_PI));
    const double q = a / yawScale;
    // Student's t with two degrees of freedom has the density 1 / (2 sqrt 2) at 0.
    return -0.5 * (YAW_FREEDOM + 1) * std::log1p(q * q / YAW_FREEDOM) - std::log(2 * std::sqrt(2.) * yawScale);
}

double UsualDrive::logVolume(const MotionHypothesis& hypothesis) const
{
    double volume = headingSigma > 0 ? std::log(headingSigma) : 0;
    if (hypothesis.translates() && !speedIsKnown)
        volume +=
            std::log(std::hypot(logSpeedSigma, hypothesis.walls == 2 ? logWallSigma / std::sqrt(2.) : logWallSigma));
    if (hypothesis.walls == 2)
        volume += std::log(USUAL_LOG_RATIO);
    return volume;
}

double UsualDrive::logRest() const
{
    const double z = toldSpeedSigma > 0 ? toldSpeed / toldSpeedSigma : 0;
    const double probability = motionIsTold() ? STANDING_IF_GIVEN * standing : standing;
    return std::log(probability / (1 - probability)) - 0.5 * z * z;
}

// Mean and variance of a normal distribution below a limit that is known up to a standard deviation.
static void truncate(double limit, double limitSigma, double& mean, double& variance)
{
    const double farthest = 6; // sigmas
    const double total = std::sqrt(variance + limitSigma * limitSigma);
    if (!(total > 0))
        return;
    const double z = std::max((limit - mean) / total, -farthest),
                 ratio = std::exp(-z * z / 2) / (std::sqrt(CV_PI / 2) * std::erfc(-z / std::sqrt(2.)));
    const double share = variance / total;
    mean -= share * ratio;
    variance -= share * share * ratio * (z + ratio);
}

void UsualDrive::road(const Model& model, const RoadContact& contact, double& G, double& variance) const
{
    G = variance = 0;
    const double speed = std::hypot(model[P_B], model[P_D]);
    if (speed == 0 || !roadIsSeen)
        return;
    // Walls that pass faster than usual are near, and the car is fast: each as far as its prior allows.
    const bool hasBoth = model[P_LAMBDA] > 0 && logWallSigma > 0 && !roadRatioIsTold;
    const double mean = hasBoth ? speed * std::sqrt(model[P_LAMBDA]) : speed;
    const double speedVariance = logSpeedSigma * logSpeedSigma,
                 wallVariance = logWallSigma * logWallSigma / (hasBoth ? 2 : 1);
    const double share = roadRatioIsTold ? 0 : wallVariance / (wallVariance + speedVariance);
    double logG = std::log(mean * ratio) - share * std::log(mean / usualScaledSpeed(model.direction));
    variance = logHeightSigma * logHeightSigma + (1 - share) * wallVariance;
    if (contact.ratio > 0 && !roadRatioIsTold)
        truncate(std::log(speed * contact.ratio), contact.logSigma, logG, variance);
    G = (model.direction < 0 ? -1 : 1) * std::exp(logG);
    variance *= G * G;
    const double toldSigma = toldSpeedSigma / height;
    if (toldSpeedSigma > 0 && height > 0 && toldSigma * toldSigma < variance)
    {
        G = toldSpeed / height;
        variance = toldSigma * toldSigma;
    }
}

}} // namespace cv::rsackermann
