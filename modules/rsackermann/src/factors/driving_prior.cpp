// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/line_delay_sigma.hpp"
#include "../motion/compensation.hpp"
#include "driving_prior.hpp"
#include "robust_losses.hpp"

namespace cv { namespace rsackermann {

// doc/theory.md, "Prior", has the reasons.
static const double YAW_FREEDOM = 2; // of Student's t, the distribution of yaw rates
// Times the probability of standing, if a motion is given exactly: who has one is seldom at rest.
static const double STANDING_IF_GIVEN = 0.3;

TiltSigmas::TiltSigmas(const RollingShutterCamera& camera, const AckermannEstimator::Params& params)
    : roll(EXACT_GRAVITY), pitch(EXACT_GRAVITY)
{
    if (!(params.gravitySigma > 0))
        return;
    // The roll of a camera that looks aside is the vehicle's pitch.
    const double c = std::cos(camera.heading), s = std::sin(camera.heading);
    roll = std::hypot(params.gravitySigma, std::hypot(c * camera.rollSigma, s * camera.pitchSigma));
    pitch = std::hypot(params.vehiclePitchSigma, std::hypot(s * camera.rollSigma, c * camera.pitchSigma));
}

GivenValues::GivenValues(const MotionPrior& prior, const RollingShutterCamera& camera)
{
    street = prior.wallDirection;
    streetSigma = prior.wallDirectionSigma;
    const double unit = camera.secondsPerUnitTime();
    if (unit > 0 && prior.yawRateSigma > 0)
    {
        alpha = prior.yawRate * unit / 2;
        alphaSigma = rateSigma(camera, prior.yawRate, prior.yawRateSigma) * unit / 2;
    }
    if (unit > 0 && prior.speedSigma > 0)
    {
        speed = prior.speed * unit;
        speedSigma = rateSigma(camera, prior.speed, prior.speedSigma) * unit;
    }
}

// The mode of a normal logarithm whose exponential has been measured, and its standard deviation there.
static void measureLogarithm(double value, double sigma, double& mean, double& logSigma)
{
    const double usual = mean, weight = 1 / (logSigma * logSigma), known = 1 / (sigma * sigma);
    mean = std::log(std::max(value, sigma));
    for (int i = 0; i < 30; i++)
    {
        const double e = std::exp(mean), information = weight + known * e * e;
        mean -= (weight * (mean - usual) + known * e * (e - value)) / information;
        logSigma = 1 / std::sqrt(information);
    }
}

DrivingPrior::DrivingPrior(const MotionPrior& prior, const RollingShutterCamera& camera,
                           const AckermannEstimator::Params& params)
    : given_(prior, camera), logRatioSigma(params.priorWallRatioLogSigma), heading_(camera.heading),
      headingSigma(params.wallDeviationSigma), height(camera.height),
      speedWallCorrelation(speedIsGiven() || params.wallDistance > 0 ? 0 : params.priorSpeedWallCorrelation),
      usualWallSigma(params.priorWallDistanceLogSigma), standing(params.standingProbability),
      reverse(params.reverseProbability), wallIsGiven_(params.wallDistance > 0)
{
    RollingShutterCamera timed = camera;
    double unitLogSigma = 0;
    if (!(camera.secondsPerUnitTime() > 0))
    {
        timed.lineDelay = params.priorReadoutTime / camera.imageSize.height;
        unitLogSigma = params.priorReadoutTimeLogSigma;
    }
    const double unit = timed.secondsPerUnitTime();
    // Of Student's distribution times a log-normal one: the tails go with the mean square of the latter.
    yawScale = params.priorYawRate * unit / 2 * std::exp(unitLogSigma * unitLogSigma);
    yawShare = yawRateIsGiven() ? 1 / (1 + std::pow(given_.alphaSigma / yawScale, 2)) : 0;
    logYawSum = yawRateIsGiven() ? logSumOfYaw() : 0;
    double logMetres = std::log(params.priorSpeed), speedSigma = params.priorSpeedLogSigma; // per second
    if (speedIsGiven())
        measureLogarithm(std::abs(prior.speed), prior.speedSigma, logMetres, speedSigma);
    roadIsSought_ = params.scaleFromRoad && height > 0 && !wallIsGiven_;
    const double wallDistance = wallIsGiven_ ? params.wallDistance : params.priorWallDistance;
    logSpeed = logMetres + std::log(unit / wallDistance);
    logSpeedSigma = std::hypot(speedSigma, unitLogSigma);
    logWallSigma = wallIsGiven_ ? params.wallDistanceLogSigma : usualWallSigma;
    roadRatioIsGiven = params.roadRatio > 0 && !roadIsSought_;
    ratio = roadRatioIsGiven ? params.roadRatio : wallDistance / (height > 0 ? height : params.priorHeight);
    logHeightSigma = height > 0 || roadRatioIsGiven ? 0 : params.priorHeightLogSigma;
    // A camera of unknown height that looks to the side may not see the road at all.
    roadIsSeen = height > 0 || heading_.looksAlong();
}

int DrivingPrior::evaluateYaw(double alpha, bool turns, Jet residuals[MAX_YAW_RESIDUALS]) const
{
    int n = 0;
    const Jet a = Jet::variable(alpha, P_ALPHA);
    if (yawRateIsGiven())
        residuals[n++] = (1 / given_.alphaSigma) * (a - given_.alpha);
    if (!turns)
        return n;
    const double q = alpha / yawScale, cost = (YAW_FREEDOM + 1) * std::log1p(q * q / YAW_FREEDOM), r = std::sqrt(cost),
                 halfSlope = (YAW_FREEDOM + 1) * q / (YAW_FREEDOM + q * q) / yawScale;
    // The cost of a residual is its square; next to 0 it is quadratic.
    residuals[n++] = r > 1e-6 ? a.apply(std::copysign(r, q), std::copysign(halfSlope / r, 1.))
                              : std::sqrt(1 + 1 / YAW_FREEDOM) / yawScale * a;
    return n;
}

// Student's t with two degrees of freedom has the density 1 / (2 sqrt 2) at 0.
double DrivingPrior::usualYawDensity(double alpha) const
{
    const double q = alpha / yawScale;
    return std::pow(1 + q * q / YAW_FREEDOM, -0.5 * (YAW_FREEDOM + 1)) / (2 * std::sqrt(2.) * yawScale);
}

// Over what is narrower, the given density or the usual one, whose probability is (1 + sin angle) / 2.
double DrivingPrior::logSumOfYaw() const
{
    const double farthest = 6, wide = 30, sigma = given_.alphaSigma, relative = sigma / yawScale;
    const bool isGivenNarrower = relative < wide || std::abs(given_.alpha) > farthest * sigma;
    const int steps = int(60 * std::min(std::max(relative, 1.), wide));
    double sum = 0;
    for (int i = 0; i < steps; i++)
    {
        const double place = 2 * (i + 0.5) / steps - 1, z = farthest * place, angle = CV_PI / 2 * place,
                     beyond = (std::sqrt(YAW_FREEDOM) * yawScale * std::tan(angle) - given_.alpha) / sigma;
        sum += isGivenNarrower ? 2 * farthest * sigma * std::exp(-z * z / 2) * usualYawDensity(given_.alpha + z * sigma)
                               : CV_PI / 2 * std::cos(angle) * std::exp(-beyond * beyond / 2);
    }
    return std::log(std::max(sum / steps, DBL_MIN));
}

DrivingPrior::ScaledSpeedLog DrivingPrior::scaledSpeedLog(int walls) const
{
    const double wallSigma = logWallSigma / std::sqrt(wallIsGiven_ ? 1. : std::max(walls, 1)),
                 speedVariance = logSpeedSigma * logSpeedSigma,
                 common = speedWallCorrelation * logSpeedSigma * wallSigma;
    ScaledSpeedLog log;
    log.variance = speedVariance + wallSigma * wallSigma - 2 * common;
    log.speedShare = (speedVariance - common) / log.variance;
    log.speedVariance = speedVariance - log.speedShare * log.speedShare * log.variance;
    return log;
}

Jet DrivingPrior::speedResidual(const Model& model, const MotionHypothesis& hypothesis) const
{
    const Jet speed = length(Jet::variable(model[P_B], P_B), Jet::variable(model[P_D], P_D));
    const double least = 1e-12;
    Jet logarithm = speed.apply(std::log(speed.value + least), 1 / (speed.value + least));
    if (hypothesis.walls == 2 && !wallIsGiven_)
    {
        // Both walls are as far away as walls are: this is the mean of the logarithms, and their difference is that of
        // the ratio.
        const Jet r = Jet::variable(model[P_LAMBDA], P_LAMBDA);
        logarithm = logarithm + r.apply(0.5 * std::log(r.value), 0.5 / r.value);
    }
    return (1 / std::sqrt(scaledSpeedLog(hypothesis.walls).variance)) * (logarithm - std::log(expectedScaledSpeed()));
}

// What a direction costs. A given speed has a sign; among the residuals is its size.
double DrivingPrior::directionPenalty(int direction, const MotionHypothesis& hypothesis) const
{
    if (!speedIsGiven() || !hypothesis.translates())
        return direction == 0 ? 0 : -2 * std::log(std::max(direction < 0 ? reverse : 1 - reverse, DBL_MIN));
    const double farthest = 30; // sigmas, beyond which the probability is 0 to a double
    const double z = std::max(direction * given_.speed / given_.speedSigma, -farthest);
    return -2 * std::log(0.5 * std::erfc(-z / std::sqrt(2.)));
}

int DrivingPrior::evaluate(const Model& model, const MotionHypothesis& hypothesis, Jet residuals[MAX_RESIDUALS]) const
{
    int n = evaluateYaw(model[P_ALPHA], hypothesis.turns(), residuals);
    if (hypothesis.translates())
    {
        residuals[n++] = speedResidual(model, hypothesis);
        const Jet B = Jet::variable(model[P_B], P_B), D = Jet::variable(model[P_D], P_D);
        const auto sineTo = [&](double azimuth) {
            return (std::cos(azimuth) * D - std::sin(azimuth) * B) / (length(B, D) + 1e-12);
        };
        if (given_.streetSigma > 0)
            residuals[n++] = (1 / given_.streetSigma) * sineTo(given_.street);
        if (headingSigma > 0)
            residuals[n++] = (1 / headingSigma) * sineTo(heading_.angle);
        if (hypothesis.walls == 2)
        {
            const Jet r = Jet::variable(model[P_LAMBDA], P_LAMBDA);
            residuals[n++] = (1 / logRatioSigma) * r.apply(std::log(r.value), 1 / r.value);
        }
    }
    else
    {
        const Jet street = Jet::variable(model[P_STREET], P_STREET);
        const double angle = model[P_STREET] - heading_.angle;
        if (given_.streetSigma > 0)
            residuals[n++] = (1 / given_.streetSigma) * (street - given_.street);
        if (headingSigma > 0)
            residuals[n++] = (1 / headingSigma) * street.apply(std::sin(angle), std::cos(angle));
    }
    const double penalty = directionPenalty(model.direction, hypothesis);
    if (penalty > 0)
        residuals[n++] = Jet(std::sqrt(penalty));
    return n;
}

Model DrivingPrior::expectedMotion(const MotionHypothesis& hypothesis, int direction,
                                   Matx<double, PARAMETERS, PARAMETERS>& covariance) const
{
    Model m;
    m[P_STREET] = heading_.angle;
    covariance = Matx<double, PARAMETERS, PARAMETERS>::zeros();
    if (hypothesis.turns())
    {
        m[P_ALPHA] = expectedAlpha();
        covariance(P_ALPHA, P_ALPHA) = alphaScale() * alphaScale();
    }
    if (!hypothesis.translates())
        return m;
    // The street is along the heading, more or less, and as it is given.
    const double ofHeading = headingSigma > 0 ? 1 / (headingSigma * headingSigma) : 0,
                 ofGiven = given_.streetSigma > 0 ? 1 / (given_.streetSigma * given_.streetSigma) : 0,
                 information = ofHeading + ofGiven > 0 ? ofHeading + ofGiven : 1,
                 azimuth = heading_.angle + ofGiven / information * std::asin(std::sin(given_.street - heading_.angle));
    m.direction = direction;
    m[P_B] = m.direction * expectedScaledSpeed() * std::cos(azimuth);
    m[P_D] = m.direction * expectedScaledSpeed() * std::sin(azimuth);
    m[P_LAMBDA] = hypothesis.walls == 2 ? 1 : 0;
    if (hypothesis.walls == 1 && m.direction * m[P_D] < 0) // the wall that a camera sees which looks to the right
    {
        m[P_B] *= -1;
        m[P_D] *= -1;
    }
    // Of B, D and lambda by the azimuth and the logarithms of how fast the left and the right wall pass. A given
    // distance is that of the left one, else both are as far away as walls are.
    const Matx33d byLogs(-m[P_D], m[P_B], 0, m[P_B], m[P_D], 0, 0, -m[P_LAMBDA], m[P_LAMBDA]);
    const double shared = scaledSpeedLog(hypothesis.walls).variance,
                 ofRatio = hypothesis.walls == 2 ? logRatioSigma * logRatioSigma : 0,
                 left = wallIsGiven_ ? shared : shared + ofRatio / 4, right = wallIsGiven_ ? shared + ofRatio : left,
                 common = wallIsGiven_ ? shared : shared - ofRatio / 4, left2 = std::expm1(left),
                 right2 = std::expm1(right), common2 = common * std::sqrt(left2 * right2 / (left * right));
    const Matx33d ofLogs(1 / information, 0, 0, 0, left2, common2, 0, common2, right2),
        walls = byLogs * ofLogs * byLogs.t();
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            covariance(P_B + i, P_B + k) = walls(i, k);
    return m;
}

double DrivingPrior::logYawDensity(double alpha) const
{
    return std::log(usualYawDensity(alpha)) - logYawSum;
}

double DrivingPrior::logVolume(const MotionHypothesis& hypothesis) const
{
    double volume = headingSigma > 0 ? std::log(headingSigma) : 0;
    if (hypothesis.translates())
        volume += 0.5 * std::log(scaledSpeedLog(hypothesis.walls).variance);
    if (hypothesis.walls == 2)
        volume += std::log(logRatioSigma);
    return volume;
}

double DrivingPrior::logRest() const
{
    // Its residual if a speed is given.
    const double z = speedIsGiven() ? given_.speed / given_.speedSigma : 0;
    const double probability = std::pow(STANDING_IF_GIVEN, givenShare()) * standing;
    return std::log(probability / (1 - probability)) - 0.5 * z * z;
}

void DrivingPrior::road(const Model& model, const RoadLimit& limit, double& G, double& variance) const
{
    G = variance = 0;
    const double speed = std::hypot(model[P_B], model[P_D]);
    if (speed == 0 || !roadIsSeen)
        return;
    // Walls that pass faster than expected are near, and the car is fast: each as far as its prior allows.
    const bool hasBoth = model[P_LAMBDA] > 0 && !wallIsGiven_ && !roadRatioIsGiven;
    const double mean = hasBoth ? speed * std::sqrt(model[P_LAMBDA]) : speed;
    const ScaledSpeedLog log = scaledSpeedLog(hasBoth ? 2 : 1);
    double logG = std::log(mean * ratio);
    if (!roadRatioIsGiven)
    {
        logG -= (1 - log.speedShare) * std::log(mean / expectedScaledSpeed());
        variance = logHeightSigma * logHeightSigma + log.speedVariance;
    }
    if (!roadRatioIsGiven)
        limitRoad(limit, model, logG, variance);
    G = (model.direction < 0 ? -1 : 1) * std::exp(logG);
    variance *= G * G;
    const double speedSigma = given_.speedSigma / height;
    const bool hasItsSign = given_.speed * model.direction >= 0;
    if (speedIsGiven() && hasItsSign && height > 0 && speedSigma * speedSigma < variance)
    {
        G = given_.speed / height;
        variance = speedSigma * speedSigma;
    }
}

void DrivingPrior::limitRoad(const RoadLimit& limit, const Model& model, double& logG, double& variance) const
{
    if (limit.empty() || !(variance > 0))
        return;
    // A given distance is wrong as seldom as contradictions are by chance, and the wall then as far away as walls are.
    const double wrong = wallIsGiven_ ? std::erfc(CONTRADICTION / std::sqrt(2.)) : 0, farthest = 4,
                 logWall = std::log(std::hypot(model[P_B], model[P_D]));
    const RoadLimit::Likelihood likelihood(limit, model, heading_);
    double sum = 0, first = 0, second = 0;
    for (const bool isWrong : {false, true})
    {
        if (isWrong && !(wrong > 0))
            continue;
        const double sigma = isWrong ? std::sqrt(variance + usualWallSigma * usualWallSigma) : std::sqrt(variance);
        // No coarser than the limit's table; beyond that it's constant.
        const int steps = int(std::max(48., std::min(2 * farthest * sigma / HEIGHT_SIGMA, 1000.)));
        for (int i = 0; i <= steps; i++)
        {
            const double z = farthest * (2. * i / steps - 1), x = z * sigma,
                         weight = (isWrong ? wrong : 1) / steps * std::exp(-z * z / 2) * likelihood(logG + x - logWall);
            sum += weight;
            first += weight * x;
            second += weight * x * x;
        }
    }
    if (!(sum > 0))
        return;
    const double mean = first / sum;
    logG += mean;
    variance = std::max(second / sum - mean * mean, 0.);
}

void DrivingPrior::anyRoad(double& logG, double& sigma) const
{
    logG = logSpeed + std::log(ratio);
    sigma = std::hypot(logSpeedSigma, logHeightSigma);
}

// Mean and standard deviation of the exponential of a normal deviate.
static Vec2d ofLogNormal(double median, double logSigma)
{
    const double mean = median * std::exp(logSigma * logSigma / 2);
    return Vec2d(mean, mean * std::sqrt(std::expm1(logSigma * logSigma)));
}

void stationaryState(const RollingShutterCamera& camera, const AckermannEstimator::Params& params, SequenceVector& mean,
                     SequenceVector& sigma)
{
    const Vec2d moving = ofLogNormal(params.priorSpeed, params.priorSpeedLogSigma),
                wall = ofLogNormal(1 / params.priorWallDistance, params.priorWallDistanceLogSigma);
    const double moves = 1 - params.standingProbability, speed = moves * moving[0],
                 speedSigma = std::sqrt(moves * moving.dot(moving) - speed * speed);
    const double height = camera.height > 0 ? camera.height : params.priorHeight,
                 heightSigma = camera.height > 0 ? HEIGHT_SIGMA : params.priorHeightLogSigma;
    const double directionSigma = params.wallDeviationSigma > 0 ? params.wallDeviationSigma : 1;
    const bool isExact = !(params.gravitySigma > 0);
    const double rollSigma = isExact ? EXACT_GRAVITY : std::hypot(params.gravitySigma, camera.rollSigma),
                 pitchSigma = isExact ? EXACT_GRAVITY : std::hypot(params.vehiclePitchSigma, camera.pitchSigma);
    mean = SequenceVector(0, speed, camera.heading, wall[0], wall[0], 1 / height, 0, 0);
    // Over seconds yaw rates stay what they are, and bends of three times the expected ones are no exception.
    sigma = SequenceVector(3 * params.priorYawRate, speedSigma, directionSigma, wall[1], wall[1], heightSigma / height,
                           rollSigma, pitchSigma);
}

}} // namespace cv::rsackermann
