// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "prior_options.hpp"
#include "units.hpp"

namespace rsackermann_samples {

using cv::rsackermann::MotionPrior;

const char* const PRIOR_KEYS =
    "{speed      |        | km/h that the car reports, negative in reverse; needs the line delay; with --height it "
    "gives the road}"
    "{speed_sigma |       | standard deviation of --speed in km/h (default 2)}"
    "{yaw_rate   |        | deg/s that the car or a gyro reports, positive to the right; needs the line delay}"
    "{yaw_rate_sigma |    | standard deviation of --yaw_rate in deg/s (default 1)}";

namespace {

// A value with its standard deviation, in the given unit, if it is given.
void readMeasurement(const Options& options, const std::string& name, double defaultSigma, double unit, double& value,
                     double& sigma)
{
    const double limit = 1000;
    const std::string sigmaName = name + "_sigma";
    if (options.given(name))
    {
        value = options.number(name, -limit, limit) * unit;
        sigma = (options.given(sigmaName) ? options.positive(sigmaName, limit) : defaultSigma) * unit;
    }
    else if (options.given(sigmaName))
        throw UsageError("--" + sigmaName + " needs --" + name);
}

} // namespace

MotionPrior readPriorOptions(const Options& options)
{
    MotionPrior prior;
    readMeasurement(options, "speed", SPEED_SIGMA, KMH, prior.speed, prior.speedSigma);
    readMeasurement(options, "yaw_rate", YAW_RATE_SIGMA, DEGREE, prior.yawRate, prior.yawRateSigma);
    return prior;
}

} // namespace rsackermann_samples
