// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "contradiction.hpp"
#include "limits.hpp"

namespace cv { namespace rsackermann {

static const double SLANTS_OF_SPEED = 6; // largest slants that the scaled speed may be without metric limits

MotionLimits::MotionLimits(const RollingShutterCamera& camera, const AckermannEstimator::Params& params)
{
    maxAlpha = params.maxSlant / 2;
    maxScaledSpeed = maxRightScaledSpeed = SLANTS_OF_SPEED * params.maxSlant;
    const double unit = camera.secondsPerUnitTime();
    areMetric = unit > 0 && params.wallDistance > 0;
    if (unit > 0)
    {
        maxAlpha = std::min(maxAlpha, params.maxYawRate * unit / 2);
        if (params.wallDistance > 0)
            maxScaledSpeed = std::min(maxScaledSpeed, params.maxSpeed * unit / params.wallDistance);
    }
}

// One wall, or two whose distances aren't worlds apart.
bool MotionLimits::allow(const Model& m) const
{
    const double speed = std::hypot(m[P_B], m[P_D]);
    return std::abs(m[P_ALPHA]) <= maxAlpha && speed <= maxScaledSpeed && m[P_LAMBDA] >= 0 &&
           m[P_LAMBDA] * speed <= maxRightScaledSpeed;
}

double MotionLimits::maxSlant(double x, double heading) const
{
    const double turning = 2 * maxAlpha * (1 + x * x);
    const double passing = maxScaledSpeed * std::sqrt(1 + x * x) * std::abs(std::sin(heading) - x * std::cos(heading));
    return turning + passing;
}

// A value that is hardly known is no reason to allow more than what is usual.
static double limitOf(double given, double sigma, double usual)
{
    const double deviation = CONTRADICTION * sigma;
    return sigma > 0 && deviation < usual ? std::max(usual, std::abs(given) + deviation) : usual;
}

AckermannEstimator::Params withLimitsOf(const MotionPrior& given, AckermannEstimator::Params params)
{
    params.maxYawRate = limitOf(given.yawRate, given.yawRateSigma, params.maxYawRate);
    params.maxSpeed = limitOf(given.speed, given.speedSigma, params.maxSpeed);
    return params;
}

}} // namespace cv::rsackermann
